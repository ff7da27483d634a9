#include "apps/command_line/manual.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include "apps/command_line/help.h"

namespace oro {
namespace {

// Text for roff: a dash stays the one that can be typed, quotes stay straight, and no line is a command.
std::string roff_text(std::string_view text) {
    static constexpr std::array<std::pair<char, std::string_view>, 6> signs = {
        {{'\\', "\\e"}, {'-', "\\-"}, {'\'', "\\(aq"}, {'`', "\\(ga"}, {'^', "\\(ha"}, {'~', "\\(ti"}}};
    std::string roff = text.starts_with('.') ? "\\&" : "";
    for (const char c : text) {
        const auto* const sign = std::ranges::find(signs, c, &std::pair<char, std::string_view>::first);
        if (sign == signs.end())
            roff += c;
        else
            roff += sign->second;
    }
    return roff;
}

std::string bold(std::string_view text) {
    return "\\fB" + roff_text(text) + "\\fR";
}
std::string italic(std::string_view text) {
    return "\\fI" + roff_text(text) + "\\fR";
}

// A line of the synopsis: names of options bold, words for values italic.
std::string usage_line(const std::string& usage) {
    const std::size_t gap = std::min(usage.find(' '), usage.size());
    std::string line = bold("orograph " + usage.substr(0, gap));
    for (std::size_t at = gap; at < usage.size();) {
        const std::size_t end = std::min(usage.find(' ', at + 1), usage.size());
        const std::string word = usage.substr(at + 1, end - at - 1);
        const bool is_value = !word.empty() && std::ranges::none_of(word, [](unsigned char c) {
            return std::islower(c) != 0 || c == '[' || c == ']';
        });
        line += " " + (word.starts_with('-') ? bold(word) : is_value ? italic(word) : roff_text(word));
        at = end;
    }
    return line + "\n";
}

// "\fB--above\fR \fIMETRES\fR"
std::string option_tag(const DescribedOption& option) {
    if (option.is_positional) return italic(option.names.front() + option.value_word);
    std::string tag;
    for (const std::string& name : option.names) tag += (tag.empty() ? "" : ", ") + bold(name);
    if (!option.takes_value) return tag;
    return tag + " " + (option.choices.empty() ? italic(option.value_word) : bold(option.value_word));
}

std::string page_title(const std::string& name) {
    std::string title = name;
    for (char& c : title) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return ".TH " + roff_text(title) + " 1 \"\" \"orograph " OROGRAPH_VERSION "\" \"Orograph\"\n";
}

std::string options_section(const std::vector<DescribedOption>& options) {
    std::string section = ".SH OPTIONS\n", heading;
    for (const DescribedOption& option : options) {
        if (option.heading != heading) section += ".SS " + roff_text(option.heading) + "\n";
        heading = option.heading;
        section += ".TP\n" + option_tag(option) + "\n" + roff_text(option.sentence) + "\n";
    }
    return section;
}

std::string exit_section() {
    std::string section = ".SH \"EXIT STATUS\"\n";
    for (const auto& [code, words] : exit_code_words())
        section += ".TP\n" + bold(std::to_string(code)) + "\n" + roff_text(words) + "\n";
    return section;
}

std::string examples_section() {
    std::string section = ".SH EXAMPLES\n";
    for (const auto& [line, about] :
         {std::pair{"orograph info FOLDER", "What the elevation data in a folder are."},
          {"orograph shot FOLDER --out picture.png", "A picture of all of it."},
          {"orograph view FOLDER", "A window to fly over it."}})
        section += ".TP\n" + bold(line) + "\n" + roff_text(about) + "\n";
    return section;
}

std::string environment_section() {
    std::string section = ".SH ENVIRONMENT\n";
    for (const auto& [name, about] :
         {std::pair{"OROGRAPH_CACHE",
                    "The folder of what the program measures once on a machine. Default: "
                    "orograph in XDG_CACHE_HOME, or in .cache in the home folder."},
          {"OROGRAPH_DATA", "The folder of the styles. Default: ../share/orograph beside the program."},
          {"OROGRAPH_DEVICE", "The GPU: its number, or a part of its name."},
          {"SOURCE_DATE_EPOCH", "The present time, in seconds since 1970, for output that must repeat."}})
        section += ".TP\n" + bold(name) + "\n" + roff_text(about) + "\n";
    return section;
}

}  // namespace

std::string manual_page(const DescribedCommand& command) {
    std::string page = page_title("orograph-" + command.name) + ".SH NAME\n" +
                       roff_text("orograph-" + command.name) + " \\- " + roff_text(command.summary) +
                       "\n.SH SYNOPSIS\n";
    for (const std::string& usage : command.usages)
        page += (usage == command.usages.front() ? "" : ".br\n") + usage_line(usage);
    page += ".SH DESCRIPTION\n" + roff_text(command.summary) + ".\n";
    if (!command.note.empty()) page += ".PP\n" + roff_text(command.note) + "\n";
    return page + options_section(command.options) + exit_section() +
           ".SH \"SEE ALSO\"\n.BR orograph (1)\n.PP\n" + roff_text(command.page) + " explains more.\n";
}

std::string program_manual_page(const std::string& about, const std::vector<DescribedCommand>& commands) {
    std::string page = page_title("orograph") +
                       ".SH NAME\norograph \\- terrain at its place on the ellipsoid\n.SH SYNOPSIS\n" +
                       bold("orograph") + " " + italic("COMMAND") + " [OPTIONS]\n.br\n" + bold("orograph") +
                       " " + italic("COMMAND") + " " + bold("--help") + "\n.br\n" + bold("orograph") + " " +
                       bold("--help") + " | " + bold("--version") + "\n.SH DESCRIPTION\n" + roff_text(about) +
                       "\n.SH COMMANDS\n";
    for (const DescribedCommand& command : commands) {
        // Those that are not listed have no page of their own.
        page += command.is_listed
                    ? ".TP\n.BR " + roff_text("orograph-" + command.name) + " (1)\n"
                    : ".TP\n" + usage_line(command.usages.empty() ? command.name : command.usages.front());
        page += roff_text(command.summary) + ".\n";
    }
    return page + examples_section() + environment_section() + exit_section() +
           ".SH \"SEE ALSO\"\nREADME.md, and a page for each command in docs/commands.\n";
}

}  // namespace oro
