#include "geo/tilesets/thing_levels.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/mesh_graph/mesh_graph.h"
#include "core/terrain/drawn_heights.h"
#include "geo/tilesets/mesh_things.h"
#include "geo/tilesets/outward_normals.h"
#include "geo/tilesets/space_box.h"
#include "geo/together/lattice_mesh.h"

namespace oro {
namespace {

// Coordinates of a tile have 24 bits with their sign.
constexpr double most_steps = 8.0e6;
// Half a step along three axes: sqrt(3) / 2, rounded up.
constexpr double rounding_of_step = 0.8661;
// Of the triangles of a depth that there are on the one above.
constexpr double share_of_below = 0.4;
// So much less is the error of a tile than that of its parent, at least.
constexpr double least_fall_m = 1.0e-4;

// No part has more triangles than wanted, or is wider. Nothing where they cannot be made so.
std::optional<NestedParts> small_parts(const LatticeMesh& mesh, const ThingLevelsRequest& request) {
    std::vector<glm::dvec3> middles;
    middles.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles)
        middles.push_back((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0);
    for (int depth = 0; (std::size_t{1} << 2 * depth) <= middles.size(); ++depth) {
        const std::size_t count = std::size_t{1} << 2 * depth;
        if ((middles.size() + count - 1) / count > request.part_triangles) continue;
        NestedParts parts = nested_parts(middles, depth);
        std::vector<SpaceBox> boxes(count);
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            for (const std::uint32_t corner : mesh.triangles[i])
                boxes[parts.part_of[i]].add(mesh.vertices[corner]);
        if (std::ranges::all_of(boxes,
                                [&](const SpaceBox& box) { return box.widest_m() <= request.widest_m; }))
            return parts;
    }
    return std::nullopt;
}

MeshGraph graph_in_parts(const LatticeMesh& mesh, const NestedParts& parts, int threads) {
    MeshGraphOptions options;
    options.threads = threads;
    options.parts = &parts;
    options.part_triangles = mesh.triangles.size() >> 2 * parts.depth;
    return build_mesh_graph(mesh.vertices, mesh.triangles, mesh.origin_m, options);
}

// The tiles of a thing, from those that have all triangles up to the root.
class ThingTiles {
  public:
    ThingTiles(const LatticeMesh& mesh, const NestedParts& parts, const ThingLevelsRequest& request);
    [[nodiscard]] std::vector<ThingTile> take();

  private:
    // Tiles of a depth stand behind those above it.
    [[nodiscard]] static std::size_t number_of(const NestedPart& part) {
        return ((std::size_t{1} << 2 * part.depth) - 1) / 3 + part.number;
    }
    void find_parts();
    void fill_smallest();
    void select(int depth);
    std::size_t select(std::uint32_t group, int depth);
    void fill(int depth);
    void choose_steps(int depth);
    void add_errors(int depth);

