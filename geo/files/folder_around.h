// The folder around a file or a folder that is to be written.
#pragma once

#include <string>

#include "core/base/result.h"

namespace oro {

// As the path names it: "." where it names none. Slashes at the path's end do not count.
std::string folder_around(const std::string& path);

// The error of `path`, which cannot be made in this folder: it is not there, takes no new files, or what the
// system says by the error number `why`.
Error not_made_in(const std::string& folder, const std::string& path, int why);

}  // namespace oro
