#include "core/baked/contents_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/parallel.h"

namespace oro {
namespace {

// What the rounding of another machine's sines may make of a place, and of an angle.
constexpr double same_place_m = 1.0e-3, same_angle_rad = 1.0e-6, same_angle_deg = 1.0e-8;

// What the posts of level 0 have, all of them or those of a page.
struct PostsSeen {
    float lowest_m{std::numeric_limits<float>::max()};
    float highest_m{std::numeric_limits<float>::lowest()};
    std::uint64_t voids{}, triangles{};
    void add(const PostsSeen& other) {
        lowest_m = std::min(lowest_m, other.lowest_m);
        highest_m = std::max(highest_m, other.highest_m);
        voids += other.voids;
        triangles += other.triangles;
    }
};

std::string digits(double number) {
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", number);
    return text;
}
std::string digits(std::uint64_t number) {
    return std::to_string(number);
}

template <class Number>
std::string says(const std::string& what, Number said, Number found) {
    return "says " + what + " " + digits(said) + ", but its posts give " + digits(found);
}

// Takes the posts and quads of a page that the next pages do not have, too.
PostsSeen posts_of_page(const PagePayload& payload, const PostGrid& grid, const PageLayout& layout,
                        const PageIndex& page) {
    constexpr int quads = static_cast<int>(gpu::page_quads), stride = static_cast<int>(gpu::height_stride);
    const int quad_rows = std::min(quads, grid.rows() - 1 - page.row * quads),
              quad_columns = std::min(quads, grid.columns() - 1 - page.column * quads);
    const int rows = quad_rows + (page.row + 1 == layout.rows ? 1 : 0),
              columns = quad_columns + (page.column + 1 == layout.columns ? 1 : 0);
    const auto H_m = [&](int row, int column) {
        return payload.H_m[static_cast<std::size_t>((row + 1) * stride + column + 1)];
    };
    const auto there = [&](int row, int column) { return is_void(H_m(row, column)) ? 0U : 1U; };
    PostsSeen seen;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const float height_m = H_m(row, column);
            if (is_void(height_m)) {
                ++seen.voids;
                continue;
            }
            seen.lowest_m = std::min(seen.lowest_m, height_m);
            seen.highest_m = std::max(seen.highest_m, height_m);
        }
    }
    for (int row = 0; row < quad_rows; ++row)
        for (int column = 0; column < quad_columns; ++column)
            seen.triangles += there(row, column) * there(row + 1, column + 1) *
                              (there(row + 1, column) + there(row, column + 1));
    return seen;
}

// What a record says otherwise than its page; nothing where they agree.
std::optional<std::string> wrong_summary(const PageSummary& said, const PageSummary& found) {
    const auto differs = [](double a, double b, double same) { return !(std::abs(a - b) <= same); };
    if (said.triangles != found.triangles)
        return says<std::uint64_t>("triangles", said.triangles, found.triangles);
    if (said.meshlets != found.meshlets)
        return says<std::uint64_t>("meshlets", said.meshlets, found.meshlets);
    if (differs(said.lowest_h_m, found.lowest_h_m, same_place_m))
        return says("a lowest h in metres of", said.lowest_h_m, found.lowest_h_m);
    if (differs(said.highest_h_m, found.highest_h_m, same_place_m))
        return says("a highest h in metres of", said.highest_h_m, found.highest_h_m);
    if (differs(said.origin.lat_deg, found.origin.lat_deg, same_angle_deg))
        return says("a middle at latitude", said.origin.lat_deg, found.origin.lat_deg);
    if (differs(said.origin.lon_deg, found.origin.lon_deg, same_angle_deg))
        return says("a middle at longitude", said.origin.lon_deg, found.origin.lon_deg);
    const double moved_m = std::max({glm::distance(said.origin_ecef.m, found.origin_ecef.m),
                                     glm::distance(said.centre_m, found.centre_m),
                                     std::abs(said.origin.h_m - found.origin.h_m)});
    if (differs(moved_m, 0.0, same_place_m)) return says("a middle in metres off by", moved_m, 0.0);
    if (differs(said.radius_m, found.radius_m, same_place_m))
        return says("a radius in metres of", said.radius_m, found.radius_m);
    double turned = glm::distance(said.horizon.direction, found.horizon.direction);
    for (int column = 0; column < 3; ++column)
        turned = std::max(turned, glm::distance(said.ecef_from_page[column], found.ecef_from_page[column]));
    if (differs(turned, 0.0, same_angle_rad)) return says("directions off by", turned, 0.0);
    if (differs(said.horizon.angle_rad, found.horizon.angle_rad, same_angle_rad))
        return says("a cone in radians of", said.horizon.angle_rad, found.horizon.angle_rad);
    return std::nullopt;
}

