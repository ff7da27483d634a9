// Names beside each other on a picture, none over another.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "apps/names/seen_points.h"
#include "core/base/result.h"

namespace oro {

// A rectangle of a picture, pixels from its top left corner.
struct Box {
    double left{};
    double top{};
    double right{};
    double bottom{};
    [[nodiscard]] bool touches(const Box& other) const {
        return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
};

// A name, H and distance below it, and a line from there down (or up) to the point.
struct NameLabel {
    SeenPoint point;
    std::string heights;    // "3967 m  4.2 km"
    Box box;                // of the text with its halo
    Box leader;             // of the line with its halo
    glm::dvec2 name_px;     // middle of the name, at half the height of its capitals
    glm::dvec2 heights_px;  // the same of what is below it
    double size_px{};       // of the name's em
};

// Sizes of a picture's names: the em, 1/72 of the picture's height and 11 px at least; of the line below.
double name_size_px(int picture_height_px);
inline constexpr double heights_share = 0.8;
inline constexpr double name_halo_share = 0.17;  // of the em

// "3967 m  4.2 km": distances below 10 km have a decimal, those below 1 km are metres.
std::string heights_words(double H_m, double distance_m);

using NameWidth = std::function<Result<double>(const std::string& text, double size_px)>;

// Goes through the points in their order. Each label stands above its point, near to it but not where it
// leaves others without room, or below it where there is none above; it touches neither a text nor a line of
// those before it, nor the picture's border. Points without room go without. The same for the same points.
// Errors: those of `width`.
Result<std::vector<NameLabel>> name_labels(const std::vector<SeenPoint>& points, int width_px, int height_px,
                                           const NameWidth& width);

}  // namespace oro