    const LatticeMesh& mesh_;
    const NestedParts& parts_;
    const ThingLevelsRequest& request_;
    MeshGraph graph_;
    std::vector<NestedPart> part_of_group_, part_of_cluster_;  // the smallest that has all below it
    std::vector<char> selected_;                               // of groups
    std::vector<std::size_t> count_;  // triangles of tiles, while groups are selected
    std::vector<ThingTile> tiles_;
};

ThingTiles::ThingTiles(const LatticeMesh& mesh, const NestedParts& parts, const ThingLevelsRequest& request)
    : mesh_(mesh), parts_(parts), request_(request), graph_(graph_in_parts(mesh, parts, request.threads)) {
    find_parts();
    for (int depth = 0; depth <= parts.depth; ++depth)
        for (std::uint32_t number = 0; number < std::uint32_t{1} << 2 * depth; ++number) {
            ThingTile& tile = tiles_.emplace_back();
            tile.depth = depth;
            for (std::uint32_t child = 0; depth < parts.depth && child < 4; ++child)
                tile.children.push_back(number_of({depth + 1, 4 * number + child}));
        }
}

std::vector<ThingTile> ThingTiles::take() {
    for (int depth = parts_.depth; depth >= 0; --depth) {
        if (depth == parts_.depth) {
            fill_smallest();
        } else {
            select(depth);
            fill(depth);
        }
        choose_steps(depth);
        add_errors(depth);
    }
    return std::move(tiles_);
}

// Groups and clusters come after those that they are made from.
void ThingTiles::find_parts() {
    const ClusterGraph& graph = graph_.clusters;
    selected_.assign(graph.groups.size(), 0);
    std::size_t next = 0;
    const auto add_clusters = [&](std::size_t end) {
        for (; next < end; ++next) {
            const Cluster& cluster = graph.clusters[next];
            if (cluster.made_by != no_group) {
                part_of_cluster_.push_back(part_of_group_[cluster.made_by]);
                continue;
            }
            NestedPart part = parts_.smallest(graph_.original_of[cluster.first_triangle]);
            for (std::uint32_t i = 1; i < cluster.triangles; ++i)
                part = common_part(part, parts_.smallest(graph_.original_of[cluster.first_triangle + i]));
            part_of_cluster_.push_back(part);
        }
    };
    for (const ClusterGroup& group : graph.groups) {
        const std::span<const std::uint32_t> members = graph.members_of(group);
        add_clusters(*std::ranges::max_element(members) + std::size_t{1});
        NestedPart part = part_of_cluster_[members.front()];
        for (const std::uint32_t member : members) part = common_part(part, part_of_cluster_[member]);
        part_of_group_.push_back(part);
    }
    add_clusters(graph.clusters.size());
}

void ThingTiles::fill_smallest() {
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i)
        tiles_[number_of(parts_.smallest(i))].triangles.push_back(mesh_.triangles[i]);
}

// Selects a group, and gives the triangles that the tile of its part then has.
std::size_t ThingTiles::select(std::uint32_t group, int depth) {
    const ClusterGraph& graph = graph_.clusters;
    const ClusterGroup& selected = graph.groups[group];
    const std::size_t number = number_of(part_of_group_[group].above(depth));
    std::size_t& count = count_[number];
    for (std::uint32_t k = 0; k < selected.made; ++k)
        count += graph.clusters[selected.first_made + k].triangles;
    for (const std::uint32_t member : graph.members_of(selected)) count -= graph.clusters[member].triangles;
    selected_[group] = 1;
    tiles_[number].error_m = std::max(tiles_[number].error_m, selected.error_m);
    return count;
}

// Selects groups within parts of a depth, those with the least errors first, until there are few triangles,
// and then in parts that have too many. A group comes after those below it, whose errors are no larger: so
// these are selected, too.
void ThingTiles::select(int depth) {
    std::vector<std::uint32_t> groups;
    for (std::uint32_t i = 0; i < part_of_group_.size(); ++i)
        if (part_of_group_[i].depth >= depth) groups.push_back(i);
    std::ranges::stable_sort(groups, {}, [&](std::uint32_t i) { return graph_.clusters.groups[i].error_m; });
    selected_.assign(selected_.size(), 0);
    count_.assign(tiles_.size(), 0);
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i)
        ++count_[number_of(parts_.smallest(i).above(depth))];
    std::size_t all = mesh_.triangles.size(), below = 0;
    for (const ThingTile& tile : tiles_)
        if (tile.depth == depth + 1) below += tile.triangles.size();
    const auto wanted = static_cast<std::size_t>(share_of_below * static_cast<double>(below));
    for (const std::uint32_t group : groups) {
        const std::size_t before = count_[number_of(part_of_group_[group].above(depth))];
        if (all > wanted || before > request_.most_triangles) all = all + select(group, depth) - before;
    }
}

