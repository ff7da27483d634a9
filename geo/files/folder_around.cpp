#include "geo/files/folder_around.h"

#include <unistd.h>

#include <cerrno>

#include "core/base/open_file.h"

namespace oro {

std::string folder_around(const std::string& path) {
    const std::size_t end = path.find_last_not_of('/');
    const std::size_t slash = end == std::string::npos ? end : path.rfind('/', end);
    if (slash == std::string::npos) return end == std::string::npos && !path.empty() ? "/" : ".";
    const std::size_t last = path.find_last_not_of('/', slash);
    return last == std::string::npos ? "/" : path.substr(0, last + 1);
}

Error not_made_in(const std::string& folder, const std::string& path, int why) {
    // A folder of the kernel's (/proc) is there, and says so of each new file.
    const bool no_folder = why == ENOENT && access(folder.c_str(), F_OK) != 0;
    const std::string reason = no_folder       ? "is not there"
                               : why == ENOENT ? "takes no new files"
                                               : "cannot be written in: " + system_reason(why);
    return {ErrorKind::failed, path, "the folder " + folder + " " + reason};
}

}  // namespace oro
