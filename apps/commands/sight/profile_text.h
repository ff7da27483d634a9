// What orograph profile found, as people and as programs read it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/commands/sight/line_along.h"
#include "core/sight/ground_profile.h"

namespace oro {

// Where the ground along a line passes the 180th meridian.
struct MeridianCrossing {
    std::size_t after{};  // number of the point before it
    ProfilePoint point;
};

struct Profile {
    LineAlong line;
    std::vector<ProfilePoint> points;
    std::vector<MeridianCrossing> crossings;  // ascending; of lines that are written as GeoJSON
    ProfileSums sums;
    [[nodiscard]] double length_m() const { return line.distances_m.back(); }
};

std::string profile_text(const Profile& profile);
nlohmann::ordered_json profile_json(const Profile& profile);

// "46.570000,7.990000 to 46.620000,8.050000"
std::string ends_text(const Profile& profile);

}  // namespace oro
