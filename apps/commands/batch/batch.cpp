// orograph batch: the commands of a list, one after the other, with what they share kept between them.
#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "apps/batch/finished_jobs.h"
#include "apps/batch/job_conflicts.h"
#include "apps/batch/job_list.h"
#include "apps/commands/batch/batch_job.h"
#include "apps/commands/batch/batch_report.h"
#include "apps/commands/commands.h"
#include "apps/drawing/kept_drawing.h"
#include "apps/report/figures.h"
#include "apps/report/progress_bar.h"
#include "core/base/elapsed.h"
#include "core/base/files_of_job.h"
#include "geo/opening/open_region.h"

namespace oro {
namespace {

// Regions, scene and GPU stay from job to job as long as it is there.
class KeptBetweenJobs {
  public:
    KeptBetweenJobs() {
        keep_last_region();
        keep_drawing();
    }
    KeptBetweenJobs(const KeptBetweenJobs&) = delete;
    KeptBetweenJobs& operator=(const KeptBetweenJobs&) = delete;
    ~KeptBetweenJobs() {
        keep_no_drawing();
        keep_no_region();
        end_files_of_jobs();
    }
    // Before a job of that command.
    void begin(const BatchJob& job) {
        begin_files_of_job();
        if (job.command != "shot") keep_no_scene();
    }
    // A device may be lost, and memory short: the next job has new ones.
    void recover() {
        keep_no_drawing();
        keep_drawing();
    }
};

// Those of the shard, ordered so that jobs of one region follow each other, each region where the list names
// it first.
std::vector<const BatchJob*> jobs_of_shard(const std::vector<BatchJob>& jobs, const Shard& shard) {
    std::vector<const BatchJob*> mine;
    std::map<std::string, std::size_t> first;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        if (!shard.holds(i)) continue;
        mine.push_back(&jobs[i]);
        first.emplace(jobs[i].region, i);
    }
    std::ranges::stable_sort(mine, {}, [&](const BatchJob* job) { return first.at(job->region); });
    return mine;
}

// All that one run of a list goes by.
struct Batch {
    const BatchOptions& options;
    FinishedJobs& finished;
    BatchReport& report;
    ProgressBar& bar;
};

// A line of a list, as messages name it.
Error of_line(const std::string& list, const LineReport& line, const Error& error) {
    return {error.kind,
            list + ", line " + std::to_string(line.line) + (line.place.empty() ? "" : ", " + line.place),
            error.line()};
}

LineReport& begun_line(BatchReport& report, const BatchJob& job) {
    LineReport& line = report.lines.emplace_back();
    line.line = job.line;
    line.place = job.place;
    line.command = job.command;
    return line;
}

void tell_failed(const Batch& batch, LineReport& line, const Error& error) {
    line.state = LineState::failed;
    line.error = error;
    batch.bar.clear();
    std::fprintf(stderr, "orograph: %s\n", of_line(batch.options.jobs, line, error).line().c_str());
}

// What a job has printed goes on, or is kept for the summary.
void pass_on(const Batch& batch, std::string printed, LineReport& line) {
    if (printed.empty()) return;
    if (batch.options.json) {
        line.printed = std::move(printed);
        return;
    }
    batch.bar.clear();
    std::fwrite(printed.data(), 1, printed.size(), stdout);
    std::fflush(stdout);
}

// Frames in a folder are looked at by film itself: it keeps those that are whole.
bool keeps_its_own_record(const BatchJob& job) {
    return job.command == "film" && std::ranges::none_of(job.writes, [](const NamedOutput& one) {
               return one.file.ends_with(".mp4");
           });
}

Result<void> record(const Batch& batch, const BatchJob& job, LineReport& line) {
    ORO_TRY(line.written, written_by_job(job, files_written_of_job()));
    if (keeps_its_own_record(job)) return {};
    return batch.finished.add(job, line.written, files_read_of_job());
}

// One job, done or told that it failed. Errors: the record of what is done cannot be written.
Result<void> do_job(const Batch& batch, KeptBetweenJobs& kept, const BatchJob& job, LineReport& line) {
    const auto start = Clock::now();
    if (!job.fault && batch.finished.is_finished(job)) {
        line.state = LineState::kept;
        return {};
    }
    kept.begin(job);
    std::string printed;
    const Result<void> result = run_job(job, {batch.options.overwrite}, printed);
    line.seconds = seconds_since(start);
    pass_on(batch, std::move(printed), line);
    if (!result.ok()) {
        tell_failed(batch, line, result.error());
        if (result.error().kind != ErrorKind::usage) kept.recover();
        return {};
    }
    line.state = LineState::done;
    return record(batch, job, line);
}

std::string progress_words(const BatchReport& report, std::size_t at, std::size_t all, double elapsed_s) {
    const std::size_t failed = report.count(LineState::failed);
    const std::size_t ran = report.count(LineState::done) + failed;
    std::string text = grouped(at) + " of " + grouped(all) + " lines";
    if (failed > 0) text += ", " + grouped(failed) + " failed";
    if (ran > 0)
        text += ", " + duration_words(elapsed_s / static_cast<double>(ran) * static_cast<double>(all - at)) +
                " left";
    return text;
}

Result<void> do_jobs(const Batch& batch, const std::vector<const BatchJob*>& jobs) {
    const auto start = Clock::now();
    KeptBetweenJobs kept;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        batch.bar.show(static_cast<double>(i) / static_cast<double>(jobs.size()),
                       progress_words(batch.report, i, jobs.size(), seconds_since(start)));
        ORO_CHECK(do_job(batch, kept, *jobs[i], begun_line(batch.report, *jobs[i])));
    }
    batch.report.regions_read = regions_read();
    batch.report.seconds = seconds_since(start);
    return {};
}

