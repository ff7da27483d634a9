// Which numbers the outline of a baked grid may hold.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "core/baked/region_format.h"

namespace oro::region_format {
namespace {

// Where the numbers lie that errors name.
constexpr std::uint64_t at_lat = 8, at_lon = 40, at_undulation_lat = 72, at_undulation_lon = 104,
                        at_radii = 136, at_heights = 160, at_voids = 168, at_triangles = 176;
// More posts would overflow the numbers of quads and pages in core/terrain/level_grid.h.
constexpr int most_posts = std::numeric_limits<int>::max() - 255;
constexpr std::int64_t largest_index = std::int64_t{1} << 53U;  // exact in a double
constexpr double angle_slack_deg = 1.0e-6;                      // of spacings that were rounded

std::string said(double number) {
    char text[40];
    std::snprintf(text, sizeof(text), "%.9g", number);
    return text;
}
std::string said(std::uint64_t number) {
    return std::to_string(number);
}

// Keeps the first thing that is wrong.
class Findings {
  public:
    // True while all is well.
    template <class Number>
    bool require(bool fine, std::uint64_t offset, const char* name, Number found,
                 const std::string& expected) {
        if (!fine && !first_)
            first_ = Implausible{offset, name + (" " + said(found)) + ", expected " + expected};
        return !first_;
    }
    [[nodiscard]] std::optional<Implausible> first() const { return first_; }

