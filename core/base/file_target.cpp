#include "core/base/file_target.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "core/base/files_of_job.h"
#include "core/base/open_file.h"

namespace oro {
namespace {

Error fault(const std::string& path, const std::string& what) {
    return {ErrorKind::failed, path, what};
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

// The name is on the disk once the folder is; some file systems cannot sync a folder, and that is no failure.
void sync_folder_of(const std::string& path) {
    const std::string folder = std::filesystem::path(path).parent_path().string();
    const int descriptor = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    (void)fsync(descriptor);
    close(descriptor);
}

}  // namespace

Result<unsigned> check_target(std::string& path, bool overwrite) {
    if (path.empty()) return Error{ErrorKind::usage, "", "the name of the file to write is empty"};
    if (path.find('\0') != std::string::npos)
        return Error{ErrorKind::usage, path.c_str(), "a file name cannot hold a zero byte"};
    if (path.back() == '/') return Error{ErrorKind::usage, path, "names a folder, not a file"};
    struct stat found {};
    if (lstat(path.c_str(), &found) != 0) {
        if (errno == ENOENT) return 0U;
        return fault(path, "cannot be written: " + system_reason(errno));
    }
    if (S_ISLNK(found.st_mode)) {
        char* const target = realpath(path.c_str(), nullptr);
        if (!target) return fault(path, "is a link that leads nowhere: " + system_reason(errno));
        path = target;
        std::free(target);
        if (stat(path.c_str(), &found) != 0) return fault(path, "cannot be written: " + system_reason(errno));
    }
    if (S_ISDIR(found.st_mode)) return fault(path, "is a folder");
    if (!S_ISREG(found.st_mode)) return fault(path, "is a device or pipe; only files can be written");
    if (!overwrite) return fault(path, "exists already; allow overwriting, or choose another name");
    return static_cast<unsigned>(found.st_mode & 0777U);
}

int take_file_name(const std::string& from, const std::string& to, bool overwrite) {
    const int renamed =
        overwrite ? rename(from.c_str(), to.c_str()) : rename_without_replacing(from.c_str(), to.c_str());
    if (renamed != 0) return errno;
    sync_folder_of(to);
    return 0;
}

Result<void> give_name(const std::string& partial, const std::string& to, bool overwrite) {
    const int why = take_file_name(partial, to, overwrite);
    if (why == 0) {
        note_file_written(to);
        return {};
    }
    if (why == EEXIST && !overwrite)
        return fault(to,
                     "appeared while it was being written, and is left as it is; the new one is " + partial);
    return fault(to, "cannot be written: " + system_reason(why));
}

void ignore_size_limit_signal() {
    [[maybe_unused]] static const bool once = [] {
        struct sigaction current {};
        if (sigaction(SIGXFSZ, nullptr, &current) == 0 && current.sa_handler == SIG_DFL)
            std::signal(SIGXFSZ, SIG_IGN);
        return true;
    }();
}

}  // namespace oro
