// How shells complete the program's command lines: a script for each, made of what the commands take.
#pragma once

#include <string>
#include <vector>

#include "apps/command_line/described_command.h"

namespace oro {

// What a script is made of.
struct CompletionTexts {
    std::vector<DescribedCommand> commands;  // those that are listed are completed
    std::vector<std::string> styles;         // that come with the program
};

// What may stand for a value: words, folders, files whose names end so (without the dot; of no ending any
// file). Nothing at all: the value is typed.
struct CompletedValue {
    std::vector<std::string> words;
    bool has_files{};
    bool has_folders{};
    std::vector<std::string> endings;

    bool operator==(const CompletedValue&) const = default;
};

// What may stand for the value of an option, or for an argument without dashes. styles: of --style.
CompletedValue completed_value(const DescribedCommand& command, const DescribedOption& option,
                               const std::vector<std::string>& styles);

// The shells that there is a script for.
const std::vector<std::string>& completion_shells();
// The script of one of them.
std::string completion_script(const std::string& shell, const CompletionTexts& texts);

// The scripts, each of one shell.
std::string bash_completion(const CompletionTexts& texts);
std::string zsh_completion(const CompletionTexts& texts);
std::string fish_completion(const CompletionTexts& texts);

// For the scripts: the options or the positional arguments of a command.
std::vector<DescribedOption> named_options(const DescribedCommand& command);
std::vector<DescribedOption> positional_arguments(const DescribedCommand& command);
// "a b c"
std::string spaced(const std::vector<std::string>& words, const std::string& between = " ");
// The first sentence of a help, without its full stop. "e.g." and the dots of names end none.
std::string first_sentence(const std::string& sentences);

}  // namespace oro
