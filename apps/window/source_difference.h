// The difference of two sources of elevation, as a tint over the ground and as a file.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "core/drape/post_colours.h"
#include "core/terrain/height_difference.h"
#include "geo/rasters/post_raster.h"
#include "geo/region/region.h"

namespace oro {

// A source and what it is called.
struct NamedRegion {
    const Region& region;
    std::string name;
};

// H of the first minus H of the second, at the posts of the finer one.
struct SourceDifference {
    std::string title;    // "H of a.tif minus H of b.tif"
    bool is_of_second{};  // whose posts they are
    std::string posts;    // "posts of a.tif"
    HeightDifference found;
    double limit_m{1.0};  // what the ramp's ends stand for
    PostRaster raster;    // for write_post_raster()
    std::shared_ptr<const PostColours> colours;
};

// Of the first grids of both: at the posts of that whose posts are closer, over the part that both have, H of
// the other region's ground at their places. Heights count as they are, however they are drawn. From any
// thread; both regions stay as they are meanwhile. Errors: they do not overlap (no_data), too many posts,
// posts that cannot be read, stopped.
Result<SourceDifference> source_difference(const NamedRegion& one, const NamedRegion& other,
                                           const std::function<void(double share)>& tell_share,
                                           const std::stop_token& stop);

// What the ends of a ramp stand for where most differences are within twice their root mean square: 1, 2 or 5
// times a power of ten, at least 0.1 m.
double ramp_limit_m(double rms_m);
// The ramp's colour of a difference, sRGB: from blue (-limit_m and below) over white (0) to red (limit_m and
// above). Source: RdBu of ColorBrewer, https://colorbrewer2.org, in three parts, linear between.
std::array<std::uint8_t, 3> ramp_colour(double difference_m, double limit_m);

}  // namespace oro
