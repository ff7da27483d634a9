#include "geo/tilesets/mesh_tiles.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <system_error>
#include <utility>

#include "core/base/parallel.h"
#include "core/earth/ellipsoid.h"
#include "core/terrain/drawn_heights.h"
#include "geo/files/plain_file.h"
#include "geo/meshes/triangle_looks.h"
#include "geo/tilesets/joined_corners.h"
#include "geo/tilesets/mesh_things.h"
#include "geo/tilesets/outward_normals.h"
#include "geo/tilesets/space_box.h"
#include "geo/tilesets/thing_levels.h"
#include "geo/tilesets/tile_boxes.h"
#include "geo/tilesets/triangle_box.h"
#include "geo/together/mesh_surface.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

// Things of a tile lie so far from each other at most: float32 has whole steps up to 4,096 m.
constexpr double widest_tile_m = 4000.0;

// The meshes with their vertices in space.
struct MeshInSpace {
    const PlacedMesh* mesh{};
    std::vector<glm::dvec3> vertices_m{};
    std::vector<std::array<glm::vec3, 3>> normals{};  // ECEF; empty: none
    std::vector<std::array<double, 3>> colours{};     // of each triangle
};

// A tile before its content is made.
struct Node {
    std::vector<MeshThing> things;
    int depth{};
    const ThingTile* level{};  // of its one thing; null: the things' own triangles are drawn

    [[nodiscard]] bool has_content() const {
        return level != nullptr ? !level->triangles.empty() : !things.empty();
    }
};

// What a tile has of a thing.
std::size_t triangles_of(const MeshThing& thing) {
    return thing.levels ? thing.levels->tiles.front().triangles.size() : thing.triangles.size();
}

// A triangle of a level, its corners where the tile's steps put them.
std::array<glm::dvec3, 3> rounded_corners_m(const ThingLevels& levels, const ThingTile& level,
                                            const SourceTriangle& triangle) {
    const auto at_m = [&](std::uint32_t corner) {
        return level.step_m * glm::round(levels.places_m[corner] / level.step_m);
    };
    return {at_m(triangle[0]), at_m(triangle[1]), at_m(triangle[2])};
}

class MeshTileWriter {
  public:
    MeshTileWriter(const std::string& folder, const MeshTilesRequest& request)
        : folder_(folder), request_(request) {}

    void read(std::span<const PlacedMesh> meshes, const UndulationField& undulation);
    // Divides all things among tiles.
    void divide();
    Result<void> write();
    std::vector<MeshTile> take() { return std::move(tiles_); }

  private:
    std::vector<std::size_t> add_tiles(std::vector<MeshThing> things, int depth);
    std::size_t add_levels(MeshThing thing, int depth);
    void add_child(std::size_t number, std::size_t child);
    [[nodiscard]] bool is_large(const MeshThing& thing) const {
        return thing.triangles.size() > request_.whole_triangles;
    }
    [[nodiscard]] std::vector<MeshThing> pieces_or_levels(std::span<const glm::dvec3> vertices_m,
                                                          std::span<const glm::dvec3> places_m,
                                                          MeshThing thing) const;
    [[nodiscard]] bool is_narrow(std::span<const MeshThing> things) const;
    [[nodiscard]] std::vector<std::vector<MeshThing>> quarters(std::vector<MeshThing> things) const;
    [[nodiscard]] GroundMesh mesh_of(const Node& node, VertexFacts& facts) const;
    [[nodiscard]] GroundMesh mesh_of_level(const Node& node, VertexFacts& facts) const;
    [[nodiscard]] std::vector<GlbFeature> features_of(const Node& node,
                                                      std::vector<std::uint16_t>& rows) const;
    [[nodiscard]] TileBox box_of_content(const Node& node, double near_deg) const;
    void fill_boxes();
    Result<void> write_tile(std::size_t number);

    const std::string& folder_;
    const MeshTilesRequest& request_;
    std::vector<MeshInSpace> meshes_;
    std::vector<MeshThing> all_;
    std::vector<MeshTile> tiles_;
    std::vector<Node> nodes_;  // of each tile
    glm::dmat3 mesh_from_ecef_{1.0};
};

void MeshTileWriter::read(std::span<const PlacedMesh> meshes, const UndulationField& undulation) {
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        meshes_.push_back({&meshes[i], vertices_of_mesh(meshes[i], undulation)});
        MeshInSpace& one = meshes_.back();
        one.colours = colours_of_triangles(meshes[i], one.vertices_m, request_.palette);
        if (request_.normals) one.normals = outward_normals(meshes[i], one.vertices_m);
        std::vector<MeshThing> things = things_of_mesh(meshes[i], i, one.vertices_m);
        const bool any_large =
            std::ranges::any_of(things, [&](const MeshThing& thing) { return is_large(thing); });
        const std::vector<glm::dvec3> places_m =
            any_large ? drawn_places_m(meshes[i], undulation, 1.0) : std::vector<glm::dvec3>();
        for (MeshThing& thing : things)
            std::ranges::move(pieces_or_levels(one.vertices_m, places_m, std::move(thing)),
                              std::back_inserter(all_));
    }
}

