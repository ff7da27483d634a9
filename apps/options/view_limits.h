// The least and the most that numbers of a view may be which more than one place asks for; those of one
// option alone stand in its row (apps/view/view_option_table.cpp).
#pragma once

#include <cstdint>

namespace oro {

struct Limits {
    double low;
    double high;

    // False for what is no number, too.
    [[nodiscard]] constexpr bool hold(double value) const { return value >= low && value <= high; }
};

namespace view_limits {

inline constexpr Limits lat_deg{-90, 90};
inline constexpr Limits lon_deg{-180, 180};
inline constexpr Limits eye_h_m{-7e6, 2e9};  // from the Earth's middle to five times the moon's distance
inline constexpr Limits fov_deg{0.05, 120};
inline constexpr Limits side_px{1, 65500};  // what JPEG can hold; PNG and TIFF hold more
// Of panoramas. Higher and lower rows would be drawn ever taller: at 75 degrees 15 times as tall as level
// ones.
inline constexpr Limits panorama_width_px{100, 50000};
inline constexpr Limits azimuth_deg{-360, 360};
inline constexpr Limits sweep_deg{0.1, 360};
inline constexpr Limits elevation_deg{-75, 75};
inline constexpr double least_elevations_deg = 0.02;
inline constexpr Limits drape_opacity{0, 1};
inline constexpr Limits overlay_width_px{0.5, 50};
inline constexpr Limits overlay_fill{0, 1};
inline constexpr Limits sun_azimuth_deg{-1e9, 1e9};
inline constexpr Limits sun_elevation_deg{-90, 90};
inline constexpr Limits refraction_k{-1, 0.9};
inline constexpr Limits visibility_km{0.05, 288};  // molecules alone: 288.5
// The years 0 to 9999, as many as a picture's tags can tell.
inline constexpr Limits time_utc_s{-62167219200, 253402300799};
// Of options that place an eye, whose h is held to eye_h_m when it has its place.
inline constexpr Limits altitude_m{-12000, 1e9};
inline constexpr Limits above_m{-12000, 1e9};
inline constexpr Limits contour_interval_m{0.1, 5000};
inline constexpr Limits feather_m{0.01, 1e6};
inline constexpr Limits crease_deg{0, 180};
// Ends of a line of sight: from the deepest trench to far above the air.
inline constexpr Limits sight_h_m{-12000, 1e6};
// Of unknown ground, above sea level.
inline constexpr Limits unseen_ceiling_m{-12000, 100000};

}  // namespace view_limits
}  // namespace oro
