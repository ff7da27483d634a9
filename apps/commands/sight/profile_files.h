// A profile as files of other programs: a table, a line, a drawing.
#pragma once

#include <string>

#include "apps/commands/sight/profile_text.h"

namespace oro {

// Comma-separated, with a line of names: distance_m, lat_deg, lon_deg, H_m, h_m. No heights over no ground.
std::string profile_csv(const Profile& profile);
// A feature whose line has h (above the ellipsoid) for its third number, as RFC 7946 wants it, cut where
// there is no ground and at the 180th meridian. Its properties: what profile_json() says; and distance_m and
// H_m of each point, a list for each part.
std::string profile_geojson(const Profile& profile);
// 1000 x 420 px.
std::string profile_svg(const Profile& profile);

}  // namespace oro