// What is selected, in the tiles of a depth.
void ThingTiles::fill(int depth) {
    const ClusterGraph& graph = graph_.clusters;
    for (std::size_t i = 0; i < graph.clusters.size(); ++i) {
        const Cluster& cluster = graph.clusters[i];
        if (cluster.made_by != no_group && selected_[cluster.made_by] == 0) continue;
        if (cluster.used_by != no_group && selected_[cluster.used_by] != 0) continue;
        ThingTile& tile = tiles_[number_of(part_of_cluster_[i].above(depth))];
        for (const VertexTriangle& triangle : graph.triangles_of(cluster)) tile.triangles.push_back(triangle);
    }
    for (std::size_t i = number_of({depth, 0}); i < number_of({depth + 1, 0}); ++i) {
        ThingTile& tile = tiles_[i];
        const bool all_drawn = std::ranges::all_of(
            tile.children, [&](std::size_t child) { return !tiles_[child].triangles.empty(); });
        if (!all_drawn || tile.triangles.size() > request_.most_triangles) tile.triangles.clear();
    }
}

// Tiles of a depth have the same steps, so that they meet.
void ThingTiles::choose_steps(int depth) {
    const std::size_t first = number_of({depth, 0}), end = number_of({depth + 1, 0});
    double width_m = 0.0;
    for (std::size_t i = first; i < end; ++i) {
        SpaceBox box;
        for (const SourceTriangle& triangle : tiles_[i].triangles)
            for (const std::uint32_t corner : triangle) box.add(mesh_.vertices[corner]);
        width_m = std::max(width_m, box.widest_m());
    }
    double step_m = height_step_m;
    while (0.5 * width_m > most_steps * step_m) step_m *= 2.0;
    for (std::size_t i = first; i < end; ++i) tiles_[i].step_m = step_m;
}

void ThingTiles::add_errors(int depth) {
    SpaceBox whole;
    for (const glm::dvec3& place : mesh_.vertices) whole.add(place);
    for (std::size_t i = number_of({depth, 0}); i < number_of({depth + 1, 0}); ++i) {
        ThingTile& tile = tiles_[i];
        if (tile.triangles.empty()) tile.error_m = whole.diagonal_m();
        tile.error_m += most_rounding_m;
        if (tile.step_m > height_step_m) tile.error_m += rounding_of_step * tile.step_m;
        for (const std::size_t child : tile.children)
            tile.error_m = std::max(tile.error_m, tiles_[child].error_m + least_fall_m);
    }
}

// Of all tiles of a depth together, so that light does not change from tile to tile.
void add_level_normals(ThingLevels& levels, int depth, double crease_deg) {
    PlacedMesh all;
    all.crease_deg = crease_deg;
    all.vertices.resize(levels.places_m.size());
    for (const ThingTile& tile : levels.tiles)
        if (tile.depth == depth)
            all.triangles.insert(all.triangles.end(), tile.triangles.begin(), tile.triangles.end());
    const std::vector<std::array<glm::vec3, 3>> normals = outward_normals(all, levels.places_m);
    auto next = normals.begin();
    for (ThingTile& tile : levels.tiles) {
        if (tile.depth != depth) continue;
        const auto end = next + static_cast<std::ptrdiff_t>(tile.triangles.size());
        tile.normals.assign(next, end);
        next = end;
    }
}

}  // namespace

std::optional<ThingLevels> levels_of_thing(std::span<const glm::dvec3> places_m,
                                           std::span<const SourceTriangle> triangles,
                                           const ThingLevelsRequest& request) {
    const LatticeMesh mesh = lattice_mesh(places_m, triangles);
    const std::optional<NestedParts> parts = small_parts(mesh, request);
    if (!parts || parts->depth == 0) return std::nullopt;
    ThingLevels levels;
    levels.depth = parts->depth;
    levels.tiles = ThingTiles(mesh, *parts, request).take();
    levels.places_m.reserve(mesh.vertex_of.size());
    for (const std::uint32_t place : mesh.vertex_of) levels.places_m.push_back(places_m[place]);
    levels.place_of.assign(mesh.vertex_of.begin(), mesh.vertex_of.end());
    for (int depth = 0; request.normals && depth <= levels.depth; ++depth)
        add_level_normals(levels, depth, request.crease_deg);
    return levels;
}

}  // namespace oro
