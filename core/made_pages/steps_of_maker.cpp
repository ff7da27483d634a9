#include "core/made_pages/steps_of_maker.h"

#include <vector>

namespace oro {

std::optional<MadeSteps> steps_of_maker(const MadeRegion& region, std::span<const int> rows,
                                        std::span<const MadeColumn> columns, std::uint32_t coarse_octaves) {
    if (!region.maker) return std::nullopt;
    std::vector<MadeRow> places;
    for (const int row : rows)
        places.push_back(made_row(region.terrain.north - row, region.terrain.posts_per_deg));
    return region.maker->make(region.rule, places, columns, coarse_octaves);
}

}  // namespace oro
