#include "geo/together/cut_regions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "core/terrain/drawn_heights.h"
#include "geo/together/mesh_surface.h"

namespace oro {
namespace {

// Posts of one grid as they are drawn; each is placed once.
class DrawnPosts {
  public:
    DrawnPosts(const HeightField& field, const GridClip& cut, double exaggeration)
        : field_(field), cut_(cut), exaggeration_(exaggeration) {}

    // The normal is that of the smooth ground: from the posts around, on the sides where there are any. Of
    // what is cut out there are none, as for the pages beside it: the light is the same on both sides of an
    // edge.
    const SeamCorner& at(GridPost post) {
        const auto [found, is_new] = drawn_.try_emplace(number(post));
        if (is_new) {
            found->second.at.m = place(post);
            found->second.h_m = drawn_h_m(field_, post.row, post.column, exaggeration_);
            found->second.normal = normal(post, found->second.at.m);
        }
        return found->second;
    }

  private:
    [[nodiscard]] std::size_t number(GridPost post) const {
        return static_cast<std::size_t>(post.row) * static_cast<std::size_t>(field_.grid.columns()) +
               static_cast<std::size_t>(post.column);
    }
    [[nodiscard]] glm::dvec3 place(GridPost post) const {
        return post_ecef(field_, post.row, post.column, exaggeration_).m;
    }
    [[nodiscard]] glm::dvec3 normal(GridPost post, const glm::dvec3& here) const {
        const bool stays = !is_masked(post);
        const auto place_or_here = [&](int down, int right) {
            const GridPost neighbour{post.row + down, post.column + right};
            return is_there(neighbour) && !(stays && is_masked(neighbour)) ? place(neighbour) : here;
        };
        const glm::dvec3 up = glm::normalize(here);
        const glm::dvec3 down_row = place_or_here(1, 0) - place_or_here(-1, 0),
                         along_row = place_or_here(0, 1) - place_or_here(0, -1);
        const glm::dvec3 normal = glm::cross(down_row, along_row);
        const double length = glm::length(normal);
        return length > 0.0 && glm::dot(normal, up) > 0.0 ? normal / length : up;
    }
    [[nodiscard]] bool is_there(GridPost post) const {
        return post.row >= 0 && post.column >= 0 && post.row < field_.grid.rows() &&
               post.column < field_.grid.columns() && !is_void(field_.H_at_post_m(post.row, post.column));
    }
    [[nodiscard]] bool is_masked(GridPost post) const {
        return !cut_.masked_posts.empty() && cut_.masked_posts[number(post)] != 0;
    }
    const HeightField& field_;
    const GridClip& cut_;
    double exaggeration_;
    std::unordered_map<std::size_t, SeamCorner> drawn_;
};

// The ground that `one` bounds lies on the right hand; the skirt's foot goes to the left.
SeamSkirt skirt_between(const std::array<SeamCorner, 2>& one, const std::array<SeamCorner, 2>& other) {
    SeamSkirt skirt;
    for (std::size_t end = 0; end < 2; ++end) {
        const bool higher = one[end].h_m >= other[end].h_m;
        skirt.top[end] = higher ? one[end] : other[end];
        skirt.foot[end] = higher ? other[end] : one[end];
    }
    const glm::dvec3 along = one[1].at.m - one[0].at.m;
    skirt.up = glm::normalize(one[0].at.m / glm::dvec3(1.0, 1.0, 1.0 - wgs84_e2));
    const glm::dvec3 left = glm::cross(skirt.up, along);
    skirt.side = glm::length(left) > 0.0 ? glm::normalize(left) : glm::dvec3(0.0);
    return skirt;
}

// The corners of one grid's cut as they are drawn.
class SeamBuilder {
  public:
    SeamBuilder(const std::vector<RegionGrid>& grids, const RegionCuts& cuts, std::size_t one,
                double exaggeration)
        : cut_(cuts.grids[one]) {
        posts_.emplace_back(grids[one].field, cut_, exaggeration);
        for (std::size_t i = 0; i < grids.size(); ++i)
            if (grids[i].rank < grids[one].rank)
                posts_.emplace_back(grids[i].field, cuts.grids[i], exaggeration);
    }
    void add(Seam& seam);

  private:
    SeamCorner corner(const SeamPoint& point);
    // Where two points of the cut grid are the same.
    using Key = std::pair<std::int64_t, std::int64_t>;
    static Key key(const SeamPoint& point);
    void close_outer_sides(Seam& seam);

