#include "geo/tilesets/mesh_tiles.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <map>
#include <mutex>
#include <system_error>
#include <tuple>
#include <utility>

#include "core/base/parallel.h"
#include "core/earth/ellipsoid.h"
#include "core/terrain/drawn_heights.h"
#include "geo/files/plain_file.h"
#include "geo/tilesets/mesh_things.h"
#include "geo/together/mesh_surface.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

// Half a step along three axes, and what doubles and the outlines of boxes add.
constexpr double rounding_m = 0.5e-3;
// Things of a tile lie so far from each other at most: float32 has whole steps up to 4,096 m.
constexpr double widest_tile_m = 4000.0;
// How far boxes reach beyond vertices: sides of 200 m bend by 1 mm.
constexpr double beyond_m = 0.01, beyond_deg = 2.0e-7;

// The meshes with their vertices in space.
struct MeshInSpace {
    const PlacedMesh* mesh{};
    std::vector<glm::dvec3> vertices_m;
    std::vector<std::array<glm::vec3, 3>> normals;  // ECEF; empty: none
};

// A tile before its content is made.
struct Node {
    std::vector<MeshThing> things;
    int depth{};
};

// Viewers turn the normals of a triangle that is seen from behind: its own are on the side that it is
// anticlockwise on.
std::vector<std::array<glm::vec3, 3>> outward_normals(const PlacedMesh& mesh,
                                                      std::span<const glm::dvec3> vertices_m) {
    std::vector<std::array<glm::vec3, 3>> normals = corner_normals(mesh, vertices_m);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        const glm::dvec3 out = glm::cross(vertices_m[b] - vertices_m[a], vertices_m[c] - vertices_m[a]);
        for (glm::vec3& normal : normals[i])
            if (glm::dot(glm::dvec3(normal), out) < 0.0) normal = -normal;
    }
    return normals;
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
    std::size_t add_tile(std::vector<MeshThing> things, int depth);
    [[nodiscard]] bool is_narrow(std::span<const MeshThing> things) const;
    [[nodiscard]] std::vector<std::vector<MeshThing>> quarters(std::vector<MeshThing> things) const;
    [[nodiscard]] GroundMesh mesh_of(const Node& node, VertexFacts& facts) const;
    [[nodiscard]] std::vector<GlbFeature> features_of(const Node& node,
                                                      std::vector<std::uint16_t>& rows) const;
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
        MeshInSpace one{&meshes[i], vertices_of_mesh(meshes[i], undulation), {}};
        if (request_.normals) one.normals = outward_normals(meshes[i], one.vertices_m);
        std::vector<MeshThing> things =
            things_of_mesh(meshes[i], i, one.vertices_m, request_.most_triangles / 4, widest_tile_m / 2.0);
        std::ranges::move(things, std::back_inserter(all_));
        meshes_.push_back(std::move(one));
    }
}

bool MeshTileWriter::is_narrow(std::span<const MeshThing> things) const {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const MeshThing& thing : things) {
        low = glm::min(low, thing.middle_m);
        high = glm::max(high, thing.middle_m);
    }
    // Pieces reach half their width beyond their middles.
    return glm::distance(low, high) <= widest_tile_m;
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

// The largest things are the tile's, as many as it may have; its error is the size of the next.
std::size_t MeshTileWriter::add_tile(std::vector<MeshThing> things, int depth) {
    std::ranges::stable_sort(things, std::greater<>(), &MeshThing::size_m);
    const std::size_t number = tiles_.size();
    tiles_.emplace_back();
    nodes_.push_back({{}, depth});
    std::size_t own = 0, triangles = 0;
    if (is_narrow(things))
        while (own < things.size() && (triangles += things[own].triangles.size()) <= request_.most_triangles)
            ++own;
    tiles_[number].error_m = rounding_m + (own < things.size() ? things[own].size_m : 0.0);
    std::vector<MeshThing> rest(std::make_move_iterator(things.begin() + static_cast<std::ptrdiff_t>(own)),
                                std::make_move_iterator(things.end()));
    things.resize(own);
    nodes_[number].things = std::move(things);
    if (rest.empty()) return number;
    for (std::vector<MeshThing>& part : quarters(std::move(rest))) {
        const std::size_t child = add_tile(std::move(part), depth + 1);
        tiles_[number].children.push_back(child);
    }
    return number;
}

void MeshTileWriter::divide() {
    if (all_.empty()) return;
    const Geodetic middle = geodetic_from_ecef({all_.front().middle_m});
    mesh_from_ecef_ = glm::transpose(ecef_from_enu(middle.lat_deg, middle.lon_deg));
    add_tile(std::move(all_), 0);
    fill_boxes();
}

