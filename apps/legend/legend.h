// What stands below a picture or a map, so that it can hang on a wall: north, scale, colours, eye, sun, and
// where the data come from.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/drawing/picking.h"
#include "apps/legend/shown_ground.h"
#include "apps/view/style.h"
#include "apps/view/view.h"

namespace oro {

// A narrower picture has no room for one.
inline constexpr int least_legend_px = 200;

// Pictures that explain a frame (--show) have one by themselves, if they are not too narrow.
bool has_own_legend(const View& view);

// A strip of the picture's width, rows of sRGB from the top; `middle` is what the picture sees there,
// `ground` the view's. Follows from the view, the data and the style alone: the same view, the same bytes.
// Errors (usage): a picture that is less than 200 px wide; those of text, of the map's CRS and of
// ground_shown().
Result<std::vector<std::uint8_t>> legend_strip(const View& view, const Region& region, const Style& style,
                                               const std::optional<SeenPlace>& middle,
                                               const RegionGround& ground);
// The strip where the view has a legend, and no bytes where it has none; the view keeps how high it is.
Result<std::vector<std::uint8_t>> strip_of(View& view, const Region& region, const Style& style,
                                           const std::optional<SeenPlace>& middle,
                                           const RegionGround& ground);

// What it says, in lines: eye or map, sun, data, detail. English, without line ends. Trees, grass and a
// rule's ground are named where what is shown may have them; null: not known, all are named.
std::vector<std::string> legend_lines(const View& view, const Region& region, const Style& style,
                                      const ShownGround* shown = nullptr);

// Metres across the line of sight that a pixel in the middle shows; nothing where that shows no ground.
std::optional<double> metres_a_pixel(const View& view, const std::optional<SeenPlace>& middle);
// A level plane that is seen from below, or at a smaller angle than this, says little of directions: all of
// it lies to the left or to the right, and from below north and south change places.
inline constexpr double least_seen_level_deg = 10.0;
// Where north is in the picture at its middle, degrees clockwise from up: as on a level plane through the
// ground there, or as on a compass that lies before the viewer, where the middle shows no ground, or that
// plane from below or at less than least_seen_level_deg. That compass has north up in a view to the north.
double north_in_picture_deg(const View& view, const std::optional<SeenPlace>& middle);
// 1, 2 or 5 times a power of ten, at most `most`.
double round_length(double most);

}  // namespace oro
