// Options of a command that stand under one heading of its help.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>

#include "apps/command_line/refusals.h"

namespace oro {

class OptionGroup {
  public:
    OptionGroup(CLI::App& command, std::string heading) : command_(command), heading_(std::move(heading)) {}

    // An option with a value, of which help says `value_word` ("METRES") and a sentence.
    template <class T>
    CLI::Option& option(const std::string& name, T& value, const std::string& value_word,
                        const std::string& sentence) {
        CLI::Option& added = *command_.add_option(name, value, sentence);
        added.option_text(value_word)->group(heading_);
        need_value(command_, added);
        return added;
    }
    template <class T>
    CLI::Option& number(const std::string& name, T& value, const std::string& value_word,
                        const std::string& sentence) {
        CLI::Option& added = option(name, value, value_word, sentence);
        need_number(added);
        return added;
    }
    // From low to high.
    template <class T>
    CLI::Option& whole_number(const std::string& name, T& value, int low, int high,
                              const std::string& value_word, const std::string& sentence) {
        CLI::Option& added = option(name, value, value_word, sentence);
        need_whole_number(command_, added, low, high);
        return added;
    }
    // One of some words.
    template <class T>
    CLI::Option& choice(const std::string& name, T& value, const std::vector<std::string>& choices,
                        const std::string& sentence) {
        CLI::Option& added = option(name, value, CLI::detail::join(choices, "|"), sentence);
        need_choice(added, choices);
        return added;
    }
    CLI::Option& flag(const std::string& name, bool& value, const std::string& sentence) {
        CLI::Option& added = *command_.add_flag(name, value, sentence);
        added.group(heading_);
        need_no_value(added);
        return added;
    }

  private:
    CLI::App& command_;
    std::string heading_;
};

}  // namespace oro