std::vector<MeshThing> MeshTileWriter::pieces_or_levels(std::span<const glm::dvec3> vertices_m,
                                                        std::span<const glm::dvec3> places_m,
                                                        MeshThing thing) const {
    const PlacedMesh& mesh = *meshes_[thing.mesh].mesh;
    if (is_large(thing)) {
        std::vector<SourceTriangle> triangles;
        for (const std::uint32_t triangle : thing.triangles) triangles.push_back(mesh.triangles[triangle]);
        std::optional<ThingLevels> levels =
            levels_of_thing(places_m, triangles,
                            {request_.most_triangles, request_.whole_triangles, widest_tile_m,
                             request_.normals, request_.threads, mesh.crease_deg});
        if (levels) {
            thing.levels = std::make_shared<const ThingLevels>(std::move(*levels));
            thing.look = TriangleLooks(mesh).of(thing.triangles.front());
            thing.triangles.clear();
            return {std::move(thing)};
        }
    }
    return pieces_of_thing(mesh, vertices_m, std::move(thing), request_.most_triangles / 4,
                           widest_tile_m / 2.0);
}

bool MeshTileWriter::is_narrow(std::span<const MeshThing> things) const {
    SpaceBox middles;
    for (const MeshThing& thing : things) middles.add(thing.middle_m);
    // Pieces reach half their width beyond their middles.
    return middles.diagonal_m() <= widest_tile_m;
}

// By the middles, west to east and south to north as seen from the first tile's centre.
std::vector<std::vector<MeshThing>> MeshTileWriter::quarters(std::vector<MeshThing> things) const {
    const auto halves = [&](std::vector<MeshThing> from, int axis) {
        std::ranges::stable_sort(
            from, {}, [&](const MeshThing& thing) { return (mesh_from_ecef_ * thing.middle_m)[axis]; });
        const auto half = static_cast<std::ptrdiff_t>((from.size() + 1) / 2);
        std::vector<MeshThing> second(std::make_move_iterator(from.begin() + half),
                                      std::make_move_iterator(from.end()));
        from.resize(static_cast<std::size_t>(half));
        return std::pair(std::move(from), std::move(second));
    };
    auto [west, east] = halves(std::move(things), 0);
    std::vector<std::vector<MeshThing>> parts;
    for (std::vector<MeshThing>* side : {&west, &east}) {
        auto [south, north] = halves(std::move(*side), 1);
        parts.push_back(std::move(south));
        parts.push_back(std::move(north));
    }
    std::erase_if(parts, [](const auto& part) { return part.empty(); });
    return parts;
}

void MeshTileWriter::add_child(std::size_t number, std::size_t child) {
    tiles_[number].children.push_back(child);
    tiles_[number].error_m = std::max(tiles_[number].error_m, tiles_[child].error_m);
}

// The largest things are the tile's, as many as it may have; its error is the size of the next. Those with
// levels have tiles of their own beside it. Gives all of them.
std::vector<std::size_t> MeshTileWriter::add_tiles(std::vector<MeshThing> things, int depth) {
    std::ranges::stable_sort(things, std::greater<>(), &MeshThing::size_m);
    std::size_t own = 0, triangles = 0;
    if (is_narrow(things))
        while (own < things.size() && (triangles += triangles_of(things[own])) <= request_.most_triangles)
            ++own;
    const auto first_of_rest = things.begin() + static_cast<std::ptrdiff_t>(own);
    std::vector<MeshThing> rest(std::make_move_iterator(first_of_rest),
                                std::make_move_iterator(things.end()));
    things.erase(first_of_rest, things.end());
    std::vector<MeshThing> with_levels;
    for (MeshThing& thing : things)
        if (thing.levels) with_levels.push_back(std::move(thing));
    std::erase_if(things, [](const MeshThing& thing) { return thing.triangles.empty(); });
    std::vector<std::size_t> added;
    if (!things.empty() || !rest.empty()) {
        const std::size_t number = tiles_.size();
        added.push_back(number);
        tiles_.emplace_back().error_m = most_rounding_m + (rest.empty() ? 0.0 : rest.front().size_m);
        nodes_.push_back({std::move(things), depth});
        if (!rest.empty())
            for (std::vector<MeshThing>& part : quarters(std::move(rest)))
                for (const std::size_t child : add_tiles(std::move(part), depth + 1))
                    add_child(number, child);
    }
    for (MeshThing& thing : with_levels) added.push_back(add_levels(std::move(thing), depth));
    return added;
}

