// A region and its cluster graph in one file: a short header, a whole region file, then a whole cluster file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/baked/region_file.h"
#include "core/base/open_file.h"
#include "core/base/result.h"
#include "core/cluster_file/cluster_file.h"

namespace oro {

// Where both lie.
struct ClusteredParts {
    std::uint64_t region_offset{};
    std::uint64_t region_bytes{};
    std::uint64_t clusters_offset{};
    std::uint64_t clusters_bytes{};
};

// Little-endian: "OROCLUST", version (uint32, 1), a zero (uint32), the sizes of the region file and of the
// cluster file in bytes (uint64 each), and the XXH64 of all before. Both follow, one right after the other.
[[nodiscard]] std::vector<std::byte> clustered_header(std::uint64_t region_bytes,
                                                      std::uint64_t clusters_bytes);

// What the header of an open file says. Errors: a version that this program does not read; damage, at its
// byte; a file that is longer or shorter than its parts.
[[nodiscard]] Result<ClusteredParts> clustered_parts(const OpenFile& file);

// True for a plain file that begins as such a file does, of whatever version.
[[nodiscard]] bool looks_like_clustered_file(const std::string& path);

// A region file by itself, or with clusters over its posts.
struct BakedFile {
    std::shared_ptr<const RegionFile> region;
    std::shared_ptr<const ClusterFile> clusters;  // null: it has none
};
// Errors: as RegionFile::open and ClusterFile::open; clusters of other posts.
[[nodiscard]] Result<BakedFile> open_baked_file(const std::string& path);

}  // namespace oro