// A record may say that nodes are worse than they are, and never that they are better: they would be drawn
// from too near.
std::optional<std::string> wrong_errors(const PageRecord& said, const PagePayload& payload) {
    constexpr std::size_t side = gpu::meshlets_per_side;
    std::array<float, 4> largest_m{};
    for (std::size_t node = 0; node < payload.error_m.size(); ++node) {
        float& largest = largest_m[node / side / (side / 2) * 2 + node % side / (side / 2)];
        largest = std::max(largest, payload.error_m[node]);
    }
    const float largest_of_all = *std::ranges::max_element(largest_m);
    if (said.summary.largest_error_m < largest_of_all)
        return says<double>("a largest error in metres of", said.summary.largest_error_m, largest_of_all);
    for (std::size_t quarter = 0; quarter < largest_m.size(); ++quarter)
        if (said.quarters[quarter].largest_error_m < largest_m[quarter])
            return says<double>("a largest error in metres of a quarter of",
                                said.quarters[quarter].largest_error_m, largest_m[quarter]);
    return std::nullopt;
}

class ContentsCheck {
  public:
    ContentsCheck(const RegionFile& file, std::string name) : file_(file), name_(std::move(name)) {}

    // What a page of level 0 has; nothing of others. Errors: its record says otherwise.
    Result<PostsSeen> page(std::uint64_t number) const {
        const RegionOutline& outline = file_.outline();
        const PageIndex index = file_.order().index(number);
        ORO_TRY(const PageRecord record, file_.record(index));
        const auto payload = std::make_unique<PagePayload>();
        ORO_CHECK(file_.payload(index, *payload));
        const auto elevations = std::make_unique<PageElevations>(PageElevations{payload->H_m});
        const auto heights = std::make_unique<PageHeights>(
            page_heights(outline.grid, outline.undulation, outline.shape.exaggeration, *elevations, index));
        const auto block = std::make_unique<gpu::PageBlock>();
        const PageSummary found =
            build_page(outline.grid, outline.shape, *heights, index, *block, MeshletBounding::spheres);
        auto wrong = wrong_summary(record.summary, found);
        if (!wrong) wrong = wrong_errors(record, *payload);
        if (wrong)
            return fault("the record of the page at level " + std::to_string(index.level) + " row " +
                         std::to_string(index.row) + " column " + std::to_string(index.column) + " " +
                         *wrong);
        if (index.level > 0) return PostsSeen{};
        return posts_of_page(*payload, outline.grid, file_.order().layout(0), index);
    }

    Result<void> outline(const PostsSeen& seen) const {
        const RegionOutline& said = file_.outline();
        const PostGrid& grid = said.grid;
        constexpr double near_pole_deg = 90.0 - 1.0e-9;
        if (grid.wraps_longitude() || grid.north_deg() > near_pole_deg || grid.south_deg() < -near_pole_deg)
            return {};
        const std::string outline = "its outline ";
        if (seen.voids != said.voids) return fault(outline + says("void posts", said.voids, seen.voids));
        if (seen.voids < grid.post_count() && seen.lowest_m != said.lowest_H_m)
            return fault(outline + says<double>("a lowest H in metres of", said.lowest_H_m, seen.lowest_m));
        if (seen.voids < grid.post_count() && seen.highest_m != said.highest_H_m)
            return fault(outline +
                         says<double>("a highest H in metres of", said.highest_H_m, seen.highest_m));
        if (seen.triangles != said.triangles)
            return fault(outline + says("triangles", said.triangles, seen.triangles));
        return {};
    }

  private:
    [[nodiscard]] Error fault(const std::string& what) const {
        return {ErrorKind::failed, file_.path(), name_ + what};
    }
    const RegionFile& file_;
    std::string name_;
};

}  // namespace

Result<void> check_contents(const RegionFile& file, int threads, const std::string& name) {
    constexpr std::uint64_t pages_at_a_time = 256;
    const ContentsCheck check(file, name);
    PostsSeen all;
    for (std::uint64_t first = 0; first < file.order().count(); first += pages_at_a_time) {
        const std::uint64_t count = std::min(pages_at_a_time, file.order().count() - first);
        std::vector<Result<PostsSeen>> pages(count, PostsSeen{});
        in_parallel(static_cast<int>(count), threads, [&](int i) {
            pages[static_cast<std::size_t>(i)] = check.page(first + static_cast<std::uint64_t>(i));
        });
        for (const Result<PostsSeen>& page : pages) {
            if (!page.ok()) return page.error();
            all.add(*page);
        }
    }
    return check.outline(all);
}

}  // namespace oro
