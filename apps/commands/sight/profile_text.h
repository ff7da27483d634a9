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

// What a plumb line meets first at a point of a profile, of a region with meshes.
struct ProfileRoof {
    bool is_there{};
    double H_m{}, h_m{};
    std::string on;  // the feature of the mesh, or its file
};

struct Profile {
    LineAlong line;
    std::vector<ProfilePoint> points;
    std::vector<ProfileRoof> roofs;           // of each point; empty: the region has no meshes
    std::vector<MeridianCrossing> crossings;  // ascending; of lines that are written as GeoJSON
    ProfileSums sums;
    [[nodiscard]] double length_m() const { return line.distances_m.back(); }
};

std::string profile_text(const Profile& profile);
nlohmann::ordered_json profile_json(const Profile& profile);

// "46.570000,7.990000 to 46.620000,8.050000"
std::string ends_text(const Profile& profile);

// Comma-separated, with a line of names: distance_m, lat_deg, lon_deg, H_m, h_m; with meshes top_H_m, top_h_m
// and on. No heights over no ground, no top where no mesh is.
std::string profile_csv(const Profile& profile);
// A feature whose line has h (above the ellipsoid) for its third number, as RFC 7946 wants it, cut where
// there is no ground and at the 180th meridian. Its properties: what profile_json() says; and distance_m and
// H_m of each point, a list for each part.
std::string profile_geojson(const Profile& profile);
// 1000 x 420 px.
std::string profile_svg(const Profile& profile);
// Each of these by the ending of a file's name: .csv, .svg, else GeoJSON, which wants the profile's
// crossings.
std::string profile_file_text(const Profile& profile, const std::string& name);

}  // namespace oro
