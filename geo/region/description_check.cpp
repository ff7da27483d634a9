#include "geo/region/description_check.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <optional>

#include "geo/region/region_fingerprints.h"

namespace oro {
namespace {

std::string in_digits(double number) {
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", number);
    return text;
}
std::string in_hex(std::uint64_t number) {
    char text[20];
    std::snprintf(text, sizeof text, "%016" PRIx64, number);
    return text;
}

std::string tells(const std::string& what, const std::string& recorded, const std::string& found) {
    return "its description tells " + what + " " + recorded + ", but the data have " + found;
}

double width_deg(const BoundingBox& box) {
    const double width = box.east_deg - box.west_deg;
    return width < 0.0 ? width + 360.0 : width;
}

std::string box_words(const BoundingBox& box) {
    return in_digits(box.west_deg) + "," + in_digits(box.south_deg) + "," + in_digits(box.east_deg) + "," +
           in_digits(box.north_deg);
}

// Whether boxes have a place in common, or are no more than `slack_deg` apart.
bool boxes_touch(const BoundingBox& one, const BoundingBox& other, double slack_deg) {
    if (one.south_deg > other.north_deg + slack_deg || other.south_deg > one.north_deg + slack_deg)
        return false;
    // From the west side of one, eastwards, to that of the other.
    const auto turned = [](double deg) { return deg - 360.0 * std::floor(deg / 360.0); };
    return turned(other.west_deg - one.west_deg + slack_deg) <= width_deg(one) + 2.0 * slack_deg ||
           turned(one.west_deg - other.west_deg + slack_deg) <= width_deg(other) + 2.0 * slack_deg;
}

// Of a source whose posts are those of a grid on degrees: their number between the sides of its box.
std::optional<std::string> wrong_counts(const SourceReport& source) {
    const auto differs = [](int posts, double side_deg, double spacing_deg) {
        return !(std::abs(side_deg / spacing_deg - (posts - 1)) <= 1.0);
    };
    const auto wrong_count = [&](const char* what, int posts, double side_deg, double spacing_deg) {
        return tells(what + (" of " + source.path), std::to_string(posts),
                     in_digits(std::round(side_deg / spacing_deg) + 1.0) + " in its box");
    };
    const double height_deg = source.box.north_deg - source.box.south_deg, across_deg = width_deg(source.box);
    if (differs(source.rows, height_deg, source.lat_spacing_deg))
        return wrong_count("the rows", source.rows, height_deg, source.lat_spacing_deg);
    const bool is_round = across_deg > 360.0 - 2.0 * source.lon_spacing_deg || across_deg == 0.0;
    if (!is_round && differs(source.columns, across_deg, source.lon_spacing_deg))
        return wrong_count("the columns", source.columns, across_deg, source.lon_spacing_deg);
    return std::nullopt;
}

bool has_posts_of_grid(const SourceReport& source) {
    return source.placement && source.placement->fit == Fit::same_posts;
}

std::optional<std::string> wrong_source(const SourceReport& source, const PostGrid& grid) {
    const BoundingBox box{grid.west_deg(), grid.south_deg(), grid.east_deg(), grid.north_deg()};
    const double slack_deg = 2.0 * std::max(source.lat_spacing_deg, source.lon_spacing_deg);
    if (!boxes_touch(source.box, box, slack_deg))
        return tells("the box of " + source.path, box_words(source.box), "theirs at " + box_words(box));
    if (grid.net || !has_posts_of_grid(source)) return std::nullopt;
    constexpr double same_spacing = 1.0e-3;
    if (!(std::abs(source.lat_spacing_deg / grid.lat.spacing_deg() - 1.0) <= same_spacing))
        return tells("posts of " + source.path + " every", in_digits(source.lat_spacing_deg),
                     in_digits(grid.lat.spacing_deg()) + " degrees of latitude");
    if (!(std::abs(source.lon_spacing_deg / grid.lon.spacing_deg() - 1.0) <= same_spacing))
        return tells("posts of " + source.path + " every", in_digits(source.lon_spacing_deg),
                     in_digits(grid.lon.spacing_deg()) + " degrees of longitude");
    return wrong_counts(source);
}

// Of posts that are their sources', copied: no height is beyond all that the sources brought, and of one
// source the lowest and the highest are its own.
std::optional<std::string> wrong_heights(const RegionGrid& grid) {
    if (grid.sources.empty() || !std::ranges::all_of(grid.sources, has_posts_of_grid) || grid.filled > 0)
        return std::nullopt;
    const HeightRange range = height_range(grid.field);
    if (range.voids >= grid.field.grid.post_count()) return std::nullopt;
    constexpr double same_height_m = 1.0e-3;
    double lowest_m = grid.sources.front().lowest_m, highest_m = grid.sources.front().highest_m;
    for (const SourceReport& source : grid.sources) {
        lowest_m = std::min(lowest_m, source.lowest_m);
        highest_m = std::max(highest_m, source.highest_m);
    }
    // Posts that are one point get one height: those of a pole, and of a meridian's two columns.
    constexpr double near_pole_deg = 90.0 - 1.0e-9;
    const PostGrid& posts = grid.field.grid;
    const bool are_apart =
        !posts.wraps_longitude() && posts.north_deg() < near_pole_deg && posts.south_deg() > -near_pole_deg;
    const bool one = grid.sources.size() == 1 && are_apart;
    const std::string of =
        grid.sources.size() == 1 ? "of " + grid.sources.front().path : std::string("of all its files");
    const auto found_lowest_m = static_cast<double>(range.lowest_m),
               found_highest_m = static_cast<double>(range.highest_m);
    if (lowest_m > found_lowest_m + same_height_m || (one && lowest_m < found_lowest_m - same_height_m))
        return tells("the lowest H in metres " + of, in_digits(lowest_m), in_digits(found_lowest_m));
    if (highest_m < found_highest_m - same_height_m || (one && highest_m > found_highest_m + same_height_m))
        return tells("the highest H in metres " + of, in_digits(highest_m), in_digits(found_highest_m));
    return std::nullopt;
}

}  // namespace

Result<void> check_description(const RegionGrid& grid, bool may_be_feathered, const std::string& name) {
    const auto fault = [&](const std::string& what) {
        return Error{ErrorKind::failed, grid.file ? grid.file->path() : std::string("region"), name + what};
    };
    const bool is_cut = std::ranges::any_of(
        grid.notes, [](const std::string& note) { return note.starts_with(clipped_from); });
    for (const SourceReport& source : grid.sources) {
        if (is_cut) break;
        if (const auto wrong = wrong_source(source, grid.field.grid)) return fault(*wrong);
    }
    if (may_be_feathered) return {};
    if (!is_cut) {
        if (const auto wrong = wrong_heights(grid)) return fault(*wrong);
    }
    const std::uint64_t found = posts_hash(grid.field);
    ORO_CHECK(grid.field.health());
    if (found != grid.posts_hash)
        return fault(tells("the fingerprint of its posts", in_hex(grid.posts_hash), in_hex(found)));
    return {};
}

}  // namespace oro
