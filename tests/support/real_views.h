// The views of real terrain that errors and predictions are held against: the same for all who ask for as
// many.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>

namespace oro::test {

struct RealRegion {
    const char* folder;  // of the real data
    const char* tiles;
};
inline constexpr std::array real_regions{RealRegion{"alps", "N46E007:N46E008"},
                                         RealRegion{"himalaya", "N28E083:N28E083"},
                                         RealRegion{"poland", "N49E019:N49E020"}};
// Of made_cameras, for each region.
inline constexpr std::uint64_t real_view_seed = 501;

// How many of `all` views are of a region.
inline int views_of(std::size_t region, int all) {
    constexpr int regions = static_cast<int>(real_regions.size());
    return (all + regions - 1 - static_cast<int>(region)) / regions;
}

// OROGRAPH_TEST_VIEWS, or `otherwise`.
inline int view_count(int otherwise) {
    const char* const wanted = std::getenv("OROGRAPH_TEST_VIEWS");
    return wanted && std::atoi(wanted) >= 3 ? std::atoi(wanted) : otherwise;
}

}  // namespace oro::test
