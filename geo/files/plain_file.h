// Files in a folder that becomes whole as one (geo/files/whole_folder.h): no need for each file to.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/base/result.h"

namespace oro {

// Writes a file that is not there yet. Not put on the disk: WholeFolder::commit() does. Errors (failed): what
// the system says; a file of that name.
Result<void> write_plain_file(const std::string& path, std::span<const std::uint8_t> bytes);

}  // namespace oro