// Gives the root of the thing's tiles.
std::size_t MeshTileWriter::add_levels(MeshThing thing, int depth) {
    const std::size_t first = tiles_.size();
    const ThingLevels& levels = *thing.levels;
    for (const ThingTile& level : levels.tiles) {
        MeshTile& tile = tiles_.emplace_back();
        tile.error_m = level.error_m;
        tile.level = levels.depth - level.depth;
        for (const std::size_t child : level.children) tile.children.push_back(first + child);
        nodes_.push_back({{thing}, depth + level.depth, &level});
    }
    return first;
}

// Where things have levels the root has nothing but children.
void MeshTileWriter::divide() {
    if (all_.empty()) return;
    const Geodetic middle = geodetic_from_ecef({all_.front().middle_m});
    mesh_from_ecef_ = glm::transpose(ecef_from_enu(middle.lat_deg, middle.lon_deg));
    if (std::ranges::any_of(all_, [](const MeshThing& thing) { return thing.levels != nullptr; })) {
        tiles_.emplace_back().error_m =
            most_rounding_m + std::ranges::max(all_, {}, &MeshThing::size_m).size_m;
        nodes_.emplace_back();
        for (const std::size_t child : add_tiles(std::move(all_), 1)) add_child(0, child);
    } else {
        add_tiles(std::move(all_), 0);
    }
    fill_boxes();
}

// near_deg: a longitude, from which those of the box are no more than half a turn away.
TileBox MeshTileWriter::box_of_content(const Node& node, double near_deg) const {
    TriangleBox box(near_deg);
    const auto add = [&](const std::array<glm::dvec3, 3>& corners_m) {
        for (const glm::dvec3& corner_m : corners_m) box.add_corner(corner_m);
        box.add_triangle(corners_m);
    };
    if (node.level != nullptr) {
        for (const SourceTriangle& triangle : node.level->triangles)
            add(rounded_corners_m(*node.things.front().levels, *node.level, triangle));
        return box.box();
    }
    for (const MeshThing& thing : node.things) {
        const MeshInSpace& of = meshes_[thing.mesh];
        for (const std::uint32_t triangle : thing.triangles) {
            const auto& [a, b, c] = of.mesh->triangles[triangle];
            add({of.vertices_m[a], of.vertices_m[b], of.vertices_m[c]});
        }
    }
    return box.box();
}

// Children come after their parents.
void MeshTileWriter::fill_boxes() {
    const double near_deg = meshes_.front().mesh->vertices.front().lon_deg;
    std::vector<std::optional<TileBox>> boxes(tiles_.size());
    for (std::size_t number = tiles_.size(); number-- > 0;) {
        std::optional<TileBox>& box = boxes[number];
        if (nodes_[number].has_content()) box = box_of_content(nodes_[number], near_deg);
        for (const std::size_t child : tiles_[number].children)
            if (boxes[child]) box = box ? joined(*box, *boxes[child]) : *boxes[child];
        if (box) tiles_[number].box = *box;
    }
}

// rows: of each thing of the node.
std::vector<GlbFeature> MeshTileWriter::features_of(const Node& node,
                                                    std::vector<std::uint16_t>& rows) const {
    std::vector<GlbFeature> features;
    std::map<std::pair<std::size_t, std::int64_t>, std::uint16_t> known;
    for (const MeshThing& thing : node.things) {
        const PlacedMesh& mesh = *meshes_[thing.mesh].mesh;
        const std::int64_t number = thing.feature ? std::int64_t{*thing.feature} : -1;
        const auto [at, is_new] =
            known.try_emplace({thing.mesh, number}, static_cast<std::uint16_t>(features.size()));
        rows.push_back(at->second);
        if (!is_new) continue;
        GlbFeature feature;
        feature.file = fs::path(mesh.path).filename().string();
        if (thing.feature) {
            const MeshFeature& of = mesh.features[*thing.feature];
            feature.name = of.name;
            feature.type = of.type;
            feature.part_of = of.part_of;
            feature.attributes = of.attributes;
        }
        features.push_back(std::move(feature));
    }
    return features;
}

