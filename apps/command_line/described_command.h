// What the program takes, as data: completion of shells and pages of the manual are made of it.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace oro {

// An option, or an argument without dashes.
struct DescribedOption {
    std::vector<std::string> names;  // "-q", "--quiet"; "PATH" of an argument without dashes
    bool is_positional{};
    bool takes_value{};                // of an option: false for flags
    bool is_repeatable{};              // it may be given several times, or have several values
    std::string heading;               // of help that it stands under
    std::string value_word;            // "METRES"; "on|off" of choices; "" of flags
    std::string sentence;              // of help
    std::vector<std::string> choices;  // its only values; none: any value
};

struct DescribedCommand {
    std::string name;
    std::string summary;  // without a full stop
    bool is_listed{};     // the program's help names it
    std::vector<std::string> usages;
    std::string note;
    std::string page;                      // of docs
    std::vector<DescribedOption> options;  // all that `--help all` lists, in its order
};

// All commands, in the order of help. Those that are not listed come with the others.
std::vector<DescribedCommand> described_commands(CLI::App& app);

}  // namespace oro
