#include "geo/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <random>
#include <set>
#include <system_error>
#include <utility>

namespace oro {
namespace {

std::string reason(int error_number) {
    return std::generic_category().message(error_number);
}

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

// A write past the file size limit (ulimit -f) must come back as EFBIG; the signal's default is to end the
// program with the temporary file left behind. A handler that the program has set itself stays.
void ignore_size_limit_signal() {
    [[maybe_unused]] static const bool once = [] {
        struct sigaction current {};
        if (sigaction(SIGXFSZ, nullptr, &current) == 0 && current.sa_handler == SIG_DFL)
            std::signal(SIGXFSZ, SIG_IGN);
        return true;
    }();
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
        const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0) {
            unfinished().paths.insert(path);
            temporary_path = std::move(path);
        }
        if (descriptor >= 0 || errno != EEXIST) return descriptor;
    }
    return -1;
}

void forget_temporary(const std::string& path) {
    const std::scoped_lock lock(unfinished().mutex);
    unfinished().paths.erase(path);
}

// Gives `from` the name `to` unless something has that name. Where a file system knows neither way to do this
// in one step (vfat has no links), looking and renaming are two, and a file that appears between them is
// lost.
int rename_without_replacing(const char* from, const char* to) {
    if (renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE) == 0) return 0;
    if (errno != EINVAL && errno != ENOSYS) return -1;
    if (link(from, to) == 0) return unlink(from);
    if (errno == EEXIST) return -1;
    struct stat found {};
    if (lstat(to, &found) == 0) return errno = EEXIST, -1;
    return rename(from, to);
}

// What must hold before anything is written: the name is free or a plain file that may be replaced. A link is
// followed, so that it stays a link and the file that it names is replaced.
Result<mode_t> check_target(std::string& path, bool overwrite) {
    struct stat found {};
    if (lstat(path.c_str(), &found) != 0) {
        if (errno == ENOENT) return mode_t{0};
        return fault(path, "cannot be written: " + reason(errno));
    }
    if (S_ISLNK(found.st_mode)) {
        char* const target = realpath(path.c_str(), nullptr);
        if (!target) return fault(path, "is a link that leads nowhere: " + reason(errno));
        path = target;
        std::free(target);
        if (stat(path.c_str(), &found) != 0) return fault(path, "cannot be written: " + reason(errno));
    }
    if (S_ISDIR(found.st_mode)) return fault(path, "is a folder");
    if (!S_ISREG(found.st_mode)) return fault(path, "is a device or pipe; only files can be written");
    if (!overwrite) return fault(path, "exists already; allow overwriting, or choose another name");
    return static_cast<mode_t>(found.st_mode & 0777);
}

}  // namespace

Result<WholeFile> WholeFile::create(const std::string& path, bool overwrite) {
    ignore_size_limit_signal();
    if (path.empty()) return Error{ErrorKind::usage, "", "the name of the file to write is empty"};
    if (path.find('\0') != std::string::npos)
        return Error{ErrorKind::usage, path.c_str(), "a file name cannot hold a zero byte"};
    if (path.back() == '/') return Error{ErrorKind::usage, path, "names a folder, not a file"};
    WholeFile file;
    file.path_ = path;
    file.overwrite_ = overwrite;
    ORO_TRY(const mode_t old_mode, check_target(file.path_, overwrite));
    const std::string folder = folder_of(file.path_);
    const int descriptor = open_temporary(folder, file.temporary_path_);
    if (descriptor < 0) {
        const std::string why = errno == ENOENT ? "is not there" : "cannot be written in: " + reason(errno);
        return fault(path, "the folder " + folder + " " + why);
    }
    // A file that its owner had closed to others stays closed to them when it is replaced.
    if (old_mode != 0) (void)fchmod(descriptor, old_mode);
    file.stream_ = fdopen(descriptor, "w+b");
    if (!file.stream_) {
        const int why = errno;
        close(descriptor);
        return fault(path, "cannot be written: " + reason(why));
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
    return fault(path_, "cannot be written: " + reason(errno ? errno : EIO));
}

Result<void> WholeFile::settle() {
    assert(stream_);
    errno = 0;
    if (!std::ferror(stream_) && std::fflush(stream_) == 0 && fsync(fileno(stream_)) == 0) return {};
    return fault(path_, "cannot be written: " + reason(errno ? errno : EIO));
}

Result<void> WholeFile::commit() {
    if (auto settled = settle(); !settled.ok()) {
        abandon();
        return settled;
    }
    int why = std::fclose(std::exchange(stream_, nullptr)) == 0 ? 0 : errno;
    if (why == 0) {
        const int renamed = overwrite_ ? rename(temporary_path_.c_str(), path_.c_str())
                                       : rename_without_replacing(temporary_path_.c_str(), path_.c_str());
        if (renamed != 0) why = errno;
    }
    if (why == EEXIST && !overwrite_) {
        abandon();
        return fault(path_, "appeared while it was being written, and is left as it is");
    }
    if (why != 0) {
        abandon();
        return fault(path_, "cannot be written: " + reason(why));
    }
    forget_temporary(temporary_path_);
    temporary_path_.clear();
    // The name is on disk once the folder is; some file systems cannot sync a folder, and that is no failure.
    const int folder = open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) {
        (void)fsync(folder);
        close(folder);
    }
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
