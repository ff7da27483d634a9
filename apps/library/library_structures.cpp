#include "apps/library/library_structures.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "apps/library/guarded_call.h"
#include "apps/view/view.h"
#include "geo/rasters/post_raster.h"

namespace oro {
namespace {

// All digits that a number takes, without an exponent: places are written so.
std::string fixed_text(double value) {
    std::array<char, 400> digits{};
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed);
    return {digits.data(), end.ptr};
}

// Nothing on the Earth is so near to 0 degrees, and its digits would be hundreds.
double without_dust(double angle_deg) {
    constexpr double dust_deg = 1.0e-15;
    return std::abs(angle_deg) < dust_deg ? 0.0 : angle_deg;
}

}  // namespace

Result<Standing> standing_at(const char* name, const oro_point& point, bool on_summit) {
    ORO_CHECK(check_place(name, point.lat_deg, point.lon_deg));
    if (!std::isfinite(point.height_m)) return bad_argument(name, "its height_m is no number");
    const std::string place =
        fixed_text(without_dust(point.lat_deg)) + "," + fixed_text(without_dust(point.lon_deg));
    Standing standing{name, place, "height_m", std::nullopt, 0.0, std::nullopt, "a height above the geoid"};
    standing.on_summit = on_summit;
    if (point.above == ORO_ABOVE_GROUND) {
        standing.above_m = point.height_m;
    } else if (point.above == ORO_ABOVE_GEOID) {
        standing.altitude_m = point.height_m;
    } else if (point.above == ORO_ABOVE_ELLIPSOID) {
        constexpr double most_m = 1.0e12;
        if (std::abs(point.height_m) > most_m) return bad_argument(name, "its height_m is beyond 1e12");
        standing.place = "geo:" + place + "," + fixed_text(without_dust(point.height_m));
    } else {
        return bad_argument(name, "its above, " + std::to_string(point.above) + ", is none of ORO_ABOVE_...");
    }
    return standing;
}

Result<Air> air_of(int air, double refraction_k) {
    if (air == ORO_AIR_STANDARD) return standard_air;
    if (air != ORO_AIR_CONSTANT) return bad_argument("air", std::to_string(air) + " is none of ORO_AIR_...");
    return air_asked_for(refraction_k, std::nullopt, standard_air);
}

Result<std::vector<std::string>> strings_of(const char* name, const char* const* texts, std::size_t count) {
    std::vector<std::string> strings;
    if (count == 0) return strings;
    ORO_CHECK(check_given(name, texts));
    constexpr std::size_t most = 10'000'000;
    if (count > most) return bad_argument(name, std::to_string(count) + " of them are more than 10,000,000");
    for (std::size_t i = 0; i < count; ++i) {
        if (texts[i] == nullptr) return bad_argument(name, "number " + std::to_string(i) + " is NULL");
        strings.emplace_back(texts[i]);
    }
    return strings;
}

Result<void> check_window(const oro_window* window) {
    ORO_CHECK(check_given("window", window));
    return check_size("window", window->size, sizeof(oro_window));
}

void fill_window(std::size_t grid_number, const RegionGrid& grid, const GridPart& part, oro_window& window) {
    window.grid = grid_number;
    window.first_row = part.first_row;
    window.first_column = part.first_column;
    window.rows = static_cast<std::size_t>(part.rows);
    window.columns = static_cast<std::size_t>(part.columns);
    std::ranges::copy(transform_of_posts(grid.field.grid, grid.posts_crs, part), window.transform);
    window.known = window.seen = 0;
}

Result<void> give_text(const std::string& from, char* text, std::size_t capacity, std::size_t* length) {
    *length = from.size();
    if (text == nullptr && capacity == 0) return {};
    ORO_CHECK(check_given("text", text));
    if (capacity <= from.size())
        throw TooSmall{"text: takes " + std::to_string(from.size() + 1) + " bytes, and has " +
                       std::to_string(capacity)};
    std::memcpy(text, from.c_str(), from.size() + 1);
    return {};
}

}  // namespace oro
