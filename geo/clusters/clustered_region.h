// A region file and a cluster file made one file.
#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.h"

namespace oro {

// Where a region's clusters grow on their way into the file `path`: beside it.
std::string path_of_clusters(const std::string& path);

// What must hold before a cluster file is written or replaced there: the name is free, or a cluster file has
// it, which a bake that was broken off left behind. Errors: it is somebody else's.
Result<void> check_path_of_clusters(const std::string& clusters_path);

// Whether a cluster file is there and whole, over the posts of that fingerprint. Reads all of it.
bool are_baked_clusters(const std::string& clusters_path, std::uint64_t fingerprint);

// Puts both files together as `path`, which appears whole or not at all, and removes them: also where
// another file took the name meanwhile and stays. Errors: those of reading and writing.
Result<void> join_clusters(const std::string& path, const std::string& region_path,
                           const std::string& clusters_path, bool overwrite);

}  // namespace oro
