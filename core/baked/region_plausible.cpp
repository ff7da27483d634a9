// Which numbers a region file's header may hold.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/baked/net_bytes.h"
#include "core/baked/region_format.h"

namespace oro::region_format {
namespace {

// Where the numbers lie that errors name.
constexpr std::uint64_t at_header_size = 12, at_file_bytes = 16, at_grid_lat = 32, at_grid_lon = 64,
                        at_undulation_lat = 96, at_undulation_lon = 128, at_radii = 160, at_heights = 184,
                        at_voids = 192, at_triangles = 200, at_description = 208, at_nodes = 216,
                        at_pages = 224;
// More posts would overflow the numbers of quads and pages in core/terrain/level_grid.h.
constexpr int most_posts = std::numeric_limits<int>::max() - 255;
constexpr std::int64_t largest_index = std::int64_t{1} << 53U;  // exact in a double
constexpr double angle_slack_deg = 1.0e-6;                      // of spacings that were rounded
constexpr std::uint64_t most_nodes = std::uint64_t{1} << 32U;

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

void check_undulation(Findings& findings, const RegionHeader& header) {
    const GridAxis& lat = header.undulation_lat;
    const GridAxis& lon = header.undulation_lon;
    if (header.undulation_nodes == 0 && lat.count == 0 && lon.count == 0) {
        findings.require(within(lat.posts_per_deg, 0.0, 1.0e9), at_undulation_lat, "nodes per degree",
                         lat.posts_per_deg, "0 to 1e9");
        findings.require(within(lon.posts_per_deg, 0.0, 1.0e9), at_undulation_lon, "nodes per degree",
                         lon.posts_per_deg, "0 to 1e9");
        findings.require(within(lat.phase_deg, -720.0, 720.0), at_undulation_lat + 8, "phase", lat.phase_deg,
                         "-720 to 720 degrees");
        findings.require(within(lon.phase_deg, -720.0, 720.0), at_undulation_lon + 8, "phase", lon.phase_deg,
                         "-720 to 720 degrees");
        return;
    }
    check_axis(findings, lat, -1, at_undulation_lat);
    check_axis(findings, lon, +1, at_undulation_lon);
    // Nodes reach up to one beyond the region on each side.
    const double beyond_deg =
        findings.first() ? 0.0 : 2.0 / lon.posts_per_deg + 2.0 / lat.posts_per_deg + angle_slack_deg;
    check_angles(findings, {lat, lon}, at_undulation_lat, at_undulation_lon, beyond_deg);
    const std::uint64_t nodes = static_cast<std::uint64_t>(std::max(0, lat.count)) *
                                static_cast<std::uint64_t>(std::max(0, lon.count));
    findings.require(header.undulation_nodes == nodes, at_nodes, "undulation nodes", header.undulation_nodes,
                     said(nodes));
    findings.require(nodes <= most_nodes, at_nodes, "undulation nodes", nodes, "at most 2^32");
}

void check_terrain(Findings& findings, const RegionHeader& header) {
    for (int i = 0; i < 3; ++i)
        findings.require(within(header.occluder_radii_m[i], 1.0, 1.0e7),
                         at_radii + 8U * static_cast<unsigned>(i), "occluder radius in metres",
                         header.occluder_radii_m[i], "1 to 1e7");
    const auto lowest_m = static_cast<double>(header.lowest_H_m);
    const auto highest_m = static_cast<double>(header.highest_H_m);
    findings.require(std::isfinite(lowest_m), at_heights, "lowest height", lowest_m, "a finite one");
    findings.require(std::isfinite(highest_m) && highest_m >= lowest_m, at_heights + 4, "highest height",
                     highest_m, "a finite one, no lower than " + said(lowest_m));
    if (findings.first()) return;
    const auto rows = static_cast<std::uint64_t>(header.grid.rows());
    const auto columns = static_cast<std::uint64_t>(header.grid.columns());
    findings.require(header.voids <= rows * columns, at_voids, "void posts", header.voids,
                     "at most " + said(rows * columns));
    const std::uint64_t triangles = 2 * (rows - 1) * (columns - 1);
    findings.require(header.triangles <= triangles, at_triangles, "triangles", header.triangles,
                     "at most " + said(triangles));
}

void check_net_axis(Findings& findings, const GridAxis& axis, int step, std::uint64_t offset) {
    findings.require(axis.posts_per_deg == 0.0, offset, "posts per degree of a net", axis.posts_per_deg, "0");
    findings.require(axis.phase_deg == 0.0, offset + 8, "phase of a net", axis.phase_deg, "0");
    findings.require(axis.step == step, offset + 24, "step", static_cast<double>(axis.step),
                     step > 0 ? "1" : "-1");
    findings.require(axis.count >= 2 && axis.count <= most_posts, offset + 28, "posts",
                     static_cast<double>(axis.count), "2 to " + std::to_string(most_posts));
}

// Of a grid on a net; what its coefficients say is looked at when they are read.
void check_net(Findings& findings, const RegionHeader& header) {
    constexpr std::uint64_t most_bytes = std::uint64_t{1} << 40U;
    check_net_axis(findings, header.grid.lat, -1, at_grid_lat);
    check_net_axis(findings, header.grid.lon, +1, at_grid_lon);
    const std::uint64_t bytes = header.net_bytes;
    // Corrections may have any size.
    findings.require(
        bytes >= net_front_bytes + patch_bytes && bytes <= most_bytes &&
            (is_on_corrected_net(header.version) || (bytes - net_front_bytes) % patch_bytes == 0),
        at_grid_lat + 16, "net bytes", bytes,
        said(net_front_bytes) + " and " + said(patch_bytes) + " for each patch");
}

// All that does not follow from other numbers.
std::optional<Implausible> implausible_given(const RegionHeader& header) {
    Findings findings;
    if (is_on_net(header.version)) {
        check_net(findings, header);
    } else {
        check_axis(findings, header.grid.lat, -1, at_grid_lat);
        check_axis(findings, header.grid.lon, +1, at_grid_lon);
        check_angles(findings, header.grid, at_grid_lat, at_grid_lon, angle_slack_deg);
    }
    check_undulation(findings, header);
    check_terrain(findings, header);
    findings.require(header.description_bytes <= longest_description, at_description, "description bytes",
                     header.description_bytes, "at most " + said(longest_description));
    return findings.first();
}

}  // namespace

std::optional<Implausible> implausible(const RegionHeader& header) {
    if (const auto wrong = implausible_given(header)) return wrong;
    Findings findings;
    findings.require(header.header_size == header_bytes, at_header_size, "header bytes",
                     static_cast<std::uint64_t>(header.header_size), said(std::uint64_t{header_bytes}));
    const std::uint64_t pages = PageOrder(header.grid).count();
    findings.require(header.pages == pages, at_pages, "pages", header.pages, said(pages));
    const std::uint64_t least = offsets_of(header).payloads;
    if (header.file_bytes != 0)
        findings.require(header.file_bytes >= least && header.file_bytes <= largest_file, at_file_bytes,
                         "file bytes", header.file_bytes, said(least) + " or more");
    return findings.first();
}

std::optional<Implausible> implausible(const RegionOutline& outline) {
    if (const auto wrong = implausible_given(header_of(outline, 0))) return wrong;
    return implausible(outline.undulation.N_m, header_bytes + outline.description.size());
}

std::optional<Implausible> implausible(std::span<const float> N_m, std::uint64_t offset) {
    Findings findings;
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
