#include "apps/fingerprints/fingerprints.h"

#include <array>
#include <bit>
#include <filesystem>
#include <span>
#include <type_traits>

#include "core/base/checksum.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/region/region_fingerprints.h"

namespace oro {

extern const char* const picture_code;  // made when the program is built (apps/view/picture_code.cmake)

std::string program_fingerprint() {
    return std::string(OROGRAPH_VERSION " ") + picture_code;
}

namespace {

std::uint64_t both(std::uint64_t one, std::uint64_t other) {
    const std::array fingerprints{one, other};
    return xxh64(std::as_bytes(std::span(fingerprints)));
}

}  // namespace

// Of several grids, what is told of each becomes one.
Fingerprints fingerprints_of(const Region& region) {
    const RegionGrid& first = region.grids.front();
    Fingerprints fingerprints;
    fingerprints.program = program_fingerprint();
    fingerprints.grid = grid_fingerprint(first.field.grid);
    fingerprints.posts = first.posts_hash;
    fingerprints.resampling = region_resampling(first);
    fingerprints.geoid = first.geoid;
    fingerprints.undulation = first.geoid_fingerprint;
    std::size_t sources = first.sources.size();
    for (const RegionGrid& other : std::span(region.grids).subspan(1)) {
        fingerprints.grid = both(fingerprints.grid, grid_fingerprint(other.field.grid));
        fingerprints.posts = both(*fingerprints.posts, other.posts_hash);
        fingerprints.undulation = both(fingerprints.undulation, other.geoid_fingerprint);
        sources += other.sources.size();
    }
    const std::size_t meshes = region.meshes ? region.meshes->size() : 0;
    for (std::size_t i = 0; i < meshes; ++i)
        fingerprints.posts = both(*fingerprints.posts, (*region.meshes)[i].fingerprint);
    if (sources + meshes > most_sources_with_fingerprints) return fingerprints;
    for (const RegionGrid& grid : region.grids)
        for (const SourceReport& source : grid.sources)
            fingerprints.sources.push_back(
                {std::filesystem::path(source.path).filename().string(), source.posts_hash});
    for (std::size_t i = 0; i < meshes; ++i)
        fingerprints.sources.push_back({std::filesystem::path((*region.meshes)[i].path).filename().string(),
                                        (*region.meshes)[i].fingerprint});
    return fingerprints;
}

std::uint64_t style_fingerprint(const Style& style) {
    static_assert(std::is_trivially_copyable_v<gpu::FrameStyle> && alignof(gpu::FrameStyle) == 4,
                  "no byte of it is padding");
    const std::uint64_t frame = xxh64(std::as_bytes(std::span(&style.frame, 1)));
    if (style.labels_px == 0.0) return frame;
    const std::array both{frame, std::bit_cast<std::uint64_t>(style.labels_px)};
    return xxh64(std::as_bytes(std::span(both)));
}

}  // namespace oro
