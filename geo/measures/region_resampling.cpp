#include "geo/measures/region_resampling.h"

#include <algorithm>
#include <cmath>

namespace oro {
namespace {

double worst_m(const SourceReport& source) {
    const auto& found = source.resampling;
    if (!found || !found->worst) return 0.0;
    return std::abs(*found->worst->shown_H_m - found->worst->own_H_m);
}

}  // namespace

std::optional<RegionResampling> region_resampling(const RegionGrid& grid) {
    RegionResampling sum;
    double squares_m2 = 0.0;
    for (const SourceReport& source : grid.sources) {
        if (!source.placement || source.placement->fit == Fit::same_posts) continue;
        ++sum.files;
        if (!source.resampling) {
            ++sum.unknown;
            continue;
        }
        sum.posts += source.resampling->posts;
        sum.compared += source.resampling->compared;
        sum.worst_m = std::max(sum.worst_m, worst_m(source));
        squares_m2 += source.resampling->rms_m * source.resampling->rms_m *
                      static_cast<double>(source.resampling->compared);
    }
    if (sum.files == 0) return std::nullopt;
    if (sum.compared > 0) sum.rms_m = std::sqrt(squares_m2 / static_cast<double>(sum.compared));
    return sum;
}

const SourceReport* worst_resampled(const RegionGrid& grid) {
    const SourceReport* worst = nullptr;
    for (const SourceReport& source : grid.sources) {
        if (!source.resampling || !source.resampling->worst) continue;
        if (worst == nullptr || worst_m(source) > worst_m(*worst)) worst = &source;
    }
    return worst;
}

}  // namespace oro
