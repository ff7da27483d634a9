// Folders on their way to a name. Not for use outside whole_folder.cpp.
#pragma once

#include <string>

namespace oro {

// Makes an empty folder of a temporary name in the folder `beside`, with the rights that the umask leaves,
// and tells its path. remove_unfinished_files() removes it, with all that it holds, until it is forgotten. 0,
// or the system's error number. From any thread.
[[nodiscard]] int make_unfinished_folder(const std::string& beside, std::string& folder);
// The folder has its real name now, or is removed.
void forget_unfinished_folder(const std::string& folder);

}  // namespace oro
