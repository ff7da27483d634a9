// Words for what is wrong with a command line: one line each, "--option value: what to do instead".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace CLI {
class App;
class Option;
class ParseError;
}  // namespace CLI

namespace oro {

// A usage error: the option, the value that it was given (it may be empty), and what is wrong with it.
Error refused(const std::string& option, const std::string& value, const std::string& what);

// "ellipsoid, sphere or flat", where `last` is " or ".
std::string joined(const std::vector<std::string>& words, const std::string& last);
// "choose ellipsoid, sphere or flat"
std::string choose_words(const std::vector<std::string>& choices);
// "must be between 0.05 and 120"
std::string between_words(double low, double high);
// "give either --above or --altitude, not both"
std::string either_words(const std::string& one, const std::string& other);

// Checks that the parser makes of an option's value. What they refuse, refusal_of() tells.
// A value: not nothing, nor the name of another option where this one's value is missing.
void need_value(const CLI::App& command, CLI::Option& option);
void need_choice(CLI::Option& option, const std::vector<std::string>& choices);
// The choices that need_choice() was given for the option; none where it was not.
std::vector<std::string> choices_of(CLI::Option& option);
void need_number(CLI::Option& option);
// Decimal digits alone, from low to high; the parser itself takes 010 for eight and 0x10 for sixteen.
void need_whole_number(const CLI::App& command, CLI::Option& option, int low, int high);
// For options that have no value: --json=perhaps.
void need_no_value(CLI::Option& option);

// Checks a command line that asks for help or for the version: its first word that is no option must be a
// command, and what follows `--help` must be `all`. Errors (usage): the word that is neither; else nothing.
std::optional<Error> refusal_of_command(const CLI::App& app, const std::vector<std::string>& words);

// What the parser has refused, in words. `words` is the command line.
Error refusal_of(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words);

}  // namespace oro
