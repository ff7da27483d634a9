// What a new user is shown: `--help` of each command lists what most people need, and `--help all` says what
// every option takes, under the same headings, and lists nothing that has no effect.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/apps/command_names.h"
#include "tests/apps/program.h"
#include "tests/support/found_texts.h"
#include "tests/support/test_data.h"

namespace {
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::Words;

const Words& commands = oro::test::command_names();
const std::string exit_line =
    "\nExit code: 0 done, 1 failed, 2 wrong arguments, 3 no data in the region, 4 no suitable GPU.\n";

std::string printed(const Words& words) {
    const Outcome outcome = run_orograph(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return outcome.out;
}

// Of all options.
std::string help_of(Words words) {
    words.insert(words.end(), {"--help", "all"});
    return printed(words);
}

Words lines_of(const std::string& text) {
    Words lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

// "--above METRES" and its sentence, of all options that a help lists.
std::map<std::string, std::string> options_in(const std::string& help) {
    std::map<std::string, std::string> options;
    std::string name;
    for (const std::string& line : lines_of(help)) {
        const std::size_t gap = line.find("  ", 2);
        if (line.starts_with("  -")) name = line.substr(2, gap == std::string::npos ? gap : gap - 2);
        if (line.empty()) name.clear();
        if (!name.empty()) options[name] += line.substr(std::min<std::size_t>(36, line.size())) + " ";
    }
    return options;
}

bool lists(const std::string& help, const std::string& option) {
    return help.find("\n  " + option + " ") != std::string::npos;
}

TEST(Help, HasNoWordsOfTheParser) {
    const std::string noise =
        "\\b(TEXT|FLOAT|INT|UINT|BOOLEAN|REQUIRED|SUBCOMMAND|Positionals|Excludes)\\b|Needs: |"
        "\\bin \\[|:\\{";
    for (const std::string& command : commands) {
        const std::string help = help_of({command});
        for (const auto& found : oro::test::found_texts(help, noise))
            ADD_FAILURE() << command << ": " << found[0];
        for (const std::string& line : lines_of(help))
            EXPECT_LE(line.size(), 100U) << command << ": " << line;
        EXPECT_NE(help.find("Usage: orograph " + command + " "), std::string::npos);
    }
}

TEST(Help, HasTheSameExitLineEverywhere) {
    EXPECT_NE(help_of({}).find(exit_line), std::string::npos);
    for (const std::string& command : commands) {
        const std::string help = help_of({command});
        EXPECT_NE(help.find(exit_line), std::string::npos) << command;
        EXPECT_NE(help.find("docs/commands/" + command + ".md"), std::string::npos) << command;
    }
}

TEST(Help, HasTheSameHeadingsInTheSameOrder) {
    const Words order{"Elevation data:", "The eye:", "Looks:", "Detail and models:", "Messages:"};
    for (const std::string& command : commands) {
        Words found;
        for (const std::string& line : lines_of(help_of({command}))) {
            if (std::ranges::find(order, line) != order.end()) found.push_back(line);
        }
        Words wanted = order;
        if (command == "compare") wanted = {order[0], order[3], order[4]};
        if (command == "sun") wanted = {order[0], order[1], order[3], order[4]};
        if (command == "sight" || command == "viewshed" || command == "horizon")
            wanted = {order[0], order[3], order[4]};
        if (command == "profile") wanted = {order[0], order[4]};
        if (command == "bake" || command == "export" || command == "info") wanted = {order[0], order[4]};
        if (command == "doctor" || command == "serve" || command == "fetch" || command == "batch")
            wanted = {order[4]};
        EXPECT_EQ(found, wanted) << command;
    }
}

// A value word for all but flags; a sentence, which begins in the same column and ends with a full stop.
TEST(Help, ExplainsEachOption) {
    const Words flags{"--verify",       "--layers",       "--ortho",     "--legend",
                      "--no-paths",     "--data-changed", "--overwrite", "--json",
                      "-q, --quiet",    "--check",        "--no-legend", "--fill-voids",
                      "--strict-datum", "-h, --help",     "--resample",  "--on-summit",
                      "--kml",          "--geopose",      "--cors",      "--dry-run",
                      "--join",         "--stac",         "--network",   "--cache",
                      "--no-normals",   "--cut-under",    "--all",       "--target-on-summit"};
    for (const std::string& command : commands) {
        const auto options = options_in(help_of({command}));
        EXPECT_GE(options.size(), 2U) << command;
        for (const auto& [name, sentence] : options) {
            EXPECT_EQ(sentence.substr(sentence.find_last_not_of(' ')).front(), '.')
                << name << ": " << sentence;
            EXPECT_NE(sentence.front(), ' ') << name;
            const bool is_flag = std::ranges::find(flags, name) != flags.end();
            EXPECT_TRUE(is_flag || oro::test::is_text(name, "--[a-z-]+ [A-Za-z0-9,|-]+")) << name;
        }
    }
}

// What is refused there, or has no effect.
TEST(Help, HidesWhatDoesNothing) {
    const std::map<std::string, Words> hidden{
        {"trade", {"--tau",           "--earth",        "--refraction", "--air",
                   "--precision",     "--geoid",        "--heights",    "--accuracy",
                   "--tolerance",     "--labels",       "--edges",      "--samples",
                   "--names",         "--names-field",  "--overlay",    "--overlay-colour",
                   "--overlay-width", "--overlay-fill", "--mesh",       "--graticule"}},
        {"panorama",
         {"--heading", "--pitch", "--roll", "--look-at", "--fov", "--size", "--labels", "--tolerance",
          "--graticule"}},
        {"plan",
         {"--style", "--sun", "--sun-time", "--shadows", "--sky-openness", "--labels", "--edges", "--samples",
          "--names", "--names-field", "--overlay", "--overlay-colour", "--overlay-width", "--overlay-fill",
          "--pipeline", "--mesh", "--mesh-level", "--time", "--graticule"}},
        {"view", {"--tolerance", "--time"}},
        {"compare",
         {"--bbox", "--tile", "--height-unit", "--source-crs", "--source-vertical", "--strict-datum",
          "--fill-voids", "--resample", "--order", "--feather"}}};
    const std::string shot = help_of({"shot"});
    for (const auto& [command, options] : hidden) {
        const std::string help = help_of({command});
        for (const std::string& option : options) {
            EXPECT_FALSE(lists(help, option)) << command << " " << option;
            EXPECT_TRUE(lists(shot, option)) << option;
        }
    }
    const std::string bundled = (oro::test::bundled_data() / "jacksboro.tif").string();
    EXPECT_EQ(run_orograph({"plan", bundled, "--samples", "4", "--time", "2026-11-21T09:00:00Z"}).exit_code,
              0)
        << "a command line of shot can be planned";
}

// Some twenty options first; the last line says how many more there are, and how they are asked for.
TEST(Help, ListsFirstWhatMostPeopleNeed) {
    for (const std::string& command : commands) {
        const auto first = options_in(printed({command, "--help"})), all = options_in(help_of({command}));
        for (const auto& [name, sentence] : first) EXPECT_TRUE(all.contains(name)) << command << " " << name;
        EXPECT_LE(first.size(), 25U) << command;
        const std::string last = lines_of(printed({command, "--help"})).back();
        const std::size_t more = all.size() - first.size();
        const std::string wanted =
            "`orograph " + command + " --help all` lists " + std::to_string(more) + " more options.";
        EXPECT_EQ(last, more > 0 ? wanted : "More: docs/commands/" + command + ".md");
        for (const Words& asked : {Words{"-h", "all"}, Words{"-hall"}, Words{"--help=all"}})
            EXPECT_EQ(printed(oro::test::joined({command}, asked)), help_of({command}))
                << command << asked[0];
    }
    const std::string shot = printed({"shot", "--help"});
    EXPECT_LE(lines_of(shot).size(), 80U);
    for (const char* name :
         {"--out", "--view", "--at", "--above", "--heading", "--size", "--style", "--json"})
        EXPECT_TRUE(lists(shot, name)) << name;
    for (const char* name : {"--precision", "--memory", "--feather", "--rim", "--time"})
        EXPECT_FALSE(lists(shot, name)) << name;
    EXPECT_TRUE(lists(printed({"bake", "--help"}), "--mesh"));
    EXPECT_TRUE(lists(printed({"plan", "--help"}), "--tolerance"));
}

TEST(Help, OfTheProgramNamesItsCommands) {
    const std::string help = printed({"--help"});
    EXPECT_EQ(help_of({}), help);
    for (const std::string& command : commands) EXPECT_TRUE(lists(help, command)) << command;
    for (const char* words : {"COMMAND --help", "README.md", "docs/commands", "orograph info FOLDER"})
        EXPECT_NE(help.find(words), std::string::npos) << words;
    const Outcome nothing = run_orograph({});
    EXPECT_EQ(nothing.exit_code, 2);
    EXPECT_EQ(nothing.out, "");
    EXPECT_EQ(nothing.err, "orograph: no command is named\n\n" + help);
}

// In a narrow terminal lines are as wide as it is.
TEST(Help, FitsTheTerminal) {
    const Outcome outcome = run_program({"script", "-qec", "stty cols 80; " OROGRAPH_PROGRAM " shot --help",
                                         (oro::test::scratch_folder() / "log").string()});
    if (outcome.exit_code == 127 || outcome.out.empty()) GTEST_SKIP() << "needs script(1)";
    std::size_t widest = 0;
    for (const std::string& line : lines_of(outcome.out)) widest = std::max(widest, line.size() - 1);
    EXPECT_LE(widest, 80U);
    EXPECT_GT(widest, 70U);
    EXPECT_NE(outcome.out.find("Exit code: 0 done"), std::string::npos);
}

}  // namespace
