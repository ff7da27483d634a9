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
#include <system_error>

#include "apps/commands/commands.h"
#include "apps/output/interruption.h"
#include "geo/files/whole_file.h"
#include "geo/sources/library_faults.h"

namespace {

constexpr const char* about =
    "Orograph draws real terrain at its place on the ellipsoid and writes pictures that know where they were "
    "taken from.";
constexpr const char* exit_codes =
    "Exit: 0 done, 1 failed, 2 usage, 3 no data in the region, 4 no suitable GPU.";

void add_shot(CLI::App& app, oro::ShotOptions& options) {
    CLI::App& command =
        *app.add_subcommand("shot", "Write a geotagged picture (.png, .jpg, .tif) that carries its view");
    oro::add_region_options(command, options.region);
    oro::add_view_options(command, options.view);
    oro::add_memory_options(command, options.memory);
    command.add_option(
        "--view", options.view_file,
        "Take sources and eye from a picture that carries its view, or from a view in a .json");
    command.add_option("--out", options.out, "The picture to write");
    command.add_flag("--verify", options.verify,
                     "Measure the picture against the full resolution, in metres and pixels, and write "
                     "NAME.error.png beside it");
    oro::add_no_paths(command, options.no_paths);
    command.add_flag("--overwrite", options.overwrite, "Replace files that are there");
    command.add_flag("--json", options.json, "Print one JSON object about the picture on standard output");
    command.add_flag("-q,--quiet", options.quiet, "Say nothing but errors, and the table of --verify");
}

void add_compare(CLI::App& app, oro::CompareOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "compare", "Measure a picture's view against the full resolution: how far off it is drawn");
    command
        .add_option("PICTURE", options.view_file,
                    "A picture that carries its view, or a view in a .json; PATHs after it are its data, "
                    "if they lie elsewhere now")
        ->required();
    oro::add_region_options(command, options.region);
    oro::add_memory_options(command, options.memory);
    command.add_option("--out", options.out, "The picture of errors to write (.png)");
    command.add_flag("--overwrite", options.overwrite, "Replace a file that is there");
    command.add_flag("--json", options.json, "Print one JSON object about the errors on standard output");
    command.add_flag("-q,--quiet", options.quiet, "Say nothing but the table and errors");
}

void add_view(CLI::App& app, oro::WindowOptions& options) {
    CLI::App& command = *app.add_subcommand("view", "Fly over a region in a window");
    command.footer(
        "W A S D: move. Space, Ctrl: up, down. Shift: faster. Mouse drag or Q E R F: look. Right click: what "
        "is "
        "there, in the title and on standard output. G: go to a place. P: write a geotagged picture here. "
        "Esc: leave.");
    oro::add_region_options(command, options.region);
    oro::add_view_options(command, options.view);
    oro::add_memory_options(command, options.memory);
    command.add_option("--view", options.view_file,
                       "Start from a picture that carries its view, or from a view in a .json");
    oro::add_no_paths(command, options.no_paths);
    command.add_flag("-q,--quiet", options.quiet, "Say nothing but errors");
}

void add_plan(CLI::App& app, oro::PlanOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "plan", "Predict how far off a view would be, and what makes it so: in metres and pixels");
    oro::add_region_options(command, options.region);
    oro::add_view_options(command, options.view);
    command.add_option(
        "--view", options.view_file,
        "Take sources and eye from a picture that carries its view, or from a view in a .json");
    command.add_flag("--json", options.json, "Print one JSON object on standard output");
    command.add_flag("-q,--quiet", options.quiet, "Say nothing but the table and errors");
}

void add_trade(CLI::App& app, oro::TradeOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "trade", "Draw views with all settings, measure time and true error, write trade.csv and trade.html");
    command.footer("Views: the one of --at or --view; without, a set from all heights over the region.");
    oro::add_region_options(command, options.region);
    oro::add_view_options(command, options.view);
    oro::add_memory_options(command, options.memory);
    command.add_option(
        "--view", options.view_file,
        "Take sources and eye from a picture that carries its view, or from a view in a .json");
    oro::only_decimal(command.add_option("--views", options.views, "Views of the set (default 6)"))
        ->check(CLI::Range(1, 1000));
    oro::only_decimal(command.add_option("--repeats", options.repeats,
                                         "Times each picture is drawn; the median counts (default 3)"))
        ->check(CLI::Range(1, 1000));
    command.add_option("--out", options.out, "The folder to write into (default: this one)");
    command.add_flag("--overwrite", options.overwrite, "Replace files that are there");
    command.add_flag("-q,--quiet", options.quiet, "Say nothing but the table and errors");
}

void add_bake(CLI::App& app, oro::BakingOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "bake", "Write a region with all its levels into one file (.oro) that opens at once");
    command.footer(
        "One that was broken off leaves FILE.oro.partial and FILE.oro.partial-stitched; the same command "
        "goes on "
        "from there.");
    oro::add_region_options(command, options.region);
    command.add_option("--out", options.out, "The file to write (.oro)");
    command.add_flag("--overwrite", options.overwrite, "Replace a file that is there");
    command.add_flag("--json", options.json, "Print one JSON object about the file on standard output");
    command.add_flag("-q,--quiet", options.quiet, "Say nothing but errors");
}

void add_info(CLI::App& app, oro::InfoOptions& options) {
    CLI::App& command = *app.add_subcommand("info", "Tell what elevation data are and what is missing");
    oro::add_region_options(command, options.region);
    command.add_flag("--check", options.check, "Read every page of a .oro and tell the first damage");
    command.add_flag("--json", options.json, "Print one JSON object on standard output");
    command.add_flag("-q,--quiet", options.quiet, "Say nothing but errors");
}

