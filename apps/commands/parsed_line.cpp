#include "apps/commands/parsed_line.h"

#include <CLI/CLI.hpp>

#include "apps/command_line/refusals.h"

namespace oro {

Result<std::unique_ptr<CommandLine>> parsed_line(const std::vector<std::string>& words,
                                                 const Error& of_help) {
    auto line = std::make_unique<CommandLine>();
    CLI::App app{"", "orograph"};
    add_commands(app, *line);
    try {
        // The parser takes them from the last to the first.
        app.parse(std::vector<std::string>(words.rbegin(), words.rend() - 1));
    } catch (const CLI::ParseError& refused) {
        if (refused.get_exit_code() == 0) return of_help;
        return refusal_of(app, refused, words);
    }
    return line;
}

}  // namespace oro
