#include "geo/files/temporary_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <random>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "core/base/checksum.h"
#include "geo/files/unfinished_folders.h"

namespace oro {
namespace fs = std::filesystem;

namespace {

// The temporary names in use, and the folders that were looked through. They stay to the very end of the
// program: a signal may come then, too.
struct Unfinished {
    std::recursive_mutex mutex;
    std::set<std::string> paths;
    std::set<std::string> folders;
    std::set<std::string> swept_folders;
};
Unfinished& unfinished() {
    static auto* const all = new Unfinished;
    return *all;
}

constexpr std::string_view prefix = ".orograph-";
constexpr std::size_t random_letters = 10, sum_letters = 8;

// Tells names of ours from all that somebody else might call so.
std::string sum_of(std::string_view letters) {
    char text[32];
    std::snprintf(text, sizeof text, "%08llx",
                  static_cast<unsigned long long>(xxh64(std::as_bytes(std::span(letters))) & 0xFFFFFFFFU));
    return text;
}

// The name does not hold the real one, which may be as long as a name can be.
std::string random_name() {
    static constexpr char letters[] = "abcdefghijklmnopqrstuvwxyz0123456789";
    std::random_device random;
    std::uniform_int_distribution<std::size_t> letter(0, sizeof(letters) - 2);
    std::string part;
    for (std::size_t i = 0; i < random_letters; ++i) part += letters[letter(random)];
    return std::string(prefix) + part + "-" + sum_of(part);
}

bool is_name_of_ours(std::string_view name) {
    if (name.size() != prefix.size() + random_letters + 1 + sum_letters || !name.starts_with(prefix))
        return false;
    const std::string_view part = name.substr(prefix.size(), random_letters);
    return name[prefix.size() + random_letters] == '-' &&
           name.substr(prefix.size() + random_letters + 1) == sum_of(part);
}

bool same_file(const struct stat& a, const struct stat& b) {
    return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

// Removes a file of one of our names that nobody holds: this user's, plain, with that one name, and its lock
// free.
void remove_if_left_over(const std::string& path) {
    struct stat named {
    }, opened{};
    if (lstat(path.c_str(), &named) != 0 || !S_ISREG(named.st_mode) || named.st_nlink != 1 ||
        named.st_uid != geteuid())
        return;
    const int descriptor = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return;
    if (fstat(descriptor, &opened) == 0 && same_file(named, opened) &&
        flock(descriptor, LOCK_EX | LOCK_NB) == 0 && lstat(path.c_str(), &named) == 0 &&
        same_file(named, opened))
        unlink(path.c_str());
    close(descriptor);
}

// Once a folder and run: a folder may hold many files.
void remove_left_over_files(const std::string& folder) {
    if (!unfinished().swept_folders.insert(folder).second) return;
    std::error_code failed;
    for (fs::directory_iterator entry(folder.empty() ? "/" : folder, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        const std::string name = entry->path().filename().string(), path = folder + "/" + name;
        if (is_name_of_ours(name) && !unfinished().paths.contains(path)) remove_if_left_over(path);
    }
}

// Not mkstemp: the mode 0666 given here is cut by the umask in the kernel, whereas the umask cannot be read
// without changing it for the other threads.
constexpr mode_t mode = 0666;

// -1 where the file system has no such files, or no way is there to name one later.
int open_nameless(const std::string& folder) {
    const int descriptor = open(folder.c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, mode);
    if (descriptor < 0) return -1;
    if (access(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), F_OK) == 0) return descriptor;
    close(descriptor);
    return -1;
}

// Whoever looks for files that were left over may have come between the making and the locking.
int open_named(const std::string& path) {
    const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (descriptor < 0) return -1;
    struct stat found {};
    (void)flock(descriptor, LOCK_EX | LOCK_NB);
    if (fstat(descriptor, &found) == 0 && found.st_nlink > 0) return descriptor;
    close(descriptor);
    errno = EEXIST;
    return -1;
}

// Tries names until `make` takes one; `make` fails with EEXIST for one that is not free.
template <class Make>
int with_free_name(const std::string& folder, std::string& path, Make make) {
    for (int attempt = 0; attempt < 100; ++attempt) {
        std::string name = folder;
        (name += '/') += random_name();
        // Entered first: where there is no memory for that, nothing has been made yet.
        const auto entered = unfinished().paths.insert(name).first;
        if (make(name)) {
            path = std::move(name);
            return 0;
        }
        const int why = errno;
        unfinished().paths.erase(entered);
        if (why != EEXIST) return why;
    }
    return EEXIST;
}

}  // namespace

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      folder_(std::move(other.folder_)),
      path_(std::exchange(other.path_, {})) {}

TemporaryFile& TemporaryFile::operator=(TemporaryFile&& other) noexcept {
    if (this == &other) return *this;
    remove();
    descriptor_ = std::exchange(other.descriptor_, -1);
    folder_ = std::move(other.folder_);
    path_ = std::exchange(other.path_, {});
    return *this;
}

TemporaryFile::~TemporaryFile() {
    remove();
}

void TemporaryFile::remove() noexcept {
    if (!path_.empty()) unlink(path_.c_str());
    forget_name();
    if (descriptor_ >= 0) close(std::exchange(descriptor_, -1));
}

void TemporaryFile::forget_name() {
    const std::scoped_lock lock(unfinished().mutex);
    unfinished().paths.erase(path_);
    path_.clear();
}

int TemporaryFile::make(const std::string& folder, Temporary kind) {
    folder_ = folder == "/" ? "" : folder;
    const std::scoped_lock lock(unfinished().mutex);
    remove_left_over_files(folder_);
    if (kind == Temporary::nameless) descriptor_ = open_nameless(folder);
    if (descriptor_ < 0)
        return with_free_name(folder_, path_, [&](const std::string& name) {
            descriptor_ = open_named(name);
            return descriptor_ >= 0;
        });
    (void)flock(descriptor_, LOCK_EX | LOCK_NB);
    return 0;
}

int TemporaryFile::take_temporary_name() {
    if (!path_.empty()) return 0;
    const std::string self = "/proc/self/fd/" + std::to_string(descriptor_);
    const std::scoped_lock lock(unfinished().mutex);
    return with_free_name(folder_, path_, [&](const std::string& name) {
        return linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
    });
}

int TemporaryFile::keep(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    folder_ = slash == std::string::npos ? "." : path.substr(0, slash);
    const std::scoped_lock lock(unfinished().mutex);
    return with_free_name(folder_, path_, [&](const std::string& name) {
        return linkat(AT_FDCWD, path.c_str(), AT_FDCWD, name.c_str(), 0) == 0;
    });
}

NamesHeld::NamesHeld() {
    unfinished().mutex.lock();
}

NamesHeld::~NamesHeld() {
    unfinished().mutex.unlock();
}

void remove_unfinished_files() {
    unfinished().mutex.lock();  // for good: see the header
    for (const std::string& path : unfinished().paths) unlink(path.c_str());
    // Other threads may still write into a folder; they make none in it.
    constexpr int most_tries = 100;
    for (const std::string& folder : unfinished().folders) {
        std::error_code failed;
        for (int i = 0; i < most_tries && (i == 0 || failed); ++i) fs::remove_all(folder, failed);
    }
}

int make_unfinished_folder(const std::string& beside, std::string& folder) {
    const std::scoped_lock lock(unfinished().mutex);
    for (int attempt = 0; attempt < 100; ++attempt) {
        std::string name = beside == "/" ? "" : beside;
        (name += '/') += random_name();
        const auto entered = unfinished().folders.insert(name).first;
        if (mkdir(name.c_str(), 0777) == 0) {
            folder = std::move(name);
            return 0;
        }
        const int why = errno;
        unfinished().folders.erase(entered);
        if (why != EEXIST) return why;
    }
    return EEXIST;
}

void forget_unfinished_folder(const std::string& folder) {
    const std::scoped_lock lock(unfinished().mutex);
    unfinished().folders.erase(folder);
}

}  // namespace oro
