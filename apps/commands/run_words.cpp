#include "apps/commands/run_words.h"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <iostream>
#include <string>
#include <system_error>
#include <vector>

#include "apps/command_line/help.h"
#include "apps/command_line/refusals.h"
#include "apps/commands/command_line.h"
#include "apps/commands/run_command.h"
#include "apps/output/interruption.h"
#include "apps/report/library_versions.h"
#include "geo/files/library_faults.h"
#include "geo/sources/library_report.h"

namespace oro {
namespace {

constexpr const char* about_program =
    "Orograph draws real terrain at its true place on the Earth, and says how accurate each picture is.";

// What a library says when it has no memory may pass for a mistake of the user, or for a damaged file: PROJ
// knows no way then, and makes nothing of its geoid.
int reported(Error error) {
    if (const auto sound = libraries_are_sound(); !sound.ok() && error.where != sound.error().where)
        error = {ErrorKind::failed, sound.error().where,
                 sound.error().what + ", so this may not be true: " + error.line()};
    std::fprintf(stderr, "orograph: %s\n", error.line().c_str());
    return static_cast<int>(error.kind);
}

// Why what was printed has not arrived, where it failed on the way and not in the end: one more line end
// fails for the same reason.
int reason_of_broken_output() {
    std::clearerr(stdout);
    errno = 0;
    if (std::fputc('\n', stdout) == '\n' && std::fflush(stdout) == 0) return EIO;
    return errno != 0 ? errno : EIO;
}

// What a command printed has arrived, or the command has failed: `orograph info > file` on a full disk.
int exit_code(const Result<void>& result) {
    if (!result.ok()) return reported(result.error());
    errno = 0;
    std::cout.flush();
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout) return 0;
    const int why = errno;
    end_if_reader_has_gone();
    return reported({ErrorKind::failed, "standard output",
                     "cannot be written: " +
                         std::generic_category().message(why != 0 ? why : reason_of_broken_output())});
}

// The program's own in the first line, then those of the libraries that it reads and draws with.
std::string versions() {
    std::string text = "orograph " OROGRAPH_VERSION "\n";
    const LibraryReport readers = report_versions();
    text += "GDAL " + readers.gdal + ", PROJ " + readers.proj + ", GeographicLib " + readers.geographiclib;
    for (const LibraryVersion& library : library_versions())
        text += ", " + library.name + " " + library.version;
    return text;
}

}  // namespace

int run_words(int argc, char** argv) {
    CLI::App app{about_program, "orograph"};
    app.require_subcommand(1);
    app.set_version_flag("--version", versions);
    CommandLine line;
    add_commands(app, line);
    const std::vector<std::string> words(argv, argv + argc);
    if (argc < 2) {
        std::fprintf(stderr, "orograph: no command is named\n\n%s", app.help().c_str());
        return static_cast<int>(ErrorKind::usage);
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() != 0) return reported(refusal_of(app, e, words));
        if (const auto no_command = refusal_of_command(app, words)) return reported(*no_command);
        if (e.get_name() == "CallForHelp" && asks_for_all_options(words))
            app.exit(CLI::CallForAllHelp());
        else
            app.exit(e);
        return exit_code({});
    }
    return exit_code(run_command(app, line, words));
}

}  // namespace oro
