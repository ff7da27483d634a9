// Every row of docs/ACCURACY.md's tables: what each extreme case must keep.
#include "tests/extremes/accuracy_table.h"

namespace oro::test {
namespace {

constexpr const char* px_error = "displacement";
constexpr const char* surface_error = "distance from the surface";
constexpr const char* seen_error = "what is seen";
constexpr const char* skyline_error = "skyline";
constexpr const char* wrong = "pixels off what is seen within 0.1 px";
constexpr const char* oracle = "true surface";
constexpr const char* rays = "oracle";
constexpr const char* rule = "rule of made terrain";

constexpr const char* places = "Places";
constexpr const char* heights = "Heights and distances";
constexpr const char* pictures = "Pictures and steps";
constexpr const char* surfaces = "Surfaces and spacing";
constexpr const char* steep = "Slopes, walls and spikes";
constexpr const char* data = "No data, odd data";
constexpr const char* large = "Large data";

// Beside level of detail, of which there is none here: placement, and depths that are floats.
constexpr double px_bound = 0.05;
// What is seen and skylines are found to so much.
constexpr double found_px = 1.0 / 64.0;

constexpr AccuracyRow rows[] = {
    // Along a flat triangle of rows a and columns b radians apart ground points move by R sin(lat) (a b / 4 +
    // b b cos(lat) / 8) at most: 0.10 m with columns a quarter of a degree apart, 0.42 m with a degree.
    {places, "flying across a pole", px_error, oracle, 0.49, "px", "pixels",
     "both poles, 21 steps of 25 m, both ways of drawing; columns a quarter of a degree apart: along flat "
     "triangles ground moves by up to 0.10 m, 0.44 px at 356 m"},
    {places, "flying across a pole, from the surface", surface_error, oracle, px_bound, "px", "pixels",
     "the same: the surface itself does not move"},
    {places, "flying across a pole, what is seen", wrong, rays, 0, "", "pixels", ""},
    {places, "straight down on a pole", px_error, oracle, 0.19, "px", "pixels",
     "the eye at 90.0 exactly, 800 m up: the same 0.10 m"},
    {places, "straight down on a pole, from the surface", surface_error, oracle, px_bound, "px", "pixels",
     ""},
    {places, "straight down on a pole, what is seen", wrong, rays, 0, "", "pixels", ""},
    {places, "columns a degree apart at a pole", px_error, oracle, 0.62, "px", "pixels",
     "cells that end in a pole: along their flat triangles ground moves by up to 0.42 m"},
    {places, "columns a degree apart at a pole, from the surface", surface_error, oracle, px_bound, "px",
     "pixels", ""},
    {places, "posts within 2 km of a pole", "distance of placed posts", "GeographicLib", 1.0, "mm", "posts",
     ""},
    {places, "corners of meshes in four CRSs", "distance of drawn corners", "PROJ, GeographicLib", 1.0, "mm",
     "corners", "all over LV95, RD New, UTM 32 and the National Grid, up to 4 km high"},
    {places, "the 1,441 posts at a pole", "distance from the first", "each other", 0, "m", "posts",
     "one point, the same bits"},
    {places, "the antimeridian as 180, -180 and 540", "pixels that differ", "each other", 0, "", "pixels",
     "depth and triangle, to the bit"},
    {places, "flying across the antimeridian", px_error, oracle, px_bound, "px", "pixels",
     "regions that cross it or end at it on either side; 17 steps of 10 m"},
    {places, "flying across the antimeridian, what is seen", wrong, rays, 0, "", "pixels", ""},
    {places, "0 N 0 E with each sign of its zeros", "pixels that differ", "each other", 0, "", "pixels",
     "and as 360 E"},
    {places, "flying across the equator and Greenwich", px_error, oracle, px_bound, "px", "pixels",
     "21 steps of 7 m"},
    {places, "flying across the equator and Greenwich, what is seen", wrong, rays, 0, "", "pixels", ""},

    {heights, "at -11,000 m", px_error, oracle, px_bound, "px", "pixels",
     "at the foot of 19,849 m of slope, 80 degrees wide"},
    {heights, "at -11,000 m, what is seen", wrong, rays, 0, "", "pixels", ""},
    {heights, "at -11,000 m, in metres", px_error, oracle, 0.05, "m", "pixels", ""},
    {heights, "at 8,849 m", px_error, oracle, px_bound, "px", "pixels", "on top of it"},
    {heights, "at 8,849 m, what is seen", wrong, rays, 0, "", "pixels", ""},
    {heights, "at 8,849 m, in metres", px_error, oracle, 0.05, "m", "pixels", ""},
    {heights, "0.05 m above a post, straight down", px_error, oracle, 3, "px", "pixels",
     "heights are drawn in steps of 0.49 mm: half a step at 0.05 m"},
    {heights, "0.05 m above a post, in metres", px_error, oracle, 0.25, "mm", "pixels",
     "half a step of height"},
    {heights, "0.05 m above a post, what is seen", "pixels off what is seen within 8 px", rays, 0, "",
     "pixels", ""},
    {heights, "in a pit 430 m below the ellipsoid", px_error, oracle, px_bound, "px", "pixels", ""},
    {heights, "in a pit 430 m below the ellipsoid, what is seen", wrong, rays, 0, "", "pixels", ""},
    {heights, "from 36,000 km", px_error, oracle, 0.1, "px", "pixels", "field of view 0.3 degree"},
    {heights, "from 36,000 km, what is seen", wrong, rays, 0, "", "pixels", ""},
    {heights, "from 36,000 km, along the ray", px_error, oracle, 12, "m", "pixels", "3.2e-7 of the distance"},
    {heights, "from the Moon's distance", px_error, oracle, 0.5, "px", "pixels", "field of view 0.05 degree"},
    {heights, "from the Moon's distance, what is seen", wrong, rays, 0, "", "pixels", ""},
    {heights, "from the Moon's distance, along the ray", px_error, oracle, 124, "m", "pixels",
     "3.2e-7 of the distance"},

    {pictures, "field of view 0.05 degree", px_error, oracle, 0.5, "px", "pixels", ""},
    {pictures, "field of view 0.05 degree, what is seen", wrong, rays, 0, "", "pixels", ""},
    {pictures, "field of view 1 degree", px_error, oracle, px_bound, "px", "pixels", ""},
    {pictures, "field of view 1 degree, what is seen", wrong, rays, 0, "", "pixels", ""},
    {pictures, "field of view 45 degrees", px_error, oracle, px_bound, "px", "pixels", ""},
    {pictures, "field of view 45 degrees, what is seen", wrong, rays, 0, "", "pixels", ""},
    {pictures, "field of view 120 degrees", px_error, oracle, px_bound, "px", "pixels", ""},
    {pictures, "field of view 120 degrees, what is seen", wrong, rays, 0, "", "pixels", ""},
    {pictures, "1 x 1 px", px_error, oracle, px_bound, "px", "pixels", ""},
    {pictures, "1 x 1 px, what is seen", wrong, rays, 0, "", "pixels", ""},
    {pictures, "3 x 5 px", px_error, oracle, px_bound, "px", "pixels", ""},
    {pictures, "3 x 5 px, what is seen", wrong, rays, 0, "", "pixels", ""},
    {pictures, "4,097 x 3 px", px_error, oracle, px_bound, "px", "pixels", "two tiles"},
    {pictures, "4,097 x 3 px, what is seen", wrong, rays, 0, "", "pixels", ""},
    {pictures, "16,384 x 16 px", px_error, oracle, px_bound, "px", "pixels", "four tiles"},
    {pictures, "16,384 x 16 px, what is seen", wrong, rays, 0, "", "pixels", ""},
    {pictures, "1 x 16,384 px", px_error, oracle, px_bound, "px", "pixels", "four tiles"},
    {pictures, "1 x 16,384 px, what is seen", wrong, rays, 0, "", "pixels", ""},
    {pictures, "1,000 steps of 1 mm", "distance of placed posts", "GeographicLib", 0.01, "px",
     "posts x steps", "60 m above the equator, 6,378 km from the Earth's centre"},
    {pictures, "1,000 steps of 1 mm, from step to step", "change of that", "GeographicLib", 0.01, "px",
     "posts x steps", "jitter"},
    {pictures, "1,000 steps of 1 mm, naive float32", "distance of placed posts", "GeographicLib", 5, "px",
     "posts x steps", "positions in float32 ECEF, --precision naive", true},

    {surfaces, "a wall of 30 m seen edge-on", wrong, rays, 0, "", "pixels",
     "within one cell of 0.1 m; both ways of drawing"},
    {surfaces, "a wall 1 m before another, at 200 km", "pixels that show the rear one", rays, 0, "", "pixels",
     "both ways of drawing"},
    {surfaces, "distance to a wall at 200 km", "error of the depth", rays, 0.1, "m", "pixels",
     "what depth resolves there"},
    // Besides, a picture's corners lie on a grid of 1/256 px: a ground point is sqrt(2) / 256 px off at most.
    {surfaces, "posts 0.1 m apart", px_error, oracle, 0.0005, "m", "pixels", "from 5 m"},
    {surfaces, "posts 0.1 m apart, on the picture", px_error, oracle, px_bound, "px", "pixels", ""},
    {surfaces, "posts 1 second apart", px_error, oracle, 0.016, "m", "pixels",
     "from 1.6 km, where the grid of corners, 1/256 px, is 1 cm"},
    {surfaces, "posts 1 second apart, from the surface", surface_error, oracle, 0.002, "m", "pixels", ""},
    {surfaces, "posts 3 seconds apart", px_error, oracle, 0.046, "m", "pixels",
     "from 4.7 km, where it is 3 cm"},
    {surfaces, "posts 3 seconds apart, from the surface", surface_error, oracle, 0.005, "m", "pixels", ""},
    {surfaces, "posts 30 seconds apart", px_error, oracle, 0.25, "m", "pixels",
     "from 24 km, where it is 14 cm"},
    {surfaces, "posts 30 seconds apart, from the surface", surface_error, oracle, 0.05, "m", "pixels",
     "flat triangles under a curved surface"},
    {surfaces, "posts 6 minutes apart", px_error, oracle, 5.6, "m", "pixels",
     "from 71 km, where it is 0.4 m; flat triangles"},
    {surfaces, "posts 6 minutes apart, from the surface", surface_error, oracle, 5, "m", "pixels",
     "flat triangles"},
    {surfaces, "posts 6 minutes apart, on the picture", px_error, oracle, 1, "px", "pixels",
     "flat triangles"},
    {surfaces, "posts 1 degree apart", px_error, oracle, 493, "m", "pixels",
     "from 356 km, where it is 2 m; flat triangles"},
    {surfaces, "posts 1 degree apart, from the surface", surface_error, oracle, 490, "m", "pixels",
     "flat triangles"},
    {surfaces, "posts 1 degree apart, on the picture", px_error, oracle, 5, "px", "pixels", "flat triangles"},

    // Half a step of the heights, 0.24 mm, at ground half as far away as the eye is high.
    // Beside other bounds here these are of what the data leave out, and not of drawing: fbm whose smallest
    // cells are 2.7 m wide, cut off at 14 octaves.
    {surfaces, "ground between posts 1 second apart", "height of the surface", rule, 9, "m", "places",
     "no drawing: fbm of 14 octaves, -200 to 4,000 m, as seen from 1 km above it"},
    {surfaces, "ground between posts 1 second apart, median", "the median of that", rule, 1.2, "m", "places",
     ""},
    {surfaces, "ground between posts 1 second apart, plan's estimate", "how often the largest", rule, 1, "",
     "places", "what plan says of it: worst", true},
    {surfaces, "ground between posts 1 second apart, plan's typical one", "how often the median", rule, 1, "",
     "places", "and typical", true},
    {surfaces, "ground between posts 3 seconds apart", "height of the surface", rule, 22, "m", "places",
     "the same ground"},
    {surfaces, "ground between posts 3 seconds apart, median", "the median of that", rule, 3.3, "m", "places",
     ""},
    {surfaces, "ground between posts 3 seconds apart, plan's estimate", "how often the largest", rule, 1, "",
     "places", "what plan says of it: worst", true},
    {surfaces, "ground between posts 3 seconds apart, plan's typical one", "how often the median", rule, 1,
     "", "places", "and typical", true},
    {surfaces, "ground between posts 30 seconds apart", "height of the surface", rule, 175, "m", "places",
     "the same ground"},
    {surfaces, "ground between posts 30 seconds apart, median", "the median of that", rule, 23, "m", "places",
     ""},
    {surfaces, "ground between posts 30 seconds apart, plan's estimate", "how often the largest", rule, 1, "",
     "places", "what plan says of it: worst", true},
    {surfaces, "ground between posts 30 seconds apart, plan's typical one", "how often the median", rule, 1,
     "", "places", "and typical", true},

    {steep, "0.5 m above slopes of 30 degrees, displacement", px_error, oracle, 1.32, "px", "pixels",
     "half a step of height, 0.24 mm, besides 0.05 px"},
    {steep, "0.5 m above slopes of 30 degrees, surface", surface_error, oracle, 1.32, "px", "pixels", ""},
    {steep, "0.5 m above slopes of 30 degrees, seen", seen_error, rays, 1.3356, "px", "pixels", ""},
    {steep, "0.5 m above slopes of 30 degrees, skyline", skyline_error, rays, 1.3356, "px", "columns", ""},
    {steep, "1 m above slopes of 30 degrees, displacement", px_error, oracle, 0.687, "px", "pixels", ""},
    {steep, "1 m above slopes of 30 degrees, surface", surface_error, oracle, 0.687, "px", "pixels", ""},
    {steep, "1 m above slopes of 30 degrees, seen", seen_error, rays, 0.7026, "px", "pixels", ""},
    {steep, "1 m above slopes of 30 degrees, skyline", skyline_error, rays, 0.7026, "px", "columns", ""},
    {steep, "2 m above slopes of 30 degrees, displacement", px_error, oracle, 0.368, "px", "pixels", ""},
    {steep, "2 m above slopes of 30 degrees, surface", surface_error, oracle, 0.368, "px", "pixels", ""},
    {steep, "2 m above slopes of 30 degrees, seen", seen_error, rays, 0.3836, "px", "pixels", ""},
    {steep, "2 m above slopes of 30 degrees, skyline", skyline_error, rays, 0.3836, "px", "columns", ""},
    {steep, "5 m above slopes of 30 degrees, displacement", px_error, oracle, 0.177, "px", "pixels", ""},
    {steep, "5 m above slopes of 30 degrees, surface", surface_error, oracle, 0.177, "px", "pixels", ""},
    {steep, "5 m above slopes of 30 degrees, seen", seen_error, rays, 0.1926, "px", "pixels", ""},
    {steep, "5 m above slopes of 30 degrees, skyline", skyline_error, rays, 0.1926, "px", "columns", ""},
    {steep, "10 m above slopes of 30 degrees, displacement", px_error, oracle, 0.114, "px", "pixels", ""},
    {steep, "10 m above slopes of 30 degrees, surface", surface_error, oracle, 0.114, "px", "pixels", ""},
    {steep, "10 m above slopes of 30 degrees, seen", seen_error, rays, 0.1296, "px", "pixels", ""},
    {steep, "10 m above slopes of 30 degrees, skyline", skyline_error, rays, 0.1296, "px", "columns", ""},
    {steep, "100 m above slopes of 30 degrees, displacement", px_error, oracle, 0.056, "px", "pixels", ""},
    {steep, "100 m above slopes of 30 degrees, surface", surface_error, oracle, 0.056, "px", "pixels", ""},
    {steep, "100 m above slopes of 30 degrees, seen", seen_error, rays, 0.0716, "px", "pixels", ""},
    {steep, "100 m above slopes of 30 degrees, skyline", skyline_error, rays, 0.0716, "px", "columns", ""},
    {steep, "1,000 m above slopes of 30 degrees, displacement", px_error, oracle, 0.0506, "px", "pixels", ""},
    {steep, "1,000 m above slopes of 30 degrees, surface", surface_error, oracle, 0.0506, "px", "pixels", ""},
    {steep, "1,000 m above slopes of 30 degrees, seen", seen_error, rays, 0.0662, "px", "pixels", ""},
    {steep, "1,000 m above slopes of 30 degrees, skyline", skyline_error, rays, 0.0662, "px", "columns", ""},
    {steep, "a wall of 9 km in one cell, from the side, displacement", px_error, oracle, px_bound, "px",
     "pixels", "seen from 0.6 and 3 km"},
    {steep, "a wall of 9 km in one cell, from the side, surface", surface_error, oracle, px_bound, "px",
     "pixels", ""},
    {steep, "a wall of 9 km in one cell, from the side, seen", seen_error, rays, px_bound + found_px, "px",
     "pixels", ""},
    {steep, "a wall of 9 km in one cell, from the side, skyline", skyline_error, rays, px_bound + found_px,
     "px", "columns", ""},
    {steep, "a wall of 9 km in one cell, from above, displacement", px_error, oracle, px_bound, "px",
     "pixels", "from 2 and 3 km over its top"},
    {steep, "a wall of 9 km in one cell, from above, surface", surface_error, oracle, px_bound, "px",
     "pixels", ""},
    {steep, "a wall of 9 km in one cell, from above, seen", seen_error, rays, px_bound + found_px, "px",
     "pixels", ""},
    {steep, "a wall of 9 km in one cell, from above, skyline", skyline_error, rays, px_bound + found_px, "px",
     "columns", ""},
    {steep, "spikes of 100 and 500 m on a plain, skyline", skyline_error, rays, px_bound + found_px, "px",
     "columns", "one post, 2 to 15 km away"},
    {steep, "the skyline where no pixel of the mask differs", skyline_error, rays, px_bound + found_px, "px",
     "columns", "640 x 360 px over rough terrain"},
    {steep, "--earth sphere straight down from 60 km", px_error, "GeographicLib", 1.5, "px", "pixels",
     "a plain at 46 to 47 N in 1600 x 1000 px and 60 degrees: what moves sideways is seen", true},
    {steep, "--earth sphere straight down from 60 km, median", px_error, "GeographicLib", 0.75, "px",
     "pixels", "", true},
    {steep, "--earth sphere straight down from 60 km, as measured", "error of the displacement",
     "GeographicLib", 0.001, "px", "pixels", ""},

    {data, "one row of posts, one column, one post", "pixels with ground", "nothing", 0, "", "pixels",
     "no surface"},
    {data, "all void", "pixels with ground", "nothing", 0, "", "pixels", ""},
    {data, "every second post void", "pixels with ground", "nothing", 0, "", "pixels", "no triangle is left"},
    {data, "two rows of two posts", px_error, oracle, 0.002, "m", "pixels", ""},
    {data, "two rows of two posts, what is seen", wrong, rays, 0, "", "pixels", ""},
    {data, "all posts equal", px_error, oracle, 0.002, "m", "pixels", ""},
    {data, "all posts equal, what is seen", wrong, rays, 0, "", "pixels", ""},
    {data, "heights of +-32,767 m", px_error, oracle, px_bound, "px", "pixels",
     "made directly; readers take them for void"},
    {data, "heights of +-32,767 m, in metres", px_error, oracle, 0.3, "m", "pixels", "on slopes of 12 in 1"},
    {data, "heights of +-32,767 m, what is seen", wrong, rays, 0, "", "pixels", ""},
    {data, "16 bits with +-32,767 and 9,001 m, as read", "posts not void, or void in vain",
     "what was written", 0, "", "posts", "beyond -12,000 and 9,000 m is void; with and without --fill-voids"},
    {data, "16 bits with +-32,767 and 9,001 m, what is seen", wrong, rays, 0, "", "pixels", ""},
    {data, "float32 with NaN and infinities, as read", "posts not void, or void in vain", "what was written",
     0, "", "posts", "with and without --fill-voids"},
    {data, "float32 with NaN and infinities, what is seen", wrong, rays, 0, "", "pixels", ""},
    {data, "everything sent to the GPU in all these cases", "numbers that are NaN or infinite", "none", 0, "",
     "floats", "pages, tables of rows and columns, constants, styles"},

    {large, "100 million posts, --tau 1", px_error, oracle, 1.05, "px", "pixels",
     "from 100 m to 400 km above it"},
    {large, "100 million posts, what is seen", wrong, rays, 0, "", "pixels", "--tau 0.02"},
};

}  // namespace

std::span<const AccuracyRow> accuracy_rows() {
    return rows;
}

}  // namespace oro::test
