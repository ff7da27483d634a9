// Baked files that go into one: grids, and the clusters of a grid.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/baked/region_file.h"
#include "core/base/container.h"
#include "core/base/result.h"
#include "core/cluster_file/cluster_file.h"

namespace oro {

// Where the grid with that number grows on its way into the file `path`: beside it.
std::string path_of_grid(const std::string& path, std::size_t number);
// The same of a region's clusters.
std::string path_of_clusters(const std::string& path);

// What must hold before a part is written or replaced there: the name is free, or a baked file has it, which
// a bake that was broken off left behind. Errors: it is somebody else's.
Result<void> check_path_of_part(const std::string& part_path);

// A grid's file that is whole and what is to be baked, which need not be baked again; else nothing. Reads all
// of it.
std::optional<RegionFile> baked_grid(const std::string& grid_path, std::uint64_t fingerprint,
                                     const std::string& description);
// A cluster file that is there and whole, over the posts of that fingerprint; else nothing. Reads all of it.
std::optional<ClusterFile> baked_clusters(const std::string& clusters_path, std::uint64_t fingerprint);

// Puts parts together as `path`, which appears whole or not at all, and removes them: also where another file
// took the name meanwhile and stays. Errors: those of reading and writing.
Result<void> join_parts(const std::string& path, bool overwrite, std::span<const ContainerPart> parts);

}  // namespace oro
