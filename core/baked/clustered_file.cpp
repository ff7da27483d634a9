#include "core/baked/clustered_file.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "core/baked/region_format.h"
#include "core/base/checksum.h"
#include "core/base/little_endian.h"
#include "core/surface/grid_surface.h"

namespace oro {
namespace {

constexpr std::string_view magic = "OROCLUST";
constexpr std::uint32_t version = 1;
constexpr std::size_t at_version = 8, at_zero = 12, at_region = 16, at_clusters = 24, at_sum = 32,
                      header_bytes = 40;

bool begins_with_magic(std::span<const std::byte> bytes) {
    const auto expected = std::as_bytes(std::span(magic));
    return bytes.size() >= expected.size() && std::equal(expected.begin(), expected.end(), bytes.begin());
}

}  // namespace

std::vector<std::byte> clustered_header(std::uint64_t region_bytes, std::uint64_t clusters_bytes) {
    std::vector<std::byte> bytes(header_bytes);
    const auto begins = std::as_bytes(std::span(magic));
    std::copy(begins.begin(), begins.end(), bytes.begin());
    to_little_endian(version, &bytes[at_version]);
    to_little_endian(std::uint32_t{0}, &bytes[at_zero]);
    to_little_endian(region_bytes, &bytes[at_region]);
    to_little_endian(clusters_bytes, &bytes[at_clusters]);
    to_little_endian(xxh64(std::span(bytes).first(at_sum)), &bytes[at_sum]);
    return bytes;
}

Result<ClusteredParts> clustered_parts(const OpenFile& file) {
    const auto refused = [&](const std::string& what) { return Error{ErrorKind::failed, file.path(), what}; };
    ORO_TRY(const std::uint64_t size, file.size());
    if (size < header_bytes)
        return refused("is cut off at byte " + std::to_string(size) + ", within its header");
    std::array<std::byte, header_bytes> bytes;
    ORO_CHECK(file.read(0, bytes));
    if (!begins_with_magic(bytes))
        return refused("holds no clusters: it does not begin at byte 0 as such a file does");
    const auto found = from_little_endian<std::uint32_t>(&bytes[at_version]);
    if (found != version)
        return refused("is of version " + std::to_string(found) +
                       " of the format for clusters (byte 8), this program reads version " +
                       std::to_string(version));
    const std::uint64_t computed = xxh64(std::span(bytes).first(at_sum));
    const auto stored = from_little_endian<std::uint64_t>(&bytes[at_sum]);
    if (computed != stored)
        return file.damaged(0, "the header has checksum " + region_format::hexadecimal(computed) +
                                   ", expected " + region_format::hexadecimal(stored));
    ClusteredParts parts{header_bytes, from_little_endian<std::uint64_t>(&bytes[at_region]), 0,
                         from_little_endian<std::uint64_t>(&bytes[at_clusters])};
    const std::uint64_t rest = size - header_bytes;
    if (parts.region_bytes > rest)
        return refused("is cut off at byte " + std::to_string(size) + ", within its region");
    parts.clusters_offset = header_bytes + parts.region_bytes;
    if (parts.clusters_bytes > rest - parts.region_bytes)
        return refused("is cut off at byte " + std::to_string(size) + ", within its clusters");
    if (parts.clusters_bytes != rest - parts.region_bytes)
        return refused("goes on after its end at byte " +
                       std::to_string(parts.clusters_offset + parts.clusters_bytes) + ": it has " +
                       std::to_string(size) + " bytes");
    return parts;
}

bool looks_like_clustered_file(const std::string& path) {
    const auto file = OpenFile::open(path, OpenFile::Use::read);
    if (!file.ok()) return false;
    std::array<std::byte, magic.size()> bytes;
    return file->read(0, bytes).ok() && begins_with_magic(bytes);
}

Result<BakedFile> open_baked_file(const std::string& path) {
    if (!looks_like_clustered_file(path)) {
        ORO_TRY(RegionFile region, RegionFile::open(path));
        return BakedFile{std::make_shared<const RegionFile>(std::move(region)), nullptr};
    }
    ORO_TRY(const OpenFile file, OpenFile::open(path, OpenFile::Use::read));
    ORO_TRY(const ClusteredParts parts, clustered_parts(file));
    ORO_TRY(OpenFile first, file.part(parts.region_offset, parts.region_bytes));
    ORO_TRY(RegionFile region, RegionFile::open(std::move(first)));
    ORO_TRY(OpenFile second, file.part(parts.clusters_offset, parts.clusters_bytes));
    ORO_TRY(ClusterFile clusters, ClusterFile::open(std::move(second)));
    const PostGrid& grid = region.outline().grid;
    const ClusterOutline& outline = clusters.outline();
    if (outline.fingerprint != surface_fingerprint(region.fingerprint(), grid.split) ||
        outline.posts.rows != grid.rows() || outline.posts.columns != grid.columns())
        return file.damaged(parts.clusters_offset, "its clusters are of another region");
    return BakedFile{std::make_shared<const RegionFile>(std::move(region)),
                     std::make_shared<const ClusterFile>(std::move(clusters))};
}

}  // namespace oro
