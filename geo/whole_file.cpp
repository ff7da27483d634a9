#include "geo/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <mutex>
#include <random>
#include <set>
#include <utility>

#include "core/file_target.h"
#include "core/open_file.h"

namespace oro {
namespace {

Error fault(const std::string& path, const std::string& what) {
    return {ErrorKind::failed, path, what};
}

std::string folder_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    if (slash == std::string::npos) return ".";
    return slash == 0 ? "/" : path.substr(0, slash);
}

// The temporary names in use. They stay to the very end of the program: a signal may come then, too.
struct Unfinished {
    std::mutex mutex;
    std::set<std::string> paths;
};
Unfinished& unfinished() {
    static auto* const all = new Unfinished;
    return *all;
}

// A new file ".orograph-RANDOM" in the folder, opened for reading (TIFF reads back what it wrote) and
// writing. Not mkstemp: the mode 0666 given here is cut by the umask in the kernel, whereas the umask cannot
// be read without changing it for the other threads. The name does not hold the real one, which may be as
// long as a name can be.
int open_temporary(const std::string& folder, std::string& temporary_path) {
    static constexpr char letters[] = "abcdefghijklmnopqrstuvwxyz0123456789";
    std::random_device random;
    std::uniform_int_distribution<std::size_t> letter(0, sizeof(letters) - 2);
    const std::scoped_lock lock(unfinished().mutex);
    for (int attempt = 0; attempt < 100; ++attempt) {
        std::string path = (folder == "/" ? "" : folder) + "/.orograph-";
        for (int i = 0; i < 10; ++i) path += letters[letter(random)];
        // Before the file is there: without memory for its name nobody would remove it.
        const auto name = unfinished().paths.insert(path).first;
        const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0) {
            temporary_path = std::move(path);
            return descriptor;
        }
        const int why = errno;
        unfinished().paths.erase(name);
        errno = why;
        if (why != EEXIST) return descriptor;
    }
    return -1;
}

void forget_temporary(const std::string& path) {
    const std::scoped_lock lock(unfinished().mutex);
    unfinished().paths.erase(path);
}

}  // namespace

Result<WholeFile> WholeFile::create(const std::string& path, bool overwrite) {
    ignore_size_limit_signal();
    WholeFile file;
    file.path_ = path;
    file.overwrite_ = overwrite;
    ORO_TRY(const unsigned old_mode, check_target(file.path_, overwrite));
    const std::string folder = folder_of(file.path_);
    const int descriptor = open_temporary(folder, file.temporary_path_);
    if (descriptor < 0) {
        const std::string why =
            errno == ENOENT ? "is not there" : "cannot be written in: " + system_reason(errno);
        return fault(path, "the folder " + folder + " " + why);
    }
    // A file that its owner had closed to others stays closed to them when it is replaced.
    if (old_mode != 0) (void)fchmod(descriptor, old_mode);
    file.stream_ = fdopen(descriptor, "w+b");
    if (!file.stream_) {
        const int why = errno;
        close(descriptor);
        return fault(path, "cannot be written: " + system_reason(why));
    }
    return file;
}

WholeFile::WholeFile(WholeFile&& other) noexcept
    : stream_(std::exchange(other.stream_, nullptr)),
      path_(std::move(other.path_)),
      temporary_path_(std::exchange(other.temporary_path_, {})),
      overwrite_(other.overwrite_) {}

WholeFile& WholeFile::operator=(WholeFile&& other) noexcept {
    if (this == &other) return *this;
    abandon();
    stream_ = std::exchange(other.stream_, nullptr);
    path_ = std::move(other.path_);
    temporary_path_ = std::exchange(other.temporary_path_, {});
    overwrite_ = other.overwrite_;
    return *this;
}

WholeFile::~WholeFile() {
    abandon();
}

void WholeFile::abandon() noexcept {
    if (stream_) std::fclose(std::exchange(stream_, nullptr));
    if (temporary_path_.empty()) return;
    unlink(temporary_path_.c_str());
    forget_temporary(temporary_path_);
    temporary_path_.clear();
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

Result<void> WholeFile::commit() {
    if (auto settled = settle(); !settled.ok()) {
        abandon();
        return settled;
    }
    int why = std::fclose(std::exchange(stream_, nullptr)) == 0 ? 0 : errno;
    if (why == 0) why = take_file_name(temporary_path_, path_, overwrite_);
    if (why == EEXIST && !overwrite_) {
        abandon();
        return fault(path_, "appeared while it was being written, and is left as it is");
    }
    if (why != 0) {
        abandon();
        return fault(path_, "cannot be written: " + system_reason(why));
    }
    forget_temporary(temporary_path_);
    temporary_path_.clear();
    return {};
}

void remove_unfinished_files() {
    unfinished().mutex.lock();  // for good: see the header
    for (const std::string& path : unfinished().paths) unlink(path.c_str());
}

Result<void> write_whole_file(const std::string& path, const std::string& text, bool overwrite) {
    ORO_TRY(WholeFile file, WholeFile::create(path, overwrite));
    ORO_CHECK(file.write(text.data(), text.size()));
    return file.commit();
}

}  // namespace oro
