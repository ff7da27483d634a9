#include "apps/bench/times/bench_ground.h"

#include <algorithm>

namespace oro {

Result<double> GroundBelow::h_m(double lat_deg, double lon_deg) {
    const double row = std::clamp(grid_.lat.index_at(lat_deg), 0.0, grid_.rows() - 1.001);
    const double column = std::clamp(grid_.lon.index_at(lon_deg), 0.0, grid_.columns() - 1.001);
    const int north = static_cast<int>(row), west = static_cast<int>(column);
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        ORO_TRY(const double post_m, posts_.h_m(north + i / 2, west + i % 2));
        if (post_m == static_cast<double>(void_height_m)) return last_m_;
        const double down = i / 2 == 0 ? north + 1.0 - row : row - north;
        sum += post_m * down * (i % 2 == 0 ? west + 1.0 - column : column - west);
    }
    last_m_ = sum;
    return last_m_;
}

}  // namespace oro
