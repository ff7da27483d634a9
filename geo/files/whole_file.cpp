#include "geo/files/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/file_target.h"
#include "core/base/files_of_job.h"
#include "core/base/files_read.h"
#include "core/base/open_file.h"
#include "geo/files/folder_around.h"
#include "geo/files/network_files.h"
#include "geo/files/network_paths.h"

namespace oro {
namespace {

Error fault(const std::string& path, const std::string& what) {
    return {ErrorKind::failed, path, what};
}

std::string temporary_folder() {
    const char* const named = std::getenv("TMPDIR");
    return named != nullptr && *named != '\0' ? named : "/tmp";
}

}  // namespace

bool WholeFile::is_on_network() const {
    return is_network_path(path_);
}

Result<WholeFile> WholeFile::create(const std::string& path, bool overwrite, Temporary kind) {
    ignore_size_limit_signal();
    WholeFile file;
    file.path_ = path;
    file.overwrite_ = overwrite;
    unsigned old_mode = 0;
    if (file.is_on_network()) {
        ORO_CHECK(check_network_target(path, overwrite));
    } else {
        ORO_TRY(old_mode, check_target(file.path_, overwrite));
    }
    const std::string folder = file.is_on_network() ? temporary_folder() : folder_around(file.path_);
    if (const int why = file.temporary_.make(folder, kind); why != 0) return not_made_in(folder, path, why);
    // A file that its owner had closed to others stays closed to them when it is replaced.
    if (old_mode != 0) (void)fchmod(file.temporary_.descriptor(), old_mode);
    // The lock is the temporary file's, and outlasts the stream.
    const int descriptor = fcntl(file.temporary_.descriptor(), F_DUPFD_CLOEXEC, 0);
    if (descriptor >= 0) file.stream_ = fdopen(descriptor, "w+b");
    if (!file.stream_) {
        const int why = errno;
        if (descriptor >= 0) close(descriptor);
        return fault(path, "cannot be written: " + system_reason(why));
    }
    return file;
}

WholeFile::WholeFile(WholeFile&& other) noexcept
    : stream_(std::exchange(other.stream_, nullptr)),
      path_(std::move(other.path_)),
      temporary_(std::move(other.temporary_)),
      overwrite_(other.overwrite_) {}

WholeFile& WholeFile::operator=(WholeFile&& other) noexcept {
    if (this == &other) return *this;
    abandon();
    stream_ = std::exchange(other.stream_, nullptr);
    path_ = std::move(other.path_);
    temporary_ = std::move(other.temporary_);
    overwrite_ = other.overwrite_;
    return *this;
}

WholeFile::~WholeFile() {
    abandon();
}

void WholeFile::abandon() noexcept {
    if (stream_) std::fclose(std::exchange(stream_, nullptr));
    temporary_ = TemporaryFile();
}

Result<void> WholeFile::write(const void* bytes, std::size_t count) {
    assert(stream_);
    errno = 0;
    if (std::fwrite(bytes, 1, count, stream_) == count) return {};
    return fault(path_, "cannot be written: " + system_reason(errno ? errno : EIO));
}

Result<void> WholeFile::settle() {
    assert(stream_);
    errno = 0;
    if (!std::ferror(stream_) && std::fflush(stream_) == 0 && fsync(fileno(stream_)) == 0) return {};
    return fault(path_, "cannot be written: " + system_reason(errno ? errno : EIO));
}

int WholeFile::take_name() {
    int why = temporary_.take_temporary_name();
    // A stream that was flushed and synced has nothing left to lose.
    if (std::fclose(std::exchange(stream_, nullptr)) != 0 && why == 0) why = errno;
    if (why == 0) why = take_file_name(temporary_.path(), path_, overwrite_);
    if (why == 0) temporary_.forget_name();
    return why;
}

Result<void> WholeFile::commit() {
    return commit_together({this});
}

Result<void> WholeFile::commit_own() {
    if (const auto settled = settle(); !settled.ok()) {
        abandon();
        return settled.error();
    }
    const NamesHeld held;
    if (const int why = take_name(); why != 0) {
        abandon();
        return fault(path_, "cannot be written: " + system_reason(why));
    }
    return {};
}

Result<void> WholeFile::commit_unsynced() {
    assert(stream_);
    errno = 0;
    int why = std::fflush(stream_) == 0 ? 0 : errno;
    const NamesHeld held;
    if (why == 0) why = temporary_.take_temporary_name();
    if (std::fclose(std::exchange(stream_, nullptr)) != 0 && why == 0) why = errno;
    if (why == 0 && std::rename(temporary_.path().c_str(), path_.c_str()) != 0) why = errno;
    if (why == 0) {
        temporary_.forget_name();
        return {};
    }
    abandon();
    return fault(path_, "cannot be written: " + system_reason(why));
}

// A name that was taken is given back to what had it, or was nobody's before.
void WholeFile::give_back(TemporaryFile& before, bool was_there) {
    const bool given = before.path().empty() ? !was_there && unlink(path_.c_str()) == 0
                                             : rename(before.path().c_str(), path_.c_str()) == 0;
    if (given) before.forget_name();
}

Result<void> WholeFile::send(TemporaryFile& before, bool keeps, bool& was_there) {
    // What appeared there since create() is somebody else's.
    ORO_CHECK(check_network_target(path_, overwrite_));
    if (keeps) {
        ORO_TRY(const std::optional<NetworkFile> there, network_file(path_));
        was_there = there.has_value();
        if (was_there) {
            if (const int why = before.make(temporary_folder(), Temporary::nameless); why != 0)
                return fault(path_, "cannot be kept: " + system_reason(why));
            ORO_CHECK(download_file(path_, before.descriptor()));
        }
    }
    return upload_file(temporary_.descriptor(), path_);
}

void WholeFile::take_back(const TemporaryFile& before, bool was_there) {
    (void)(was_there ? upload_file(before.descriptor(), path_) : remove_network_file(path_));
}

Result<void> commit_together(std::span<WholeFile* const> files) {
    struct Taken {
        WholeFile* file;
        bool was_there;
        TemporaryFile before;  // what had the name, by a second one; of a network, a copy
    };
    std::vector<Taken> sent;
    const auto failed = [&](const Error& error) {
        for (const Taken& other : sent) other.file->take_back(other.before, other.was_there);
        for (WholeFile* file : files) file->abandon();
        return error;
    };
    for (WholeFile* file : files) {
        if (const auto settled = file->settle(); !settled.ok()) return failed(settled.error());
        if (const auto spared = check_not_read(file->path_); !spared.ok()) return failed(spared.error());
    }
    // The last moment at which what was read can be held against what is written.
    if (const auto whole = check_files_unchanged(); !whole.ok()) return failed(whole.error());
    // What takes long comes first: a signal may end the program then.
    for (WholeFile* file : files) {
        if (!file->is_on_network()) continue;
        Taken now{file, false, {}};
        const bool is_last = sent.size() + 1 == files.size();
        if (const auto there = file->send(now.before, !is_last, now.was_there); !there.ok())
            return failed(there.error());
        sent.push_back(std::move(now));
    }
    const NamesHeld held;
    std::vector<Taken> taken;
    taken.reserve(files.size());  // nothing throws once a name is taken
    for (WholeFile* file : files) {
        if (file->is_on_network()) {
            file->abandon();
            continue;
        }
        Taken now{file, access(file->path_.c_str(), F_OK) == 0, {}};
        if (now.was_there && taken.size() + 1 < files.size()) (void)now.before.keep(file->path_);
        if (const int why = file->take_name(); why != 0) {
            for (Taken& other : taken) other.file->give_back(other.before, other.was_there);
            const bool appeared = why == EEXIST && !file->overwrite_;
            return failed(fault(file->path_, appeared
                                                 ? "appeared while it was being written, and is left as it is"
                                                 : "cannot be written: " + system_reason(why)));
        }
        taken.push_back(std::move(now));
    }
    for (const WholeFile* const file : files) note_file_written(file->path_);
    return {};
}

Result<void> write_whole_file(const std::string& path, const std::string& text, bool overwrite) {
    ORO_TRY(WholeFile file, WholeFile::create(path, overwrite));
    ORO_CHECK(file.write(text.data(), text.size()));
    return file.commit();
}

}  // namespace oro
