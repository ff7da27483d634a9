#include "geo/files/whole_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "core/base/files_read.h"
#include "geo/files/folder_around.h"
#include "geo/files/network_paths.h"
#include "geo/files/unfinished_folders.h"

namespace oro {
namespace fs = std::filesystem;

namespace {

Error folder_fault(const std::string& path, int why) {
    return {ErrorKind::failed, path, "cannot be written: " + std::generic_category().message(why)};
}

// The folder itself where a link leads to it, without a slash at its end.
std::string real_path(const std::string& path) {
    std::error_code failed;
    const fs::path there = fs::weakly_canonical(fs::absolute(path, failed), failed);
    std::string name = failed ? path : there.string();
    while (name.size() > 1 && name.ends_with('/')) name.pop_back();
    return name;
}

// All of the file system that the folder is on.
int put_on_disk(const std::string& folder) {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return errno;
    const int why = syncfs(descriptor) == 0 ? 0 : errno;
    close(descriptor);
    return why;
}

}  // namespace

Result<WholeFolder> WholeFolder::create(const std::string& path, bool overwrite) {
    ORO_CHECK(check_on_this_machine(path));
    WholeFolder folder;
    folder.path_ = real_path(path);
    folder.overwrite_ = overwrite;
    std::error_code failed;
    const fs::file_status there = fs::status(folder.path_, failed);
    if (fs::exists(there) && !fs::is_directory(there))
        return Error{ErrorKind::failed, path, "is a file: name a folder"};
    if (fs::is_directory(there)) {
        const bool is_empty = fs::is_empty(folder.path_, failed);
        if (failed) return folder_fault(path, failed.value());
        if (!is_empty && !overwrite)
            return Error{ErrorKind::failed, path, "is there already (--overwrite replaces it)"};
    }
    const int why = make_unfinished_folder(fs::path(folder.path_).parent_path().string(), folder.temporary_);
    if (why != 0) return not_made_in(folder_around(path), path, why);
    return folder;
}

WholeFolder::WholeFolder(WholeFolder&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::exchange(other.temporary_, {})),
      overwrite_(other.overwrite_) {}

WholeFolder::~WholeFolder() {
    abandon();
}

void WholeFolder::abandon() noexcept {
    if (temporary_.empty()) return;
    std::error_code ignored;
    fs::remove_all(temporary_, ignored);
    forget_unfinished_folder(temporary_);
    temporary_.clear();
}

// An empty folder of the name gives way to a renaming; one that holds something is exchanged, and is then
// what has the temporary name.
int WholeFolder::take_name() {
    if (rename(temporary_.c_str(), path_.c_str()) == 0) {
        forget_unfinished_folder(std::exchange(temporary_, {}));
        return 0;
    }
    if (!overwrite_ || (errno != ENOTEMPTY && errno != EEXIST)) return errno;
    return renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, path_.c_str(), RENAME_EXCHANGE) == 0 ? 0 : errno;
}

Result<void> WholeFolder::commit() {
    if (const int why = put_on_disk(temporary_); why != 0) return folder_fault(path_, why);
    ORO_CHECK(check_files_unchanged());
    if (const int why = take_name(); why != 0) return folder_fault(path_, why);
    abandon();
    return {};
}

}  // namespace oro
