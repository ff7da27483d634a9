// What `--help` shows: usage, options under headings, exit codes, where to read more.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace oro {

// What the program's exit codes say, in words: {2, "wrong arguments"}.
const std::vector<std::pair<int, const char*>>& exit_code_words();

// What the help of a command says beside its options.
struct CommandHelp {
    std::vector<std::string> usages;  // "shot PATH... --out FILE [OPTIONS]"
    std::string note;                 // below the options
    std::string page;                 // where more is written
};

// Gives a command its help, as wide as the terminal is, up to 100 columns. `--help` stands last of the
// messages' options.
void set_help(CLI::App& command, const CommandHelp& help);
// What set_help() was given; empty before it.
CommandHelp help_of(const CLI::App& command);
// Lets help list options of a command only where all are asked for, or always, as it does unless told
// otherwise.
void list_later(CLI::App& command, const std::vector<std::string>& options);
void list_first(CLI::App& command, const std::vector<std::string>& options);
// Takes options out of a command's help that have no effect there, or are refused with a reason.
void hide(CLI::App& command, const std::vector<std::string>& options);
// Takes a command out of the program's help and of the lists in its errors; what it does stays.
void hide_command(CLI::App& command);
// Whether the program's help names a command.
bool is_listed(const CLI::App& command);
// The help of the program itself: its commands and how to begin.
void set_program_help(CLI::App& app);

// Whether a word of a command line follows `--help` or `-h`.
bool is_after_help(const std::vector<std::string>& words, std::size_t number);
// Whether a command line asks for all options: `--help all`, `--help=all`, or either with -h. App::help()
// lists them with AppFormatMode::All.
bool asks_for_all_options(const std::vector<std::string>& words);

}  // namespace oro
