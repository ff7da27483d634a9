#include "core/base/files_read.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/files_of_job.h"
#include "core/base/open_file.h"

namespace oro {
namespace {

using Identity = std::pair<std::uint64_t, std::uint64_t>;  // device and number

struct StateAtOpening {
    Identity identity;
    std::int64_t bytes{};
    std::chrono::nanoseconds written{};  // since 1970, by the file's mtime, which any program may set
    std::chrono::nanoseconds touched{};  // by its ctime, which only the system sets
    // What a change of ctime alone may come from: links, rights and owners.
    std::array<std::uint64_t, 4> record{};
};

struct FilesRead {
    std::mutex mutex;
    bool remembers{};
    std::map<std::string, StateAtOpening> states;
    std::set<Identity> replaceable;
    std::string changed, how;  // the first that was another when it was opened again
    // Of jobs (files_of_job.h).
    bool has_jobs{};
    std::map<std::string, StateAtOpening> states_of_job;
    std::vector<std::string> written;
    std::map<Identity, std::string> written_before;  // by other jobs
};

// Until the end of the program: threads may still read.
FilesRead& files_read() {
    static auto* const all = new FilesRead;
    return *all;
}

StateAtOpening state_of(const struct stat& found) {
    const auto time = [](const timespec& at) {
        return std::chrono::seconds(at.tv_sec) + std::chrono::nanoseconds(at.tv_nsec);
    };
    return {{found.st_dev, found.st_ino},
            found.st_size,
            time(found.st_mtim),
            time(found.st_ctim),
            {found.st_nlink, found.st_mode, found.st_uid, found.st_gid}};
}

// "" where nothing has changed.
std::string change_between(const StateAtOpening& before, const StateAtOpening& now) {
    if (before.identity != now.identity) return "another file has its name now";
    if (before.bytes != now.bytes)
        return "it had " + std::to_string(before.bytes) + " bytes, and has " + std::to_string(now.bytes);
    if (before.written != now.written) return "it was written to meanwhile";
    // A link or other rights set ctime and change no byte; who reads sets neither time.
    if (before.touched != now.touched && before.record == now.record)
        return "it was written to meanwhile, and its time was set back";
    return "";
}

Error changed_while_read(const std::string& path, const std::string& how) {
    return {
        ErrorKind::failed, path,
        "was changed while it was read (" + how + "): nothing is made of it; try again when it is complete"};
}

// Times of files move on with the system's clock ticks, which may be 10 ms long: a file whose last change is
// older than this shows the next one.
constexpr std::chrono::milliseconds longest_tick{20};

bool is_recent(const StateAtOpening& state) {
    using namespace std::chrono;
    const auto age = system_clock::now().time_since_epoch() - std::max(state.written, state.touched);
    return age >= nanoseconds(0) && age < longest_tick;
}

StateAtOpening state_when_settled(const std::string& path, const struct stat& found) {
    StateAtOpening state = state_of(found);
    for (int i = 0; i < 5 && is_recent(state); ++i) {
        std::this_thread::sleep_for(longest_tick);
        struct stat again {};
        if (stat(path.c_str(), &again) != 0 || state_of(again).identity != state.identity) break;
        state = state_of(again);
    }
    return state;
}

}  // namespace

void remember_files_read() {
    FilesRead& all = files_read();
    const std::scoped_lock lock(all.mutex);
    all.remembers = true;
}

void forget_files_read() {
    FilesRead& all = files_read();
    const std::scoped_lock lock(all.mutex);
    all.remembers = false;
    all.states.clear();
    all.changed.clear();
}

void forget_file_read(const std::string& path) {
    FilesRead& all = files_read();
    const std::scoped_lock lock(all.mutex);
    all.states.erase(path);
    all.states_of_job.erase(path);
    if (all.changed == path) all.changed.clear();
}

void remember_file_read(const std::string& path, const struct stat& found) {
    if (!S_ISREG(found.st_mode)) return;
    FilesRead& all = files_read();
    const auto note = [&](const StateAtOpening& state, bool is_settled) {
        const std::scoped_lock lock(all.mutex);
        if (!all.remembers) return true;
        const auto known = all.states.find(path);
        if (known == all.states.end()) {
            if (is_settled) {
                all.states.emplace(path, state);
                if (all.has_jobs) all.states_of_job.emplace(path, state);
            }
            return is_settled;
        }
        if (std::string how = change_between(known->second, state); !how.empty() && all.changed.empty()) {
            all.changed = path;
            all.how = std::move(how);
        }
        return true;
    };
    const StateAtOpening state = state_of(found);
    if (!note(state, !is_recent(state))) note(state_when_settled(path, found), true);
}

Result<void> check_files_unchanged() {
    FilesRead& all = files_read();
    const std::scoped_lock lock(all.mutex);
    if (!all.changed.empty()) return changed_while_read(all.changed, all.how);
    for (const auto& [path, before] : all.states) {
        struct stat found {};
        if (stat(path.c_str(), &found) != 0) {
            if (errno == ENOENT || errno == ENOTDIR) return changed_while_read(path, "it is gone");
            return Error{ErrorKind::failed, path, "cannot be asked about: " + system_reason(errno)};
        }
        if (const std::string how = change_between(before, state_of(found)); !how.empty())
            return changed_while_read(path, how);
    }
    return {};
}

Result<void> check_not_read(const std::string& target) {
    struct stat found {};
    if (stat(target.c_str(), &found) != 0) {
        // What leads to nothing cannot be lost.
        if (errno == ENOENT || errno == ENOTDIR || errno == ENAMETOOLONG || errno == ELOOP) return {};
        return Error{ErrorKind::failed, target, "cannot be asked about: " + system_reason(errno)};
    }
    const Identity identity = state_of(found).identity;
    FilesRead& all = files_read();
    const std::scoped_lock lock(all.mutex);
    if (all.replaceable.contains(identity)) return {};
    for (const auto& [path, state] : all.states) {
        if (state.identity == identity)
            return Error{ErrorKind::usage, "--out",
                         "would replace " + path + ", which is read here" +
                             (path == target ? "" : " (by the name " + target + ")")};
    }
    if (const auto before = all.written_before.find(identity); before != all.written_before.end())
        return Error{ErrorKind::usage, "--out",
                     "would replace " + before->second + ", which another job wrote"};
    return {};
}

void let_replace(const std::string& target) {
    struct stat found {};
    if (stat(target.c_str(), &found) != 0) return;
    FilesRead& all = files_read();
    const std::scoped_lock lock(all.mutex);
    all.replaceable.insert(state_of(found).identity);
}

struct FilesReadSoFar {
    std::map<std::string, StateAtOpening> states;
};

void begin_files_of_job() {
    FilesRead& all = files_read();
    const std::scoped_lock lock(all.mutex);
    for (const std::string& path : all.written) {
        struct stat found {};
        if (stat(path.c_str(), &found) == 0) all.written_before[state_of(found).identity] = path;
    }
    all.has_jobs = all.remembers = true;
    all.states.clear();
    all.states_of_job.clear();
    all.replaceable.clear();
    all.changed.clear();
    all.written.clear();
}

void end_files_of_jobs() {
    FilesRead& all = files_read();
    const std::scoped_lock lock(all.mutex);
    all.has_jobs = false;
    all.states_of_job.clear();
    all.written.clear();
    all.written_before.clear();
}

std::vector<FileOfJob> files_read_of_job() {
    FilesRead& all = files_read();
    const std::scoped_lock lock(all.mutex);
    std::vector<FileOfJob> files;
    for (const auto& [path, state] : all.states_of_job)
        files.push_back({path, state.bytes, state.written.count()});
    return files;
}

void note_file_written(const std::string& path) {
    FilesRead& all = files_read();
    const std::scoped_lock lock(all.mutex);
    if (all.has_jobs && std::ranges::find(all.written, path) == all.written.end())
        all.written.push_back(path);
}

std::vector<std::string> files_written_of_job() {
    FilesRead& all = files_read();
    const std::scoped_lock lock(all.mutex);
    return all.written;
}

std::shared_ptr<const FilesReadSoFar> files_read_so_far() {
    FilesRead& all = files_read();
    const std::scoped_lock lock(all.mutex);
    return std::make_shared<const FilesReadSoFar>(FilesReadSoFar{all.states});
}

bool are_unchanged(const FilesReadSoFar& files) {
    return std::ranges::all_of(files.states, [](const auto& file) {
        struct stat found {};
        return stat(file.first.c_str(), &found) == 0 && change_between(file.second, state_of(found)).empty();
    });
}

void remember_again(const FilesReadSoFar& files) {
    FilesRead& all = files_read();
    const std::scoped_lock lock(all.mutex);
    if (!all.remembers) return;
    all.states.insert(files.states.begin(), files.states.end());
    if (all.has_jobs) all.states_of_job.insert(files.states.begin(), files.states.end());
}

}  // namespace oro