    const GridClip& cut_;
    std::vector<DrawnPosts> posts_;
};

SeamCorner SeamBuilder::corner(const SeamPoint& point) {
    DrawnPosts& grid = posts_[point.grid];
    SeamCorner corner;
    for (std::size_t i = 0; i < 3; ++i) {
        if (point.shares[i] == 0.0) continue;
        const SeamCorner& post = grid.at(point.posts[i]);
        corner.at.m += point.shares[i] * post.at.m;
        corner.h_m += point.shares[i] * post.h_m;
        corner.normal += point.shares[i] * post.normal;
    }
    corner.normal = glm::normalize(corner.normal);
    return corner;
}

SeamBuilder::Key SeamBuilder::key(const SeamPoint& point) {
    double row = 0.0, column = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        row += point.shares[i] * point.posts[i].row;
        column += point.shares[i] * point.posts[i].column;
    }
    constexpr double steps = 0.2 / seam_slack_posts;
    return {std::llround(row * steps), std::llround(column * steps)};
}

// Sides of pieces that neither another piece nor a wall shares: there the grid's own triangles go on, as
// placed by another program.
void SeamBuilder::close_outer_sides(Seam& seam) {
    std::map<std::pair<Key, Key>, int> shared;
    for (const SeamTriangle& piece : cut_.ground)
        for (std::size_t i = 0; i < 3; ++i) ++shared[{key(piece.points[i]), key(piece.points[(i + 1) % 3])}];
    for (const SeamWall& wall : cut_.walls) {
        ++shared[{key(wall.cut[0]), key(wall.cut[1])}];
        ++shared[{key(wall.cut[1]), key(wall.cut[0])}];
    }
    for (const SeamTriangle& piece : cut_.ground) {
        for (std::size_t i = 0; i < 3; ++i) {
            const SeamPoint &from = piece.points[i], &to = piece.points[(i + 1) % 3];
            if (shared.contains({key(to), key(from)})) continue;
            // Anticlockwise: the piece lies on the left hand.
            const std::array<SeamCorner, 2> side{corner(to), corner(from)};
            seam.skirts.push_back(skirt_between(side, side));
        }
    }
}

void SeamBuilder::add(Seam& seam) {
    for (const SeamTriangle& piece : cut_.ground)
        seam.pieces.push_back({{corner(piece.points[0]), corner(piece.points[1]), corner(piece.points[2])}});
    for (const SeamWall& wall : cut_.walls)
        seam.skirts.push_back(skirt_between({corner(wall.cut[0]), corner(wall.cut[1])},
                                            {corner(wall.over[0]), corner(wall.over[1])}));
    close_outer_sides(seam);
}

// What joins grids, and what closes its sides to them.
void add_bridges(const std::vector<RegionGrid>& grids, const RegionCuts& cuts, double exaggeration,
                 Seam& seam) {
    std::vector<DrawnPosts> posts;
    for (std::size_t i = 0; i < grids.size(); ++i)
        posts.emplace_back(grids[i].field, cuts.grids[i], exaggeration);
    const auto corner = [&](const BridgePost& post) { return posts[post.grid].at(post.post); };
    using Key = std::tuple<std::size_t, int, int>;
    const auto key = [](const BridgePost& post) { return Key{post.grid, post.post.row, post.post.column}; };
    std::set<std::pair<Key, Key>> sides;
    for (const GapBridge& bridge : cuts.bridges)
        for (std::size_t i = 0; i < 3; ++i)
            sides.insert({key(bridge.posts[i]), key(bridge.posts[(i + 1) % 3])});
    for (const GapBridge& bridge : cuts.bridges) {
        seam.pieces.push_back({{corner(bridge.posts[0]), corner(bridge.posts[1]), corner(bridge.posts[2])}});
        for (std::size_t i = 0; i < 3; ++i) {
            const BridgePost &from = bridge.posts[i], &to = bridge.posts[(i + 1) % 3];
            if (sides.contains({key(to), key(from)})) continue;
            const std::array<SeamCorner, 2> side{corner(to), corner(from)};
            seam.skirts.push_back(skirt_between(side, side));
        }
    }
}

}  // namespace

std::vector<const RegionGrid*> finer_than(const Region& region, const RegionGrid& one) {
    std::vector<const RegionGrid*> finer;
    for (const RegionGrid& other : region.grids)
        if (other.rank < one.rank) finer.push_back(&other);
    return finer;
}

Result<GridClip> cut_of(const Region& region, const RegionGrid& one) {
    std::vector<const HeightField*> finer;
    for (const RegionGrid* other : finer_than(region, one)) finer.push_back(&other->field);
    if (finer.empty()) return GridClip{};
    return clip_by_finer(one.field, finer);
}

Result<RegionCuts> cut_regions(const Region& region) {
    RegionCuts cuts;
    for (const RegionGrid& one : region.grids) {
        ORO_TRY(GridClip cut, cut_of(region, one));
        cuts.grids.push_back(std::move(cut));
    }
    ORO_TRY(cuts.bridges, gap_bridges(region));
    return cuts;
}

Seam seam_between(const Region& region, const RegionCuts& cuts, double exaggeration,
                  const std::vector<PlacedMesh>* meshes) {
    Seam seam;
    for (std::size_t i = 0; i < region.grids.size(); ++i)
        SeamBuilder(region.grids, cuts, i, exaggeration).add(seam);
    add_bridges(region.grids, cuts, exaggeration, seam);
    if (meshes == nullptr) meshes = region.meshes.get();
    if (meshes != nullptr)
        for (const PlacedMesh& mesh : *meshes)
            add_mesh(mesh, region.grids.front().field.undulation, exaggeration, seam);
    return seam;
}

}  // namespace oro
