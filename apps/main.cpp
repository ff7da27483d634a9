// The program's door: reads the command line, runs one command, turns an error into one line and an exit
// code.
#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "apps/command_line/help.h"
#include "apps/command_line/refusals.h"
#include "apps/commands/command_line.h"
#include "apps/commands/run_command.h"
#include "apps/output/interruption.h"
#include "apps/report/library_versions.h"
#include "core/base/files_read.h"
#include "geo/files/library_faults.h"
#include "geo/files/whole_file.h"
#include "geo/sources/library_report.h"

namespace {

constexpr const char* about =
    "Orograph draws real terrain at its true place on the Earth, and says how accurate each picture is.";

// What a library says when it has no memory may pass for a mistake of the user, or for a damaged file: PROJ
// knows no way then, and makes nothing of its geoid.
int reported(oro::Error error) {
    if (const auto sound = oro::libraries_are_sound(); !sound.ok() && error.where != sound.error().where)
        error = {oro::ErrorKind::failed, sound.error().where,
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
int exit_code(const oro::Result<void>& result) {
    if (!result.ok()) return reported(result.error());
    errno = 0;
    std::cout.flush();
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout) return 0;
    const int why = errno;
    oro::end_if_reader_has_gone();
    return reported({oro::ErrorKind::failed, "standard output",
                     "cannot be written: " +
                         std::generic_category().message(why != 0 ? why : reason_of_broken_output())});
}

// Where standard streams are closed, the next file opened would be taken for one, and messages written into
// it. Closed for writing is what standard output then stays.
void fill_standard_streams() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(descriptor, F_GETFD) < 0 &&
            open("/dev/null", descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY) < 0)
            return;
    }
}

int reported_unforeseen(const char* what) {
    std::fprintf(stderr, "orograph: failed: %s\n", oro::one_line(what).c_str());
    return static_cast<int>(oro::ErrorKind::failed);
}

// Where memory or threads run out in a library that lets no exception pass, or it fails there for another
// reason (PROJ, when its database cannot be read any more), the program still ends in order. What is no
// exception of the library's is a programmer's mistake, and aborts.
[[noreturn]] void end_without_resources() {
    try {
        if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
        oro::end_out_of_memory();
    } catch (const std::exception& error) {
        oro::remove_unfinished_files();
        _exit(reported_unforeseen(error.what()));
    } catch (...) {
    }
    std::abort();
}

// The program's own in the first line, then those of the libraries that it reads and draws with.
std::string versions() {
    std::string text = "orograph " OROGRAPH_VERSION "\n";
    const oro::LibraryReport readers = oro::report_versions();
    text += "GDAL " + readers.gdal + ", PROJ " + readers.proj + ", GeographicLib " + readers.geographiclib;
    for (const oro::LibraryVersion& library : oro::library_versions())
        text += ", " + library.name + " " + library.version;
    return text;
}

int run_command_line(int argc, char** argv) {
    CLI::App app{about, "orograph"};
    app.require_subcommand(1);
    app.set_version_flag("--version", versions);
    oro::CommandLine line;
    oro::add_commands(app, line);
    const std::vector<std::string> words(argv, argv + argc);
    if (argc < 2) {
        std::fprintf(stderr, "orograph: no command is named\n\n%s", app.help().c_str());
        return static_cast<int>(oro::ErrorKind::usage);
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() != 0) return reported(oro::refusal_of(app, e, words));
        if (const auto no_command = oro::refusal_of_command(app, words)) return reported(*no_command);
        if (e.get_name() == "CallForHelp" && oro::asks_for_all_options(words))
            app.exit(CLI::CallForAllHelp());
        else
            app.exit(e);
        return exit_code({});
    }
    return exit_code(oro::run_command(app, line, words));
}

}  // namespace

int main(int argc, char** argv) {
    std::set_terminate(&end_without_resources);
    // A file that outgrows the shell's limit is a write that fails, and told as such.
    std::signal(SIGXFSZ, SIG_IGN);
    fill_standard_streams();
    oro::watch_libraries();
    // What was begun is undone on the way here: no half file stays.
    try {
        oro::remember_files_read();
        oro::clean_up_when_interrupted();
        return run_command_line(argc, argv);
    } catch (const std::bad_alloc&) {
        return oro::tell_out_of_memory();
    } catch (const std::exception& error) {
        return reported_unforeseen(error.what());
    } catch (...) {
        return reported_unforeseen("for a reason that nobody told");
    }
}
