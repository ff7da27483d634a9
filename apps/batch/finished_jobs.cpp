#include "apps/batch/finished_jobs.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "apps/fingerprints/fingerprints.h"
#include "apps/report/json_fields.h"
#include "apps/report/json_object.h"
#include "core/base/checksum.h"
#include "core/base/open_file.h"
#include "geo/files/network_files.h"
#include "geo/files/network_paths.h"

namespace oro {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string hexadecimal(std::uint64_t number) {
    std::array<char, 20> text{};
    std::snprintf(text.data(), text.size(), "%016" PRIx64, number);
    return text.data();
}

std::uint64_t number_in(const json& object, const char* name) {
    const std::string text = json_string(object, name);
    char* end = nullptr;
    const std::uint64_t number = std::strtoull(text.c_str(), &end, 16);
    if (text.size() != 16 || *end != '\0') throw JsonFault{"no fingerprint"};
    return number;
}

std::uint64_t checksum_of(const std::string& text, std::uint64_t seed) {
    return xxh64(std::as_bytes(std::span(text)), seed);
}

Result<WrittenByJob> checked_file(const std::string& path) {
    ORO_TRY(const OpenFile file, OpenFile::open(path, OpenFile::Use::read_own));
    WrittenByJob written{path, 0, 0, {}};
    ORO_TRY(written.bytes, file.size());
    RunningChecksum sum;
    std::vector<std::byte> some(std::size_t{1} << 18);
    for (std::uint64_t at = 0; at < written.bytes;) {
        const auto part = std::span(some).first(std::min<std::uint64_t>(written.bytes - at, some.size()));
        ORO_CHECK(file.read(at, part));
        sum.add(part);
        at += part.size();
    }
    written.checksum = sum.sum();
    return written;
}

Result<WrittenByJob> checked_folder(const std::string& path) {
    std::set<std::string> names;
    std::error_code failed;
    for (fs::recursive_directory_iterator entry(path, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        std::error_code ignored;
        if (entry->is_regular_file(ignored)) names.insert(entry->path().lexically_relative(path).string());
    }
    if (failed) return Error{ErrorKind::failed, path, "cannot be listed: " + failed.message()};
    WrittenByJob written{path, 0, 0, {}};
    for (const std::string& name : names) {
        ORO_TRY(const WrittenByJob one, checked_file((fs::path(path) / name).string()));
        written.bytes += one.bytes;
        written.checksum = checksum_of(name + '\0' + hexadecimal(one.checksum), written.checksum);
    }
    return written;
}

bool is_folder(const std::string& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

// Nothing of a file is read from a network to find out whether it is what it was.
Result<std::optional<WrittenByJob>> file_on_network(const std::string& path) {
    ORO_TRY(const std::optional<NetworkFile> there, network_file(path));
    if (!there) return std::optional<WrittenByJob>{};
    return std::optional(WrittenByJob{path, there->bytes, 0, there->version});
}

bool is_as_written(const WrittenByJob& written) {
    if (is_network_path(written.path)) {
        const auto now = file_on_network(written.path);
        return now.ok() && *now && (*now)->bytes == written.bytes && (*now)->version == written.version;
    }
    struct stat found {};
    if (stat(written.path.c_str(), &found) != 0) return false;
    if (S_ISREG(found.st_mode) && static_cast<std::uint64_t>(found.st_size) != written.bytes) return false;
    const auto now = S_ISDIR(found.st_mode) ? checked_folder(written.path) : checked_file(written.path);
    return now.ok() && now->bytes == written.bytes && now->checksum == written.checksum;
}

bool is_as_read(const FileOfJob& file) {
    struct stat found {};
    return stat(file.path.c_str(), &found) == 0 && found.st_size == file.bytes &&
           found.st_mtim.tv_sec * std::int64_t{1'000'000'000} + found.st_mtim.tv_nsec == file.written_ns;
}

std::uint64_t fingerprint_of_inputs(const std::vector<FileOfJob>& files) {
    std::uint64_t sum = files.size();
    for (const FileOfJob& file : files)
        sum = checksum_of(
            file.path + '\0' + std::to_string(file.bytes) + '\0' + std::to_string(file.written_ns), sum);
    return sum;
}

bool says_nothing_of_output(const std::string& word) {
    return word == "--overwrite" || word == "--json" || word == "--quiet" || word == "-q";
}

}  // namespace

std::uint64_t fingerprint_of_job(const BatchJob& job) {
    static const std::string program = program_fingerprint();
    std::string all = program + '\0' + job.print;
    for (const std::string& word : job.words)
        if (!says_nothing_of_output(word)) all += '\0' + word;
    // What is printed into a file is another text as JSON.
    if (!job.print.empty() && std::ranges::find(job.words, "--json") != job.words.end()) all += '\0';
    return checksum_of(all, 0);
}

Result<std::vector<WrittenByJob>> written_by_job(const BatchJob& job, const std::vector<std::string>& files) {
    std::vector<WrittenByJob> all;
    for (const std::string& file : files) {
        if (is_network_path(file)) {
            ORO_TRY(std::optional<WrittenByJob> one, file_on_network(file));
            if (one) all.push_back(std::move(*one));
            continue;
        }
        std::error_code ignored;
        if (!fs::is_regular_file(file, ignored)) continue;
        ORO_TRY(WrittenByJob one, checked_file(file));
        all.push_back(std::move(one));
    }
    for (const auto& [option, folder] : job.writes) {
        if (!is_folder(folder)) continue;
        const std::string inside = (fs::path(folder) / "").string();
        const bool has_files =
            std::ranges::any_of(all, [&](const WrittenByJob& one) { return one.path.starts_with(inside); });
        if (has_files) continue;
        ORO_TRY(WrittenByJob one, checked_folder(folder));
        all.push_back(std::move(one));
    }
    return all;
}

FinishedJobs::FinishedJobs(FinishedJobs&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      path_(std::move(other.path_)),
      files_(std::move(other.files_)),
      jobs_(std::move(other.jobs_)),
      inputs_(std::move(other.inputs_)),
      unchanged_(std::move(other.unchanged_)) {}

FinishedJobs& FinishedJobs::operator=(FinishedJobs&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    path_ = std::move(other.path_);
    files_ = std::move(other.files_);
    jobs_ = std::move(other.jobs_);
    inputs_ = std::move(other.inputs_);
    unchanged_ = std::move(other.unchanged_);
    return *this;
}

FinishedJobs::~FinishedJobs() {
    if (descriptor_ >= 0) close(descriptor_);
}

Result<FinishedJobs> FinishedJobs::look_at(const std::string& name) {
    FinishedJobs jobs;
    ORO_CHECK(jobs.read_all(name));
    return jobs;
}

Result<FinishedJobs> FinishedJobs::open(const std::string& name, const Shard& shard) {
    FinishedJobs jobs;
    jobs.path_ = name + shard_suffix(shard);
    const auto failed = [&](int why) {
        return Error{ErrorKind::failed, jobs.path_,
                     "cannot be written: " + system_reason(why) + " (--log names another place)"};
    };
    jobs.descriptor_ = ::open(jobs.path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (jobs.descriptor_ < 0) return failed(errno);
    struct stat found {};
    if (fstat(jobs.descriptor_, &found) != 0) return failed(errno);
    if (!S_ISREG(found.st_mode)) return Error{ErrorKind::failed, jobs.path_, "is no plain file"};
    if (flock(jobs.descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        return Error{ErrorKind::failed, jobs.path_, "is being written: another batch does these jobs now"};
    ORO_CHECK(jobs.read_all(name));
    char last = '\n';
    if (found.st_size > 0 && pread(jobs.descriptor_, &last, 1, found.st_size - 1) != 1) return failed(errno);
    if (last != '\n') ORO_CHECK(jobs.append(""));
    return jobs;
}

Result<void> FinishedJobs::read_all(const std::string& name) {
    const fs::path whole(name);
    const fs::path folder = whole.has_parent_path() ? whole.parent_path() : fs::path(".");
    std::error_code failed;
    std::set<std::string> found;
    for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        const std::string file = entry->path().filename().string(), base = whole.filename().string();
        if (file == base || file.starts_with(base + "-"))
            found.insert(whole.has_parent_path() ? entry->path().string() : file);
    }
    for (const std::string& file : found) {
        ORO_TRY(const OpenFile opened, OpenFile::open(file, OpenFile::Use::read_own));
        ORO_TRY(const std::uint64_t bytes, opened.size());
        if (bytes > most_list_bytes) return Error{ErrorKind::failed, file, "is larger than 1 GiB"};
        std::string text(static_cast<std::size_t>(bytes), '\0');
        ORO_CHECK(opened.read(0, std::as_writable_bytes(std::span(text))));
        for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != std::string::npos;
             begin = end + 1)
            take_line(text.substr(begin, end - begin));
        files_.push_back(file);
    }
    if (!path_.empty() && std::ranges::find(files_, path_) == files_.end()) files_.push_back(path_);
    return {};
}

// What is no record says nothing: its job is done again.
void FinishedJobs::take_line(const std::string& line) {
    try {
        const json record = parsed_json(line);
        if (record.contains("files")) {
            std::vector<FileOfJob> files;
            for (const json& file : record.at("files"))
                files.push_back({path_from(file, "path"), json_whole(file, "bytes", 0, INT64_MAX),
                                 json_whole(file, "written_ns", INT64_MIN, INT64_MAX)});
            if (fingerprint_of_inputs(files) == number_in(record, "inputs"))
                inputs_[number_in(record, "inputs")] = std::move(files);
            return;
        }
        Record job{{}, number_in(record, "inputs")};
        for (const json& file : record.at("written")) {
            WrittenByJob one{path_from(file, "path"),
                             static_cast<std::uint64_t>(json_whole(file, "bytes", 0, INT64_MAX)),
                             0,
                             {}};
            if (file.contains("version"))
                one.version = json_string(file, "version");
            else
                one.checksum = number_in(file, "xxh64");
            job.written.push_back(std::move(one));
        }
        jobs_[number_in(record, "job")] = std::move(job);
    } catch (const JsonFault&) {
    } catch (const json::exception&) {
    }
}

bool FinishedJobs::is_finished(const BatchJob& job) {
    const auto found = jobs_.find(fingerprint_of_job(job));
    if (found == jobs_.end() || found->second.written.empty()) return false;
    const auto inputs = inputs_.find(found->second.inputs);
    if (inputs == inputs_.end()) return false;
    auto known = unchanged_.find(inputs->first);
    if (known == unchanged_.end())
        known = unchanged_.emplace(inputs->first, std::ranges::all_of(inputs->second, is_as_read)).first;
    return known->second && std::ranges::all_of(found->second.written, is_as_written);
}

Result<void> FinishedJobs::append(const std::string& line) {
    const std::string text = line + "\n";
    errno = 0;
    // In one go, so that no two processes' lines are mixed where one name is shared.
    if (write(descriptor_, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
        fdatasync(descriptor_) == 0)
        return {};
    return Error{ErrorKind::failed, path_, "cannot be written: " + system_reason(errno ? errno : EIO)};
}

Result<void> FinishedJobs::add(const BatchJob& job, const std::vector<WrittenByJob>& written,
                               const std::vector<FileOfJob>& read) {
    if (written.empty()) return {};
    const std::uint64_t inputs = fingerprint_of_inputs(read);
    if (!inputs_.contains(inputs)) {
        nlohmann::ordered_json files = nlohmann::ordered_json::array();
        for (const FileOfJob& file : read)
            files.push_back(json_object("path", path_json(file.path), "bytes", file.bytes, "written_ns",
                                        file.written_ns));
        ORO_CHECK(append(json_object("inputs", hexadecimal(inputs), "files", files).dump()));
        inputs_[inputs] = read;
    }
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (const WrittenByJob& file : written) {
        nlohmann::ordered_json one = json_object("path", path_json(file.path), "bytes", file.bytes);
        if (file.version.empty())
            one["xxh64"] = hexadecimal(file.checksum);
        else
            one["version"] = file.version;
        files.push_back(std::move(one));
    }
    ORO_CHECK(append(json_object("job", hexadecimal(fingerprint_of_job(job)), "line", job.line, "inputs",
                                 hexadecimal(inputs), "written", files)
                         .dump()));
    jobs_[fingerprint_of_job(job)] = {written, inputs};
    return {};
}

}  // namespace oro
