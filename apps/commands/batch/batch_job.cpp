#include "apps/commands/batch/batch_job.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <new>
#include <optional>

#include "apps/command_line/refusals.h"
#include "apps/commands/command_line.h"
#include "apps/commands/run_command.h"
#include "apps/output/captured_output.h"
#include "apps/output/overwrite_guard.h"
#include "geo/files/network_paths.h"
#include "geo/files/whole_file.h"

namespace oro {
namespace {

// A command line of a job, with what it was parsed into.
struct JobLine {
    CLI::App app{"", "orograph"};
    CommandLine line;
    std::vector<std::string> words{"orograph"};
};

bool has_option(CLI::App& app, const std::string& command, const char* option) {
    return app.get_subcommand(command)->get_option_no_throw(option) != nullptr;
}

bool says(const std::vector<std::string>& words, std::initializer_list<const char*> names) {
    return std::ranges::any_of(
        words, [&](const std::string& word) { return std::ranges::find(names, word) != names.end(); });
}

Result<void> parse(JobLine& parsed) {
    std::vector<const char*> arguments;
    for (const std::string& word : parsed.words) arguments.push_back(word.c_str());
    try {
        parsed.app.parse(static_cast<int>(arguments.size()), arguments.data());
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() != 0) return refusal_of(parsed.app, e, parsed.words);
        return refused("--help", "", "is nothing for a list of jobs");
    }
    return {};
}

// The job's command line, parsed.
Result<std::unique_ptr<JobLine>> line_of(const BatchJob& job, const JobSettings& settings) {
    auto made = std::make_unique<JobLine>();
    made->app.require_subcommand(1);
    add_commands(made->app, made->line);
    made->words.insert(made->words.end(), job.words.begin(), job.words.end());
    if (has_option(made->app, job.command, "--quiet") && !says(job.words, {"--quiet", "-q"}))
        made->words.emplace_back("--quiet");
    if (settings.overwrite && has_option(made->app, job.command, "--overwrite") &&
        !says(job.words, {"--overwrite"}))
        made->words.emplace_back("--overwrite");
    ORO_CHECK(parse(*made));
    // GDAL has been started without a network by now.
    if (made->line.fetching.network && !are_network_paths_allowed())
        return refused("--network", "", "must be given to batch itself");
    const auto parsed = made->app.get_subcommands();
    if (parsed.size() != 1 || parsed.front()->get_name() != job.command)
        return refused("args", "", "names another command");
    return made;
}

Result<void> run_parsed(JobLine& parsed, std::string& printed) {
    ORO_TRY(CapturedOutput output, CapturedOutput::begin());
    const Result<void> result = run_command(parsed.app, parsed.line, parsed.words);
    ORO_TRY(printed, output.end());
    return result;
}

Result<void> run_throwing(const BatchJob& job, const JobSettings& settings, std::string& printed) {
    ORO_TRY(const std::unique_ptr<JobLine> parsed, line_of(job, settings));
    const bool overwrite = settings.overwrite || says(job.words, {"--overwrite"});
    if (!job.print.empty()) ORO_CHECK(check_may_write(job.print, overwrite));
    ORO_CHECK(run_parsed(*parsed, printed));
    if (job.print.empty()) return {};
    ORO_CHECK(write_whole_file(job.print, printed, overwrite));
    printed.clear();
    return {};
}

}  // namespace

Result<void> check_job(const BatchJob& job) {
    if (job.fault) return *job.fault;
    ORO_TRY(const std::unique_ptr<JobLine> parsed, line_of(job, {}));
    return {};
}

Result<void> run_job(const BatchJob& job, const JobSettings& settings, std::string& printed) {
    if (job.fault) return *job.fault;
    try {
        return run_throwing(job, settings, printed);
    } catch (const std::bad_alloc&) {
        return Error{ErrorKind::failed, job.command, "not enough memory"};
    } catch (const std::exception& fault) {
        return Error{ErrorKind::failed, job.command, fault.what()};
    }
}

}  // namespace oro
