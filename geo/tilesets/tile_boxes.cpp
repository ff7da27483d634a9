#include "geo/tilesets/tile_boxes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/earth/ellipsoid.h"

namespace oro {

TileBox joined(const TileBox& a, const TileBox& b) {
    constexpr double turn_deg = 360.0;
    const double shift_deg =
        turn_deg * std::round(0.5 * (a.west_deg + a.east_deg - b.west_deg - b.east_deg) / turn_deg);
    TileBox box{std::min(a.west_deg, b.west_deg + shift_deg), std::min(a.south_deg, b.south_deg),
                std::max(a.east_deg, b.east_deg + shift_deg), std::max(a.north_deg, b.north_deg),
                std::min(a.lowest_h_m, b.lowest_h_m),         std::max(a.highest_h_m, b.highest_h_m)};
    if (box.east_deg - box.west_deg >= turn_deg) box.west_deg = -180.0, box.east_deg = 180.0;
    return box;
}

double size_m(const TileBox& box) {
    const double tall = radians_from_deg(box.north_deg - box.south_deg).rad;
    const double wide = radians_from_deg(box.east_deg - box.west_deg).rad;
    return std::hypot((wgs84_a_m + std::max(0.0, box.highest_h_m)) * std::min(2.0, std::hypot(tall, wide)),
                      box.highest_h_m - box.lowest_h_m);
}

nlohmann::ordered_json region_json_of(const TileBox& box) {
    const auto lon_rad = [](double lon_deg) { return radians_from_deg(std::remainder(lon_deg, 360.0)).rad; };
    const bool round = box.east_deg - box.west_deg >= 360.0;
    constexpr double half_turn = std::numbers::pi;
    auto list = nlohmann::ordered_json::array();
    for (const double value : {round ? -half_turn : lon_rad(box.west_deg),
                               radians_from_deg(box.south_deg).rad, round ? half_turn : lon_rad(box.east_deg),
                               radians_from_deg(box.north_deg).rad, box.lowest_h_m, box.highest_h_m})
        list.push_back(value);
    return list;
}

}  // namespace oro