  private:
    std::optional<Implausible> first_;
};

bool within(double number, double lowest, double highest) {
    return number >= lowest && number <= highest;  // no NaN is
}

void check_axis(Findings& findings, const GridAxis& axis, int step, std::uint64_t offset) {
    findings.require(within(axis.posts_per_deg, 1.0e-3, 1.0e9), offset, "posts per degree",
                     axis.posts_per_deg, "0.001 to 1e9");
    findings.require(within(axis.phase_deg, -720.0, 720.0), offset + 8, "phase", axis.phase_deg,
                     "-720 to 720 degrees");
    findings.require(axis.first >= -largest_index && axis.first <= largest_index, offset + 16,
                     "first post's index", static_cast<double>(axis.first), "at most 2^53");
    findings.require(axis.step == step, offset + 24, "step", static_cast<double>(axis.step),
                     step > 0 ? "1" : "-1");
    findings.require(axis.count >= 1 && axis.count <= most_posts, offset + 28, "posts",
                     static_cast<double>(axis.count), "1 to " + std::to_string(most_posts));
}

void check_angles(Findings& findings, const PostGrid& grid, std::uint64_t lat_offset,
                  std::uint64_t lon_offset, double beyond_deg) {
    if (findings.first()) return;  // at_deg needs numbers that are sound
    const double limit_deg = 90.0 + beyond_deg;
    findings.require(within(grid.north_deg(), -limit_deg, limit_deg), lat_offset, "northernmost latitude",
                     grid.north_deg(), "-90 to 90");
    findings.require(within(grid.south_deg(), -limit_deg, limit_deg), lat_offset, "southernmost latitude",
                     grid.south_deg(), "-90 to 90");
    findings.require(within(grid.west_deg(), -360.0 - beyond_deg, 360.0 + beyond_deg), lon_offset,
                     "westernmost longitude", grid.west_deg(), "-360 to 360");
    const double width_deg = (grid.lon.count - 1) / grid.lon.posts_per_deg;
    findings.require(within(width_deg, 0.0, 360.0 + 0.01 / grid.lon.posts_per_deg + beyond_deg), lon_offset,
                     "width in degrees", width_deg, "at most 360");
}

void check_undulation(Findings& findings, const OutlineNumbers& numbers, std::uint64_t stored_bytes) {
    const GridAxis& lat = numbers.undulation_lat;
    const GridAxis& lon = numbers.undulation_lon;
    if (stored_bytes == 0 && lat.count == 0 && lon.count == 0) {
        for (const auto& [axis, at] : {std::pair(&lat, at_undulation_lat), {&lon, at_undulation_lon}}) {
            findings.require(within(axis->posts_per_deg, 0.0, 1.0e9), at, "nodes per degree",
                             axis->posts_per_deg, "0 to 1e9");
            findings.require(within(axis->phase_deg, -720.0, 720.0), at + 8, "phase", axis->phase_deg,
                             "-720 to 720 degrees");
        }
        return;
    }
    check_axis(findings, lat, -1, at_undulation_lat);
    check_axis(findings, lon, +1, at_undulation_lon);
    // Nodes reach up to one beyond the region on each side.
    const double beyond_deg =
        findings.first() ? 0.0 : 2.0 / lon.posts_per_deg + 2.0 / lat.posts_per_deg + angle_slack_deg;
    check_angles(findings, {lat, lon}, at_undulation_lat, at_undulation_lon, beyond_deg);
    const std::uint64_t bytes = sizeof(float) * static_cast<std::uint64_t>(std::max(0, lat.count)) *
                                static_cast<std::uint64_t>(std::max(0, lon.count));
    findings.require(stored_bytes == bytes, at_undulation_lat + 28, "bytes of undulation", stored_bytes,
                     said(bytes));
    findings.require(bytes / sizeof(float) <= most_undulation_nodes, at_undulation_lat + 28,
                     "nodes of undulation", bytes / sizeof(float), "at most " + said(most_undulation_nodes));
}

void check_terrain(Findings& findings, const OutlineNumbers& numbers) {
    for (int i = 0; i < 3; ++i)
        findings.require(within(numbers.occluder_radii_m[i], 1.0, 1.0e7),
                         at_radii + 8U * static_cast<unsigned>(i), "occluder radius in metres",
                         numbers.occluder_radii_m[i], "1 to 1e7");
    const auto lowest_m = static_cast<double>(numbers.lowest_H_m);
    const auto highest_m = static_cast<double>(numbers.highest_H_m);
    findings.require(std::isfinite(lowest_m), at_heights, "lowest height", lowest_m, "a finite one");
    findings.require(std::isfinite(highest_m) && highest_m >= lowest_m, at_heights + 4, "highest height",
                     highest_m, "a finite one, no lower than " + said(lowest_m));
    if (findings.first()) return;
    const auto rows = static_cast<std::uint64_t>(numbers.lat.count);
    const auto columns = static_cast<std::uint64_t>(numbers.lon.count);
    findings.require(numbers.voids <= rows * columns, at_voids, "void posts", numbers.voids,
                     "at most " + said(rows * columns));
    const std::uint64_t triangles = 2 * (rows - 1) * (columns - 1);
    findings.require(numbers.triangles <= triangles, at_triangles, "triangles", numbers.triangles,
                     "at most " + said(triangles));
}

void check_net_axis(Findings& findings, const GridAxis& axis, int step, std::uint64_t offset) {
    findings.require(axis.posts_per_deg == 0.0, offset, "posts per degree of a net", axis.posts_per_deg, "0");
    findings.require(axis.phase_deg == 0.0, offset + 8, "phase of a net", axis.phase_deg, "0");
    findings.require(axis.first == 0, offset + 16, "first post's index of a net",
                     static_cast<double>(axis.first), "0");
    findings.require(axis.step == step, offset + 24, "step", static_cast<double>(axis.step),
                     step > 0 ? "1" : "-1");
    findings.require(axis.count >= 2 && axis.count <= most_posts, offset + 28, "posts",
                     static_cast<double>(axis.count), "2 to " + std::to_string(most_posts));
}

}  // namespace

std::optional<Implausible> implausible(const OutlineNumbers& numbers, std::uint64_t undulation_bytes,
                                       bool on_net) {
    Findings findings;
    // What the coefficients of a net say is looked at when they are read.
    const auto check = on_net ? check_net_axis : check_axis;
    check(findings, numbers.lat, -1, at_lat);
    check(findings, numbers.lon, +1, at_lon);
    if (!on_net) check_angles(findings, {numbers.lat, numbers.lon}, at_lat, at_lon, angle_slack_deg);
    check_undulation(findings, numbers, undulation_bytes);
    check_terrain(findings, numbers);
    return findings.first();
}

std::optional<Implausible> implausible(const RegionOutline& outline) {
    const std::vector<float>& N_m = outline.undulation.N_m;
    if (const auto wrong =
            implausible(numbers_of(outline, 0), sizeof(float) * N_m.size(), outline.grid.net != nullptr))
        return wrong;
    if (outline.description.size() > longest_description)
        return Implausible{0, "its description has " + said(std::uint64_t{outline.description.size()}) +
                                  " bytes, expected at most " + said(longest_description)};
    return implausible(N_m);
}

std::optional<Implausible> implausible(std::span<const float> N_m) {
    Findings findings;
    std::uint64_t offset = 0;
    for (const float value : N_m) {
        const auto found_m = static_cast<double>(value);
        if (!findings.require(within(found_m, -1.0e5, 1.0e5), offset, "undulation in metres", found_m,
                              "-1e5 to 1e5"))
            break;
        offset += sizeof(float);
    }
    return findings.first();
}

}  // namespace oro::region_format
