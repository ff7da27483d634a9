#include "core/frame/height_quantization.h"

#include <limits>

#include "core/frame/region_pages.h"

namespace oro {

HeightQuantization sixteen_bits(std::int32_t lowest_steps, std::int32_t highest_steps) {
    HeightQuantization coding{true, 0, 0, false};
    const std::int64_t range = std::int64_t{highest_steps} - lowest_steps;
    while (range > std::int64_t{65534} << coding.shift) ++coding.shift;
    coding.offset_steps = static_cast<std::int32_t>((std::int64_t{highest_steps} + lowest_steps) / 2);
    return coding;
}

Result<HeightQuantization> height_quantization(const RegionPages& pages, HeightStorage storage) {
    if (storage != HeightStorage::i16)
        return HeightQuantization{false, 0, 0, storage == HeightStorage::packed};
    if (const auto known = pages.known_heights())
        return sixteen_bits(height_steps(known->lowest_h_m), height_steps(known->highest_h_m));
    double lowest_m = std::numeric_limits<double>::infinity(), highest_m = -lowest_m;
    const PageLayout layout = pages.layout(0);
    for (int row = 0; row < layout.rows; ++row) {
        for (int column = 0; column < layout.columns; ++column) {
            ORO_TRY(const PageRecord record, pages.record({row, column, 0}));
            if (record.summary.triangles == 0) continue;
            lowest_m = std::min(lowest_m, record.summary.lowest_h_m);
            highest_m = std::max(highest_m, record.summary.highest_h_m);
        }
    }
    if (!(lowest_m <= highest_m)) lowest_m = highest_m = 0.0;
    return sixteen_bits(height_steps(lowest_m), height_steps(highest_m));
}

}  // namespace oro
