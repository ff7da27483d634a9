#include "apps/fingerprints/fingerprints.h"

#include <array>
#include <bit>
#include <filesystem>
#include <span>
#include <type_traits>

#include "core/base/checksum.h"
#include "geo/region/region_prints.h"

namespace oro {

extern const char* const picture_code;  // made when the program is built (apps/view/picture_code.cmake)

std::string program_print() {
    return std::string(OROGRAPH_VERSION " ") + picture_code;
}

namespace {

std::uint64_t both(std::uint64_t one, std::uint64_t other) {
    const std::array prints{one, other};
    return xxh64(std::as_bytes(std::span(prints)));
}

}  // namespace

// Of several grids, what is told of each becomes one.
Fingerprints prints_of(const Region& region) {
    const RegionGrid& first = region.grids.front();
    Fingerprints prints;
    prints.program = program_print();
    prints.grid = grid_print(first.field.grid);
    prints.posts = first.posts_print;
    prints.resampling = region_resampling(first);
    prints.geoid = first.geoid;
    prints.undulation = first.geoid_print;
    std::size_t sources = first.sources.size();
    for (const RegionGrid& other : std::span(region.grids).subspan(1)) {
        prints.grid = both(prints.grid, grid_print(other.field.grid));
        if (prints.posts && other.posts_print) prints.posts = both(*prints.posts, *other.posts_print);
        prints.undulation = both(prints.undulation, other.geoid_print);
        sources += other.sources.size();
    }
    if (sources > most_sources_with_prints) return prints;
    for (const RegionGrid& grid : region.grids)
        for (const SourceReport& source : grid.sources)
            prints.sources.push_back(
                {std::filesystem::path(source.path).filename().string(), source.posts_print});
    return prints;
}

std::uint64_t style_print(const Style& style) {
    static_assert(std::is_trivially_copyable_v<gpu::FrameStyle> && alignof(gpu::FrameStyle) == 4,
                  "no byte of it is padding");
    const std::uint64_t frame = xxh64(std::as_bytes(std::span(&style.frame, 1)));
    if (style.labels_px == 0.0) return frame;
    const std::array both{frame, std::bit_cast<std::uint64_t>(style.labels_px)};
    return xxh64(std::as_bytes(std::span(both)));
}

}  // namespace oro