void add_doctor(CLI::App& app, oro::DoctorOptions& options) {
    CLI::App& command = *app.add_subcommand("doctor", "Tell what this machine has and what each lack means");
    command.add_flag("--json", options.json, "Print one JSON object on standard output");
}

// `--tau "$TAU"` with nothing in TAU must not mean that there is no --tau.
void check_values(CLI::App& app) {
    const auto fault = [](const std::string& text) { return std::string(text.empty() ? "is empty" : ""); };
    for (CLI::App* command : app.get_subcommands({})) {
        for (CLI::Option* option : command->get_options()) {
            if (option->get_items_expected_max() > 0) option->check(fault);
        }
    }
}

int told(const oro::Error& error) {
    std::fprintf(stderr, "orograph: %s\n", error.line().c_str());
    return static_cast<int>(error.kind);
}

// What a command printed has arrived, or the command has failed: `orograph info > file` on a full disk.
int exit_code(const oro::Result<void>& result) {
    if (!result.ok()) return told(result.error());
    std::cout.flush();
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout) return 0;
    return told({oro::ErrorKind::failed, "standard output",
                 "cannot be written: " + std::generic_category().message(errno != 0 ? errno : EIO)});
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

// What of the command line no command takes.
std::string left_over(const CLI::App& app) {
    std::string all;
    for (const std::string& word : app.remaining(true)) all += (all.empty() ? "" : " ") + word;
    return all;
}

// Which command there is none of, which word or value is wrong; for the rest, the parser's own words.
oro::Error usage_error(const CLI::App& app, int argc, char** argv, const CLI::ParseError& error) {
    const auto is_named = [&](const CLI::App* command) { return command->get_name() == argv[1]; };
    if (argc > 1 && argv[1][0] != '-' && app.get_subcommands(is_named).empty())
        return {oro::ErrorKind::usage, argv[1],
                "is no command; these are shot, compare, plan, trade, view, bake, info and doctor"};
    const std::string more = " (orograph --help tells more)", raw = error.what();
    if (dynamic_cast<const CLI::RequiredError*>(&error) && app.get_subcommands().empty())
        return {oro::ErrorKind::usage, "",
                "name a command: shot, compare, plan, trade, view, bake, info or doctor" + more};
    if (dynamic_cast<const CLI::ExtrasError*>(&error))
        return {oro::ErrorKind::usage, left_over(app), "there is no such option or path here" + more};
    // "Could not convert: --above = 300m"; what is converted here are numbers.
    const std::size_t name = raw.find(": "), value = raw.find(" = ");
    if (dynamic_cast<const CLI::ConversionError*>(&error) && name < value && value != std::string::npos)
        return {oro::ErrorKind::usage, raw.substr(name + 2, value - name - 2),
                "'" + raw.substr(value + 3) + "' is not a number" + more};
    return {oro::ErrorKind::usage, "", raw + more};
}

int told_unforeseen(const char* what) {
    std::fprintf(stderr, "orograph: failed: %s\n", what);
    return static_cast<int>(oro::ErrorKind::failed);
}

// Where memory or threads run out in a library that lets no exception pass, the program still ends in order.
// Anything else that nobody caught is a programmer's mistake, and aborts.
[[noreturn]] void end_without_resources() {
    try {
        if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
        oro::end_out_of_memory();
    } catch (const std::system_error& error) {
        oro::remove_unfinished_files();
        _exit(told_unforeseen(error.what()));
    } catch (...) {
    }
    std::abort();
}

int run_command_line(int argc, char** argv) {
    CLI::App app{about, "orograph"};
    app.footer(exit_codes);
    app.require_subcommand(1);
    app.set_version_flag("--version", "orograph " OROGRAPH_VERSION);
    oro::ShotOptions shot;
    oro::CompareOptions compare;
    oro::WindowOptions view;
    oro::PlanOptions plan;
    oro::TradeOptions trade;
    oro::BakingOptions bake;
    oro::InfoOptions info;
    oro::DoctorOptions doctor;
    add_shot(app, shot);
    add_compare(app, compare);
    add_view(app, view);
    add_plan(app, plan);
    add_trade(app, trade);
    add_bake(app, bake);
    add_info(app, info);
    add_doctor(app, doctor);
    check_values(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() != 0) return told(usage_error(app, argc, argv, e));
        app.exit(e);
        return exit_code({});
    }
    if (app.got_subcommand("shot")) return exit_code(oro::run_shot(shot));
    if (app.got_subcommand("compare")) return exit_code(oro::run_compare(compare));
    if (app.got_subcommand("view")) return exit_code(oro::run_view(view));
    if (app.got_subcommand("plan")) return exit_code(oro::run_plan(plan));
    if (app.got_subcommand("trade")) {
        for (int i = 0; i < argc; ++i) trade.command += (i > 0 ? " " : "") + std::string(argv[i]);
        return exit_code(oro::run_trade(trade));
    }
    if (app.got_subcommand("bake")) return exit_code(oro::run_bake(bake));
    if (app.got_subcommand("info")) return exit_code(oro::run_info(info));
    return exit_code(oro::run_doctor(doctor));
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
        oro::clean_up_when_interrupted();
        return run_command_line(argc, argv);
    } catch (const std::bad_alloc&) {
        return oro::tell_out_of_memory();
    } catch (const std::exception& error) {
        return told_unforeseen(error.what());
    } catch (...) {
        return told_unforeseen("for a reason that nobody told");
    }
}
