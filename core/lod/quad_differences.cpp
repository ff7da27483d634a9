#include "core/lod/quad_differences.h"

#include <algorithm>
#include <cstring>

#include "core/base/wide.h"

namespace oro {

ORO_WIDE QuadDifferences quad_differences(const std::int32_t* north_west, std::ptrdiff_t stride, int size,
                                          Diagonal diagonal, const CellPlane& west, const CellPlane& east) {
    const double share = 1.0 / size;
    const double west_right = share * west.change_right, east_right = share * east.change_right;
    FourDoubles lows{}, highs{};
    FourSteps lowest_four{};
    Extremes rest;
    std::int32_t lowest = 0;
    for (int i = 0; i <= size; ++i) {
        const std::int32_t* const steps = north_west + i * stride;
        const double of_west = west.at_corner + i * (share * west.change_down);
        const double of_east = east.at_corner + i * (share * east.change_down);
        const int last_of_west = diagonal == Diagonal::nw_se ? i : size - i;
        const double last = last_of_west;
        int j = 0;
        FourDoubles right{0.0, 1.0, 2.0, 3.0};
        for (; j + 4 <= size + 1; j += 4, right += 4.0) {
            FourSteps four;
            std::memcpy(&four, steps + j, sizeof four);
            lowest_four = four < lowest_four ? four : lowest_four;
            const FourDoubles plane =
                right <= last ? of_west + right * west_right : of_east + right * east_right;
            const FourDoubles difference = __builtin_convertvector(four, FourDoubles) - plane;
            lows = difference < lows ? difference : lows;
            highs = difference > highs ? difference : highs;
        }
        for (; j <= size; ++j) {
            lowest = std::min(lowest, steps[j]);
            rest.add(steps[j] - (j <= last_of_west ? of_west + j * west_right : of_east + j * east_right));
        }
    }
    for (int k = 0; k < 4; ++k) {
        lowest = std::min(lowest, lowest_four[k]);
        rest.add(lows[k]);
        rest.add(highs[k]);
    }
    return {rest.magnitude(), lowest};
}

}  // namespace oro
