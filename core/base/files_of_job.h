// Files of one job after the other, of a program that does many: what each has read and written, and what was
// written before it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace oro {

// A file as a job has read it.
struct FileOfJob {
    std::string path;
    std::int64_t bytes{};
    std::int64_t written_ns{};  // since 1970, by the file's mtime
};

// A job begins: what files_read.h has remembered is forgotten, and it remembers from now on. Files that were
// written since the last call, or since the first one, are those of other jobs: commit_together() and
// check_not_read() refuse to replace them. Not while threads read files.
void begin_files_of_job();
// From now on no job is watched: all is as if begin_files_of_job() had never been called, but what was read
// stays remembered.
void end_files_of_jobs();
// What was read since begin_files_of_job(), by name; forget_files_read() changes nothing of it, but files
// that forget_file_read() was called for are not among them.
std::vector<FileOfJob> files_read_of_job();
// For what gives a whole file its name: that it has it now. Does nothing where no job is watched.
void note_file_written(const std::string& path);
// Those that were noted since begin_files_of_job(), in order, each once.
std::vector<std::string> files_written_of_job();

// What was read so far, to be remembered again by a later job that uses what was made of it.
struct FilesReadSoFar;
std::shared_ptr<const FilesReadSoFar> files_read_so_far();
// Whether all of them are what they were when they were first read.
bool are_unchanged(const FilesReadSoFar& files);
// As if this job had read them, at the time at which they were read first.
void remember_again(const FilesReadSoFar& files);

}  // namespace oro
