// A place in the forms that maps and receivers have for it.
#pragma once

#include <string>

namespace oro {

// Each is of a place of WGS84, latitude in [-90, 90], and is read back by parse_place().
// 46°34'35.12"N 7°59'25.44"E: to a hundredth of a second, 0.3 m.
std::string dms_text(double lat_deg, double lon_deg);
// 32T 422629 5158683: whole metres, with the band's letter; UPS has the hemisphere and its zone's letter.
std::string utm_text(double lat_deg, double lon_deg);
// 32TMS2262958683: the square of a metre that the place is in.
std::string mgrs_text(double lat_deg, double lon_deg);

}  // namespace oro
