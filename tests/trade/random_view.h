// Views that nobody has looked at: places of all the real data by chance, as a user would type them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "apps/options/options.h"
#include "apps/view/view.h"
#include "core/truth/true_surface.h"
#include "geo/region/region.h"
#include "render/device/gpu.h"

namespace oro::test {

using Random = std::mt19937_64;

// Regions of a folder of data, one after another: each file by itself, and between them pairs of tiles, boxes
// out of folders, and whole folders.
class RandomRegions {
  public:
    // whole_folders: dozens of tiles at once, too.
    RandomRegions(const std::filesystem::path& data, std::uint64_t seed, bool whole_folders);
    [[nodiscard]] RegionOptions next();

  private:
    [[nodiscard]] RegionOptions file();
    [[nodiscard]] RegionOptions pair();
    [[nodiscard]] RegionOptions box();

    Random random_;
    std::vector<std::filesystem::path> files_;  // in the order in which they come
    std::vector<std::filesystem::path> tiles_;  // of them, those of folders of tiles
    std::vector<std::filesystem::path> folders_;
    std::size_t files_taken_{};
    std::size_t taken_{};
};

// What is said of one view: how it is drawn, and the tolerance that a bundle is chosen for.
struct RandomView {
    ViewOptions drawing;     // --tau and --heights of its own
    ViewOptions toleranced;  // the same eye, with --tolerance
    RasterPath path{RasterPath::compute};
};
// Over a region that was opened (without its geoid, if the views are to go without). Eyes 0.5 m to 400 km
// over the ground, log-uniform; never below it. Fields of view 5 to 100 degrees. Some level, some straight
// down, some to a place of the region, others anywhere; most see ground, some may look past the data.
struct RegionToSee {
    const Region& region;
    double exaggeration;
    bool geoid;
    double highest_H_m;  // exaggerated; at least 0
};
RandomView random_view(Random& random, const RegionToSee& over, const TrueSurface& surface);

// "orograph shot ... --verify": draws the view and measures it.
std::string command_line(const RegionOptions& region, const ViewOptions& view);

}  // namespace oro::test