GroundMesh MeshTileWriter::mesh_of(const Node& node, VertexFacts& facts) const {
    GroundMesh made;
    SpaceBox middles;
    for (const MeshThing& thing : node.things) middles.add(thing.middle_m);
    made.centre_m = middles.middle_m();
    const Geodetic centre = geodetic_from_ecef({made.centre_m});
    made.ecef_from_mesh = ecef_from_enu(centre.lat_deg, centre.lon_deg);
    made.step_m = height_step_m;
    const glm::dmat3 to_mesh = glm::transpose(made.ecef_from_mesh);
    const std::vector<std::uint16_t> rows = std::exchange(facts.features, {});
    JoinedCorners corners(made, facts, request_.normals);
    for (std::size_t i = 0; i < node.things.size(); ++i) {
        const MeshThing& thing = node.things[i];
        const MeshInSpace& of = meshes_[thing.mesh];
        for (const std::uint32_t triangle : thing.triangles)
            for (std::size_t j = 0; j < 3; ++j) {
                const glm::dvec3 at_m =
                    to_mesh * (of.vertices_m[of.mesh->triangles[triangle][j]] - made.centre_m);
                const glm::vec3 normal = of.normals.empty()
                                             ? glm::vec3(0.0F)
                                             : glm::vec3(to_mesh * glm::dvec3(of.normals[triangle][j]));
                corners.add(glm::ivec3(glm::round(at_m / made.step_m)), normal, rows[i],
                            colour_of_corner(*of.mesh, triangle, j, of.colours[triangle]));
            }
    }
    return made;
}

// The centre lies on the lattice, and the axes are its own: so a vertex of several tiles is at one place.
GroundMesh MeshTileWriter::mesh_of_level(const Node& node, VertexFacts& facts) const {
    const ThingTile& level = *node.level;
    const MeshThing& thing = node.things.front();
    const PlacedMesh& of = *meshes_[thing.mesh].mesh;
    const std::vector<glm::dvec3>& places_m = thing.levels->places_m;
    SpaceBox box;
    for (const SourceTriangle& triangle : level.triangles)
        for (const std::uint32_t corner : triangle) box.add(places_m[corner]);
    GroundMesh made;
    made.step_m = level.step_m;
    const glm::dvec3 centre = glm::round(box.middle_m() / made.step_m);
    made.centre_m = made.step_m * centre;
    facts.features.clear();
    JoinedCorners corners(made, facts, !level.normals.empty());
    for (std::size_t i = 0; i < level.triangles.size(); ++i) {
        const auto corners_m = rounded_corners_m(*node.things.front().levels, level, level.triangles[i]);
        const std::array<double, 3> colour =
            colour_of_triangle(node.things.front().look, corners_m, request_.palette);
        const auto colour_at = [&](std::uint32_t corner) {
            const std::uint32_t vertex = thing.levels->place_of[corner];
            const bool is_stated = vertex < of.colours.size() && of.colours[vertex].is_stated != 0;
            return is_stated ? light_of_colour(of.colours[vertex]) : colour;
        };
        for (std::size_t j = 0; j < 3; ++j)
            corners.add(glm::ivec3(glm::round(corners_m[j] / made.step_m) - centre),
                        level.normals.empty() ? glm::vec3(0.0F) : level.normals[i][j], 0,
                        colour_at(level.triangles[i][j]));
    }
    return made;
}

Result<void> MeshTileWriter::write_tile(std::size_t number) {
    const Node& node = nodes_[number];
    MeshTile& tile = tiles_[number];
    if (!node.has_content()) return {};
    tile.name = "meshes/" + std::to_string(node.depth) + "/" + std::to_string(number) + ".glb";
    GlbLook look = request_.look;
    look.sources.clear();
    look.two_sided = true;
    VertexFacts facts;
    look.features = features_of(node, facts.features);
    const GroundMesh mesh = node.level != nullptr ? mesh_of_level(node, facts) : mesh_of(node, facts);
    const std::vector<std::uint8_t> bytes = glb_bytes(mesh, facts, look);
    tile.triangles = mesh.ground_triangles;
    tile.bytes = bytes.size();
    return write_plain_file(folder_ + "/" + tile.name, bytes);
}

Result<void> MeshTileWriter::write() {
    std::error_code failed;
    for (const Node& node : nodes_) {
        if (!node.has_content()) continue;
        const std::string path = folder_ + "/meshes/" + std::to_string(node.depth);
        if (fs::create_directories(path, failed); failed)
            return Error{ErrorKind::failed, path, "cannot be made: " + failed.message()};
    }
    std::mutex mutex;
    Result<void> fault;
    in_parallel(static_cast<int>(tiles_.size()), request_.threads, [&](int i) {
        const Result<void> one = write_tile(static_cast<std::size_t>(i));
        const std::scoped_lock lock(mutex);
        if (!one.ok() && fault.ok()) fault = one;
    });
    return fault;
}

}  // namespace

Result<std::vector<MeshTile>> write_mesh_tiles(const std::string& folder, std::span<const PlacedMesh> meshes,
                                               const UndulationField& undulation,
                                               const MeshTilesRequest& request) {
    MeshTileWriter writer(folder, request);
    writer.read(meshes, undulation);
    writer.divide();
    ORO_CHECK(writer.write());
    return writer.take();
}

}  // namespace oro
