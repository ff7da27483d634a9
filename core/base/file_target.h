// The name that a whole file gets when it is finished, for everything that writes one under another name
// first.
#pragma once

#include <string>

#include "core/base/result.h"

namespace oro {

// What must hold before anything is written: the name is free, or that of a plain file that may be replaced.
// A link is followed: `path` is then what it leads to, so that it stays a link. Gives the rights of the file
// that is there (0 .. 0777), 0 when there is none. Errors: usage for a name that is none or a folder's; a
// folder, device or pipe, a link that leads nowhere, a file that may not be replaced.
Result<unsigned> check_target(std::string& path, bool overwrite);

// Gives the file `from` the name `to`, without `overwrite` only if nothing has that name (in one step where
// the file system can), and puts the name on the disk. 0, or the system's error number: EEXIST for a name
// that was taken meanwhile.
[[nodiscard]] int take_file_name(const std::string& from, const std::string& to, bool overwrite);

// This gives the file that was written as `partial` the name `to`, as take_file_name() does. Errors: the name
// was taken meanwhile, and what has it is left; those of the system.
Result<void> give_name(const std::string& partial, const std::string& to, bool overwrite);

// From here on a write past the file size limit (ulimit -f) fails with EFBIG; the signal's default is to end
// the program. A handler that the program has set itself stays.
void ignore_size_limit_signal();

}  // namespace oro
