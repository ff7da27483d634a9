#include "core/base/open_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "core/base/files_read.h"

namespace oro {

std::string system_reason(int error_number) {
    return std::generic_category().message(error_number);
}

Result<OpenFile> OpenFile::open(const std::string& path, Use use) {
    if (path.empty()) return Error{ErrorKind::usage, "", "the name of the region file is empty"};
    if (path.find('\0') != std::string::npos)
        return Error{ErrorKind::usage, path.c_str(), "a file name cannot hold a zero byte"};
    // Not to wait for somebody at the other end of a pipe.
    const bool reads = use != Use::write;
    const int flags = O_CLOEXEC | O_NONBLOCK | (reads ? O_RDONLY : O_RDWR | O_CREAT | O_NOFOLLOW);
    const int descriptor = ::open(path.c_str(), flags, 0666);
    const std::string doing = reads ? "cannot be opened: " : "cannot be written: ";
    if (descriptor < 0) return Error{ErrorKind::failed, path, doing + system_reason(errno)};
    OpenFile file(descriptor, path);
    struct stat found {};
    if (fstat(descriptor, &found) != 0) return file.fault(doing, errno);
    if (S_ISDIR(found.st_mode)) return Error{ErrorKind::failed, path, "is a folder"};
    if (!S_ISREG(found.st_mode)) return Error{ErrorKind::failed, path, "is no plain file"};
    if (use == Use::read) remember_file_read(path, found);
    return file;
}

OpenFile::OpenFile(OpenFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), path_(std::move(other.path_)) {}

OpenFile& OpenFile::operator=(OpenFile&& other) noexcept {
    if (this == &other) return *this;
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = std::exchange(other.descriptor_, -1);
    path_ = std::move(other.path_);
    return *this;
}

OpenFile::~OpenFile() {
    if (descriptor_ >= 0) close(descriptor_);
}

Error OpenFile::fault(const std::string& what, int error_number) const {
    return {ErrorKind::failed, path_, what + system_reason(error_number)};
}

Error OpenFile::damaged(std::uint64_t offset, const std::string& what) const {
    return {ErrorKind::failed, path_, "is damaged at byte " + std::to_string(offset) + ": " + what};
}

Result<std::uint64_t> OpenFile::size() const {
    struct stat found {};
    if (fstat(descriptor_, &found) != 0) return fault("cannot be asked for its size: ", errno);
    return static_cast<std::uint64_t>(found.st_size);
}

Result<void> OpenFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t count = pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return fault("cannot be read at byte " + std::to_string(offset) + ": ", errno);
        if (count == 0)
            return damaged(offset,
                           "it ends here, and " + std::to_string(bytes.size()) + " bytes more were expected");
        offset += static_cast<std::uint64_t>(count);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return {};
}

Result<void> OpenFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t count = pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return fault("cannot be written: ", count < 0 ? errno : EIO);
        offset += static_cast<std::uint64_t>(count);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return {};
}

Result<void> OpenFile::resize(std::uint64_t bytes) {
    if (ftruncate(descriptor_, static_cast<off_t>(bytes)) == 0) return {};
    return fault("cannot be written: ", errno);
}

Result<void> OpenFile::sync() {
    if (fsync(descriptor_) == 0) return {};
    return fault("cannot be written: ", errno);
}

}  // namespace oro