// Children come after their parents.
void MeshTileWriter::fill_boxes() {
    constexpr double far = std::numeric_limits<double>::infinity(), turn_deg = 360.0;
    const double near_deg = meshes_.front().mesh->vertices.front().lon_deg;
    for (std::size_t number = tiles_.size(); number-- > 0;) {
        TileBox& box = tiles_[number].box;
        box = {far, far, -far, -far, far, -far};
        const auto widen = [&](const TileBox& by) {
            box = {std::min(box.west_deg, by.west_deg),     std::min(box.south_deg, by.south_deg),
                   std::max(box.east_deg, by.east_deg),     std::max(box.north_deg, by.north_deg),
                   std::min(box.lowest_h_m, by.lowest_h_m), std::max(box.highest_h_m, by.highest_h_m)};
        };
        for (const MeshThing& thing : nodes_[number].things)
            for (const std::uint32_t triangle : thing.triangles)
                for (const std::uint32_t corner : meshes_[thing.mesh].mesh->triangles[triangle]) {
                    const Geodetic at = geodetic_from_ecef({meshes_[thing.mesh].vertices_m[corner]});
                    const double lon_deg = near_deg + std::remainder(at.lon_deg - near_deg, turn_deg);
                    widen({lon_deg - beyond_deg, at.lat_deg - beyond_deg, lon_deg + beyond_deg,
                           at.lat_deg + beyond_deg, at.h_m - beyond_m, at.h_m + beyond_m});
                }
        for (const std::size_t child : tiles_[number].children) widen(tiles_[child].box);
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
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const MeshThing& thing : node.things) {
        low = glm::min(low, thing.middle_m);
        high = glm::max(high, thing.middle_m);
    }
    made.centre_m = 0.5 * (low + high);
    const Geodetic centre = geodetic_from_ecef({made.centre_m});
    made.ecef_from_mesh = ecef_from_enu(centre.lat_deg, centre.lon_deg);
    made.step_m = height_step_m;
    const glm::dmat3 to_mesh = glm::transpose(made.ecef_from_mesh);
    std::vector<std::uint16_t> rows = std::move(facts.features);
    facts.features.clear();
    using Key = std::tuple<int, int, int, int, int, int, std::uint16_t>;
    std::map<Key, std::uint32_t> known;
    for (std::size_t i = 0; i < node.things.size(); ++i) {
        const MeshThing& thing = node.things[i];
        const MeshInSpace& of = meshes_[thing.mesh];
        for (const std::uint32_t triangle : thing.triangles) {
            for (std::size_t j = 0; j < 3; ++j) {
                const glm::dvec3 at_m =
                    to_mesh * (of.vertices_m[of.mesh->triangles[triangle][j]] - made.centre_m);
                const glm::ivec3 at(glm::round(at_m / made.step_m));
                const glm::vec3 normal = of.normals.empty()
                                             ? glm::vec3(0.0F)
                                             : glm::vec3(to_mesh * glm::dvec3(of.normals[triangle][j]));
                constexpr float fineness = 127.0F;
                const glm::ivec3 rounded(glm::round(fineness * normal));
                const auto [vertex, is_new] =
                    known.try_emplace({at.x, at.y, at.z, rounded.x, rounded.y, rounded.z, rows[i]},
                                      static_cast<std::uint32_t>(made.positions.size()));
                made.indices.push_back(vertex->second);
                if (!is_new) continue;
                made.positions.push_back(at);
                if (!of.normals.empty())
                    made.normals.push_back(normal == glm::vec3(0.0F) ? glm::vec3(0.0F, 0.0F, 1.0F) : normal);
                facts.features.push_back(rows[i]);
            }
        }
    }
    made.ground_triangles = made.indices.size() / 3;
    return made;
}

Result<void> MeshTileWriter::write_tile(std::size_t number) {
    const Node& node = nodes_[number];
    MeshTile& tile = tiles_[number];
    if (node.things.empty()) return {};
    tile.name = "meshes/" + std::to_string(node.depth) + "/" + std::to_string(number) + ".glb";
    GlbLook look = request_.look;
    look.sources.clear();
    look.two_sided = true;
    VertexFacts facts;
    look.features = features_of(node, facts.features);
    const GroundMesh mesh = mesh_of(node, facts);
    const std::vector<std::uint8_t> bytes = glb_bytes(mesh, facts, look);
    tile.triangles = mesh.ground_triangles;
    tile.bytes = bytes.size();
    return write_plain_file(folder_ + "/" + tile.name, bytes);
}

Result<void> MeshTileWriter::write() {
    std::error_code failed;
    for (const Node& node : nodes_) {
        if (node.things.empty()) continue;
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
