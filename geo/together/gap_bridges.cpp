#include "geo/together/cut_regions.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "geo/together/face_cut.h"

namespace oro {
namespace {

struct RimPost {
    BridgePost post;
    glm::dvec3 normal;  // of the ellipsoid there
};

double spacing_rad(const PostGrid& grid) {
    return std::max(grid.row_step_rad(), grid.column_step_rad());
}

// Whether a place is in a grid's box, or no more than so many of its posts beyond it.
bool is_near(const PostGrid& grid, const PostPlace& place, double posts) {
    PostNumber at = grid.post_at(place.lat_deg, place.lon_deg);
    if (!grid.net) {
        // West of it, not a whole turn east.
        const double turn = 360.0 * grid.lon.posts_per_deg, middle = 0.5 * (grid.columns() - 1);
        at.column -= turn * std::round((at.column - middle) / turn);
    }
    return at.row >= -posts && at.column >= -posts && at.row <= grid.rows() - 1 + posts &&
           at.column <= grid.columns() - 1 + posts;
}

// Whether two grids may lie so near each other: by their middles, and how far they reach from there.
bool may_meet(const PostGrid& one, const PostGrid& other, double gap_rad) {
    const auto middle = [](const PostGrid& grid) {
        const PostPlace place = grid.place_at(0.5 * (grid.rows() - 1), 0.5 * (grid.columns() - 1));
        return ecef_from_enu(place.lat_deg, place.lon_deg)[2];
    };
    const auto reach_rad = [](const PostGrid& grid) {
        return 0.55 * std::hypot((grid.rows() - 1) * grid.row_step_rad(),
                                 (grid.columns() - 1) * grid.column_step_rad());
    };
    const double apart_rad = std::acos(std::clamp(glm::dot(middle(one), middle(other)), -1.0, 1.0));
    return apart_rad <= reach_rad(one) + reach_rad(other) + gap_rad;
}

// Posts on the rim of one grid that may lie beside another.
std::vector<RimPost> rim_near(const std::vector<RimEdge>& rim, const PostGrid& grid, std::size_t number,
                              const PostGrid& other, double widest_rad) {
    std::vector<RimPost> posts;
    std::set<std::pair<int, int>> taken;
    const double margin = 2.0 + widest_rad / std::min(other.row_step_rad(), other.column_step_rad());
    for (const RimEdge& edge : rim) {
        for (const GridPost& post : {edge.from, edge.to}) {
            if (!taken.insert({post.row, post.column}).second) continue;
            const PostPlace place = grid.place_at(post.row, post.column);
            if (is_near(other, place, margin))
                posts.push_back({{number, post}, ecef_from_enu(place.lat_deg, place.lon_deg)[2]});
        }
    }
    return posts;
}

bool has_ground(const std::vector<RegionGrid>& grids, const glm::dvec3& normal) {
    const PostPlace place = place_of_normal(normal);
    return std::ranges::any_of(grids, [&](const RegionGrid& grid) {
        return grid.field.surface_H_m(place.lat_deg, place.lon_deg).has_value();
    });
}

// The triangles between two rims, of those that GEOS makes of their posts: corners of both, sides from one to
// the other no longer than a gap may be wide, and no ground below.
Result<void> join(const std::vector<RegionGrid>& grids, const std::vector<RimPost>& posts, double widest_rad,
                  std::vector<GapBridge>& bridges) {
    if (posts.size() < 3) return {};
    glm::dvec3 middle(0.0);
    for (const RimPost& post : posts) middle += post.normal;
    middle = glm::normalize(middle);
    const PostPlace at = place_of_normal(middle);
    const glm::dmat3 axes = ecef_from_enu(at.lat_deg, at.lon_deg);
    std::vector<glm::dvec2> plane;
    for (const RimPost& post : posts) {
        const double up = glm::dot(post.normal, axes[2]);
        if (!(up > 0.1)) return {};  // around the Earth: rims that far apart are those of no gap
        plane.emplace_back(glm::dot(post.normal, axes[0]) / up, glm::dot(post.normal, axes[1]) / up);
    }
    ORO_TRY(const auto triangles, triangles_between(plane));
    for (const auto& triangle : triangles) {
        const std::array<const RimPost*, 3> corners{&posts[triangle[0]], &posts[triangle[1]],
                                                    &posts[triangle[2]]};
        double longest = 0.0;
        bool both = false;
        for (std::size_t i = 0; i < 3; ++i) {
            const RimPost &one = *corners[i], &next = *corners[(i + 1) % 3];
            longest = std::max(longest, glm::length(one.normal - next.normal));
            both = both || one.post.grid != next.post.grid;
        }
        const glm::dvec2 a = plane[triangle[1]] - plane[triangle[0]],
                         b = plane[triangle[2]] - plane[triangle[0]];
        const double doubled = a.x * b.y - a.y * b.x;
        constexpr double least_share = 1.0e-6;  // of a square as wide as its longest side
        if (!both || longest > widest_rad || std::abs(doubled) < least_share * longest * longest) continue;
        if (has_ground(grids, corners[0]->normal + corners[1]->normal + corners[2]->normal)) continue;
        GapBridge bridge{{corners[0]->post, corners[1]->post, corners[2]->post}};
        if (doubled < 0.0) std::swap(bridge.posts[1], bridge.posts[2]);
        bridges.push_back(bridge);
    }
    return {};
}

}  // namespace

Result<std::vector<GapBridge>> gap_bridges(const Region& region) {
    std::vector<GapBridge> bridges;
    const std::vector<RegionGrid>& grids = region.grids;
    std::vector<std::optional<std::vector<RimEdge>>> rims(grids.size());
    const auto rim_of = [&](std::size_t number) -> const std::vector<RimEdge>& {
        if (!rims[number]) rims[number] = coverage_rim(grids[number].field);
        return *rims[number];
    };
    for (std::size_t i = 0; i < grids.size(); ++i) {
        for (std::size_t j = i + 1; j < grids.size(); ++j) {
            const PostGrid &one = grids[i].field.grid, &other = grids[j].field.grid;
            // Across a cell, with its diagonal.
            const double widest_rad =
                std::hypot(widest_gap_posts, 1.0) * std::max(spacing_rad(one), spacing_rad(other));
            if (!may_meet(one, other, widest_rad)) continue;
            std::vector<RimPost> posts = rim_near(rim_of(i), one, i, other, widest_rad);
            if (posts.empty()) continue;
            const std::vector<RimPost> others = rim_near(rim_of(j), other, j, one, widest_rad);
            if (others.empty()) continue;
            posts.insert(posts.end(), others.begin(), others.end());
            ORO_CHECK(join(grids, posts, widest_rad, bridges));
        }
    }
    return bridges;
}

}  // namespace oro
