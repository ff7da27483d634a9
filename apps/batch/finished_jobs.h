// The record of jobs that are done: what each wrote, and what it was made from.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/batch/job_list.h"
#include "apps/options/shard.h"
#include "core/base/files_of_job.h"
#include "core/base/result.h"

namespace oro {

// What tells a job from all others: its words, but for those that change nothing of what it writes, and the
// program that does it.
std::uint64_t fingerprint_of_job(const BatchJob& job);

// A file that a job wrote, or a folder with all in it.
struct WrittenByJob {
    std::string path;
    std::uint64_t bytes{};
    std::uint64_t checksum{};  // XXH64; of a folder that of the names and checksums of its files
    std::string version;       // of a file on a network, in place of the checksum: as its server tells it
};

// Of what a job has written: of `files` (files_written_of_job()) those that are there, and of the folders
// that it was told to write those in which none of these is. Errors: a file that cannot be read.
Result<std::vector<WrittenByJob>> written_by_job(const BatchJob& job, const std::vector<std::string>& files);

// A file of JSON lines beside the list, NAME.done, and for a part of it NAME.done-2of4: each process has its
// own, reads all, and adds a line for each job that is done. A line that a power cut left half is no line.
class FinishedJobs {
  public:
    // name: of the record of the whole list. Errors: what cannot be read or written; another process that
    // does the same part.
    static Result<FinishedJobs> open(const std::string& name, const Shard& shard);
    // The same, to be asked and not to be added to: nothing is written.
    static Result<FinishedJobs> look_at(const std::string& name);
    FinishedJobs(FinishedJobs&&) noexcept;
    FinishedJobs& operator=(FinishedJobs&&) noexcept;
    ~FinishedJobs();

    // Whether a job is done: it has a line here, all that it wrote is there with the same bytes, and all that
    // it was made from has the size and the time that it had. A job that wrote nothing is never done.
    [[nodiscard]] bool is_finished(const BatchJob& job);
    // Adds one that is done, and puts it on the disk. Errors: the system's.
    Result<void> add(const BatchJob& job, const std::vector<WrittenByJob>& written,
                     const std::vector<FileOfJob>& read);
    // The files that there are of it: a job must not write them.
    [[nodiscard]] const std::vector<std::string>& files() const { return files_; }

  private:
    struct Record {
        std::vector<WrittenByJob> written;
        std::uint64_t inputs{};
    };
    FinishedJobs() = default;
    Result<void> read_all(const std::string& name);
    void take_line(const std::string& line);
    Result<void> append(const std::string& line);

    int descriptor_{-1};
    std::string path_;
    std::vector<std::string> files_;
    std::map<std::uint64_t, Record> jobs_;
    std::map<std::uint64_t, std::vector<FileOfJob>> inputs_;  // by their fingerprint
    std::map<std::uint64_t, bool> unchanged_;                 // of inputs that were asked about
};

}  // namespace oro
