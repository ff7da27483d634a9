// The ground under places of a region, as benchmarks ask for it.
#pragma once

#include "apps/bench/times/bench_random.h"
#include "core/frame/region_pages.h"

namespace oro {

// Between posts of the finest level, as they are drawn. The pages outlive it.
class GroundBelow {
  public:
    explicit GroundBelow(const RegionPages& pages) : grid_(pages.facts().grid), posts_(pages) {}
    // Above the ellipsoid, metres. Where there is none: as high as it was last. Errors: a file that cannot be
    // read.
    Result<double> h_m(double lat_deg, double lon_deg);

  private:
    const PostGrid& grid_;
    DrawnPosts posts_;
    double last_m_{};
};

}  // namespace oro
