#include "geo/fetch/part_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <thread>
#include <utility>

#include "core/base/file_target.h"
#include "core/base/open_file.h"

namespace oro {
namespace {

// An address and an ETag, a line each, and nothing else.
constexpr std::size_t most_etag_file_bytes = 16384;

std::string start_of(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string text(most_etag_file_bytes, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    return text;
}

// Opened and locked, and still the file of that name: one that another program finished meanwhile has another
// name now. -1 with errno where it cannot be had.
int open_locked(const std::string& file) {
    for (int turn = 0; turn < 3; ++turn) {
        const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (descriptor < 0) return -1;
        struct stat opened {
        }, named{};
        if (flock(descriptor, LOCK_EX | LOCK_NB) == 0 && fstat(descriptor, &opened) == 0 &&
            stat(file.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
            opened.st_dev == named.st_dev && S_ISREG(opened.st_mode))
            return descriptor;
        const int why = errno;
        ::close(descriptor);
        errno = why;
        if (why == EWOULDBLOCK) return -1;
    }
    return -1;
}

}  // namespace

Result<PartFile> PartFile::open(const std::string& path, double wait_s) {
    PartFile part;
    part.path_ = path;
    part.part_ = path + ".part";
    part.etag_file_ = path + ".part-etag";
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(wait_s);
    part.descriptor_ = open_locked(part.part_);
    while (part.descriptor_ < 0 && errno == EWOULDBLOCK && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        part.descriptor_ = open_locked(part.part_);
    }
    if (part.descriptor_ < 0)
        return Error{ErrorKind::failed, part.part_,
                     errno == EWOULDBLOCK ? "another program is fetching it"
                                          : "cannot be written: " + system_reason(errno)};
    struct stat there {};
    if (fstat(part.descriptor_, &there) != 0) return part.fault(part.part_, "cannot be read");
    part.bytes_ = static_cast<std::uint64_t>(there.st_size);
    const std::string text = start_of(part.etag_file_);
    const std::size_t line = text.find('\n');
    if (line != std::string::npos && text.size() > line + 1 && text.back() == '\n') {
        part.url_ = text.substr(0, line);
        part.etag_ = text.substr(line + 1, text.size() - line - 2);
    }
    return part;
}

PartFile::PartFile(PartFile&& other) noexcept {
    *this = std::move(other);
}

PartFile& PartFile::operator=(PartFile&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(bytes_, other.bytes_);
    std::swap(path_, other.path_);
    std::swap(part_, other.part_);
    std::swap(etag_file_, other.etag_file_);
    std::swap(url_, other.url_);
    std::swap(etag_, other.etag_);
    return *this;
}

PartFile::~PartFile() {
    if (descriptor_ >= 0 && (bytes_ == 0 || etag_.empty())) discard();
    close();
}

std::string PartFile::version_of(const std::string& url) const {
    return bytes_ > 0 && url == url_ ? etag_ : "";
}

Result<void> PartFile::begin(const std::string& url, const std::string& etag) {
    // First it is empty, then it is of another version: a program that ends in between leaves no mixture.
    if (ftruncate(descriptor_, 0) != 0 || lseek(descriptor_, 0, SEEK_SET) != 0)
        return fault(part_, "cannot be written");
    bytes_ = 0;
    url_ = url;
    etag_ = etag;
    std::remove(etag_file_.c_str());
    if (etag.empty()) return {};
    std::ofstream stream(etag_file_, std::ios::binary | std::ios::trunc);
    stream << url << '\n' << etag << '\n';
    stream.close();
    return stream ? Result<void>{} : fault(etag_file_, "cannot be written");
}

Result<void> PartFile::append(const char* bytes, std::size_t count) {
    if (lseek(descriptor_, static_cast<off_t>(bytes_), SEEK_SET) < 0)
        return fault(part_, "cannot be written");
    while (count > 0) {
        const ssize_t written = ::write(descriptor_, bytes, count);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return fault(part_, "cannot be written");
        bytes += written;
        count -= static_cast<std::size_t>(written);
        bytes_ += static_cast<std::uint64_t>(written);
    }
    return {};
}

Result<void> PartFile::commit() {
    if (fsync(descriptor_) != 0) return fault(part_, "cannot be written");
    ORO_CHECK(give_name(part_, path_, false));
    std::remove(etag_file_.c_str());
    close();
    return {};
}

void PartFile::discard() noexcept {
    std::remove(part_.c_str());
    std::remove(etag_file_.c_str());
    close();
}

void PartFile::close() noexcept {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
}

Error PartFile::fault(const std::string& file, const std::string& what) const {
    return Error{ErrorKind::failed, file, what + ": " + system_reason(errno)};
}

}  // namespace oro
