// Formats of towns and surveys that this program does not read.
#pragma once

#include <string>

namespace oro {

// Why a file of such a format is not read, and what makes one of it that is: "is a point cloud: ...". By its
// name, and of .xml by its first 4 KiB; "" for all other files. path: what opens the file.
[[nodiscard]] std::string why_unread(const std::string& name, const std::string& path);

}  // namespace oro
