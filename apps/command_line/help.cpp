#include "apps/command_line/help.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <utility>

namespace oro {
namespace {

constexpr const char* messages = "Messages";

// "Exit code: 0 done, 1 failed, 2 wrong arguments, ..."
std::string exit_codes() {
    std::string line;
    for (const auto& [code, words] : exit_code_words())
        line += (line.empty() ? "Exit code: " : ", ") + std::to_string(code) + " " + words;
    return line + ".";
}

// Of standard output, where it is a terminal; else as wide as a page.
std::size_t columns_here() {
    constexpr std::size_t page = 100, narrowest = 60;
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return page;
    return std::clamp<std::size_t>(size.ws_col, narrowest, page);
}

// Words in lines up to `columns`, each line but the first indented.
std::string wrapped(const std::string& text, std::size_t first_column, std::size_t indent,
                    std::size_t columns) {
    std::string lines;
    std::size_t column = first_column;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const bool begins = column == indent;
        if (!begins && column + 1 + (end - at) > columns) {
            lines += "\n" + std::string(indent, ' ');
            column = indent;
        } else if (!begins) {
            lines += ' ';
            ++column;
        }
        lines += text.substr(at, end - at);
        column += end - at;
        at = end + 1;
    }
    return lines + "\n";
}

// A name and what it is for, in two columns.
std::string row(const std::string& name, const std::string& text, std::size_t second_column,
                std::size_t columns) {
    std::string line = "  " + name;
    if (line.size() + 2 > second_column)
        line += "\n" + std::string(second_column, ' ');
    else
        line.resize(second_column, ' ');
    return line + wrapped(text, second_column, second_column, columns);
}

// "--above METRES", "-q, --quiet", "PATH..."
std::string name_of(const CLI::Option& option) {
    if (!option.nonpositional()) return option.get_name(true, false) + option.get_option_text();
    std::string name = CLI::detail::find_and_replace(option.get_name(false, true), ",", ", ");
    return name + (option.get_option_text().empty() ? "" : " " + option.get_option_text());
}

// Their headings, in the order in which they were added.
std::vector<std::string> headings_of(const std::vector<const CLI::Option*>& options) {
    std::vector<std::string> headings;
    for (const CLI::Option* option : options) {
        const std::string& heading = option->get_group();
        if (std::ranges::find(headings, heading) == headings.end()) headings.push_back(heading);
    }
    return headings;
}

std::string options_text(const std::vector<const CLI::Option*>& options, std::size_t columns) {
    constexpr std::size_t roomy = 90;
    const std::size_t second_column = columns < roomy ? 26 : 36;
    std::string text;
    for (const std::string& heading : headings_of(options)) {
        text += "\n" + heading + ":\n";
        for (const CLI::Option* option : options) {
            if (option->get_group() == heading)
                text += row(name_of(*option), option->get_description(), second_column, columns);
        }
    }
    return text;
}

// Those that are not hidden, `--help` last; all of them, or those that are listed first.
std::vector<const CLI::Option*> shown_options(const CLI::App& command, bool all) {
    std::vector<const CLI::Option*> options = command.get_options({});
    std::ranges::stable_partition(
        options, [&](const CLI::Option* option) { return option != command.get_help_ptr(); });
    std::erase_if(options, [&](const CLI::Option* option) {
        const bool is_listed = all || option->get_configurable() || option == command.get_help_ptr();
        return option->get_group().empty() || !is_listed;
    });
    return options;
}

std::string help_text(const CLI::App& command, const CommandHelp& help, bool all, std::size_t columns) {
    std::string text = wrapped(command.get_description() + ".", 0, 0, columns) + "\n";
    for (const std::string& usage : help.usages) {
        text += usage == help.usages.front() ? "Usage: " : "       ";
        text += wrapped("orograph " + usage, 7, 7, columns);
    }
    const auto listed = shown_options(command, all);
    text += options_text(listed, columns) + "\n";
    if (!help.note.empty()) text += wrapped(help.note, 0, 0, columns) + "\n";
    text += wrapped(exit_codes(), 0, 0, columns) + "More: " + help.page + "\n";
    if (const std::size_t more = shown_options(command, true).size() - listed.size(); more > 0)
        text += wrapped("`orograph " + command.get_name() + " --help all` lists " + std::to_string(more) +
                            (more == 1 ? " more option." : " more options."),
                        0, 0, columns);
    return text;
}

std::string program_text(const CLI::App& app, std::size_t columns) {
    constexpr std::size_t command_column = 12, example_column = 44;
    std::string text = wrapped(app.get_description(), 0, 0, columns) +
                       "\nUsage: orograph COMMAND [OPTIONS]\n"
                       "       orograph COMMAND --help\n"
                       "\nCommands:\n";
    for (const CLI::App* command : app.get_subcommands({})) {
        if (is_listed(*command))
            text += row(command->get_name(), command->get_description(), command_column, columns);
    }
    text += "\nTo begin with a folder of elevation data:\n";
    text += row("orograph info FOLDER", "what the data are", example_column, columns);
    text += row("orograph shot FOLDER --out picture.png", "a picture of all of it", example_column, columns);
    text += row("orograph view FOLDER", "fly over it", example_column, columns);
    text += "\nOptions:\n";
    text += row("-h, --help", "Print this help.", example_column, columns);
    text += row("--version", "Print the program's version.", example_column, columns);
    text += "\n" + wrapped(
                       "`orograph completion --help` tells how a shell completes these words, and "
                       "`orograph manual --help` how they become pages of the manual.",
                       0, 0, columns);
    return text + "\n" + wrapped(exit_codes(), 0, 0, columns) +
           wrapped("More: README.md, and a page for each command in docs/commands.", 0, 0, columns);
}

// Writes the help of one command.
class CommandFormatter final : public CLI::FormatterBase {
  public:
    explicit CommandFormatter(CommandHelp help) : help_(std::move(help)) {}
    [[nodiscard]] const CommandHelp& help() const { return help_; }
    std::string make_help(const CLI::App* command, std::string, CLI::AppFormatMode mode) const override {
        return help_text(*command, help_, mode == CLI::AppFormatMode::All, columns_here());
    }