// Looks at each line, and does nothing.
void check_jobs(const Batch& batch, const std::vector<const BatchJob*>& jobs) {
    for (const BatchJob* const job : jobs) {
        LineReport& line = begun_line(batch.report, *job);
        if (const auto taken = check_job(*job); !taken.ok())
            tell_failed(batch, line, taken.error());
        else if (batch.finished.is_finished(*job))
            line.state = LineState::kept;
    }
}

Result<void> end_of(const Batch& batch) {
    batch.bar.clear();
    std::ranges::stable_sort(batch.report.lines, {}, &LineReport::line);
    tell_batch(batch.options, batch.report);
    const std::size_t failed = batch.report.count(LineState::failed);
    if (failed == 0) return {};
    return Error{
        ErrorKind::failed, batch.options.jobs,
        grouped(failed) + " of " + counted(batch.report.lines.size(), "line", "lines") +
            (batch.options.check ? " cannot be done" : " failed; the same command tries them again")};
}

}  // namespace

Result<void> run_batch(const BatchOptions& options) {
    BatchReport report;
    ORO_TRY(report.shard, parse_shard(options.shard));
    PlacesOfFile places;
    if (!options.each.empty()) {
        ORO_TRY(places, read_places(options.each));
    }
    for (const std::string& note : places.notes) say(options.quiet, "note: " + note);
    ORO_TRY(std::vector<BatchJob> jobs, read_jobs(options.jobs, places.all));
    const std::string log = options.log.empty() ? options.jobs + ".done" : options.log;
    ORO_TRY(FinishedJobs finished,
            options.check ? FinishedJobs::look_at(log) : FinishedJobs::open(log, report.shard));
    std::vector<std::string> spared = finished.files();
    spared.push_back(options.jobs);
    if (!options.each.empty()) spared.push_back(options.each);
    find_conflicts(options.jobs, spared, jobs);
    report.lines_of_list = jobs.size();
    ProgressBar bar(options.quiet);
    const Batch batch{options, finished, report, bar};
    const std::vector<const BatchJob*> mine = jobs_of_shard(jobs, report.shard);
    if (options.check)
        check_jobs(batch, mine);
    else
        ORO_CHECK(do_jobs(batch, mine));
    return end_of(batch);
}

}  // namespace oro