  private:
    CommandHelp help_;
};

}  // namespace

const std::vector<std::pair<int, const char*>>& exit_code_words() {
    static const std::vector<std::pair<int, const char*>> words = {{0, "done"},
                                                                   {1, "failed"},
                                                                   {2, "wrong arguments"},
                                                                   {3, "no data in the region"},
                                                                   {4, "no suitable GPU"}};
    return words;
}

void set_help(CLI::App& command, const CommandHelp& help) {
    command.set_help_flag("-h,--help", "Print this help.")->group(messages);
    command.formatter(std::make_shared<CommandFormatter>(help));
}

CommandHelp help_of(const CLI::App& command) {
    const auto* const formatter = dynamic_cast<const CommandFormatter*>(command.get_formatter().get());
    return formatter == nullptr ? CommandHelp() : formatter->help();
}

void hide_command(CLI::App& command) {
    command.group("");
}

bool is_listed(const CLI::App& command) {
    return !command.get_group().empty();
}

// The parser's mark for what a config file may set says which are listed first: no command reads such a file.
void list_later(CLI::App& command, const std::vector<std::string>& options) {
    for (const std::string& name : options) command.get_option(name)->configurable(false);
}

void list_first(CLI::App& command, const std::vector<std::string>& options) {
    for (const std::string& name : options) command.get_option(name)->configurable(true);
}

bool is_after_help(const std::vector<std::string>& words, std::size_t number) {
    return number > 1 && (words[number - 1] == "--help" || words[number - 1] == "-h");
}

bool asks_for_all_options(const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i)
        if (words[i] == "--help=all" || words[i] == "-hall" || (words[i] == "all" && is_after_help(words, i)))
            return true;
    return false;
}

void hide(CLI::App& command, const std::vector<std::string>& options) {
    for (const std::string& name : options) command.get_option(name)->group("");
}

void set_program_help(CLI::App& app) {
    app.formatter_fn([](const CLI::App* asked, const std::string&, CLI::AppFormatMode) {
        return program_text(*asked, columns_here());
    });
}

}  // namespace oro
