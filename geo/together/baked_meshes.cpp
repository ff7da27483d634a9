#include "geo/together/baked_meshes.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <new>
#include <utility>

#include "core/base/checksum.h"
#include "core/base/compressed_bytes.h"
#include "core/base/elapsed.h"
#include "core/base/parallel.h"
#include "core/base/scratch_memory.h"
#include "core/mesh_file/mesh_bytes.h"
#include "core/mesh_file/stored_mesh.h"
#include "core/mesh_graph/mesh_graph.h"
#include "core/terrain/page_on_net.h"
#include "geo/files/whole_file.h"
#include "geo/meshes/mesh_facts.h"
#include "geo/together/graph_memory.h"
#include "geo/together/lattice_mesh.h"
#include "geo/together/mesh_ground.h"
#include "geo/together/mesh_surface.h"

namespace oro {
namespace {

// Of features with their attributes, before they are pressed.
constexpr std::size_t most_fact_bytes = std::size_t{1} << 30U;
constexpr std::uint64_t most_triangle_bytes = std::uint64_t{64} * most_stored_triangles;

Result<void> write_container(const std::string& path, std::span<const std::byte> facts,
                             std::span<const std::byte> triangles) {
    ChunkTable table{0,
                     {{ChunkType::mesh_facts, 0, 0, facts.size(), xxh64(facts)},
                      {ChunkType::mesh_triangles, 0, 0, triangles.size(), xxh64(triangles)}}};
    table.file_bytes = table.place();
    ORO_TRY(WholeFile whole, WholeFile::create(path, true));
    const std::vector<std::byte> front = table.to_bytes();
    for (const std::span<const std::byte> bytes : {std::span<const std::byte>(front), facts, triangles})
        ORO_CHECK(whole.write(bytes.data(), bytes.size()));
    return whole.commit();
}

// The vertices and triangles of a mesh as its file has them.
void add_triangles(std::shared_ptr<const StoredMesh> stored, const UndulationField& undulation,
                   PlacedMesh& mesh) {
    const auto placed = [&](const LatticeSteps& at) -> PlacedVertex {
        const Geodetic place = geodetic_from_ecef(Ecef{{static_cast<double>(at[0]) / lattice_steps_per_m,
                                                        static_cast<double>(at[1]) / lattice_steps_per_m,
                                                        static_cast<double>(at[2]) / lattice_steps_per_m}});
        const double N_m = undulation.N_m.empty() ? 0.0 : undulation.at_m(place.lat_deg, place.lon_deg);
        return {place.lat_deg, place.lon_deg, place.h_m - N_m};
    };
    mesh.vertices.resize(stored->places.size());
    in_chunks(mesh.vertices.size(), thread_count(),
              [&](std::size_t i) { mesh.vertices[i] = placed(stored->places[i]); });
    const ClusterGraph& graph = stored->graph.clusters;
    for (const Cluster& cluster : graph.clusters) {
        if (cluster.made_by != no_group) break;
        for (const VertexTriangle& triangle : graph.triangles_of(cluster)) mesh.triangles.push_back(triangle);
    }
    mesh.feature_of = stored->labels;
    mesh.not_added = mesh.triangles.size();
    mesh.stored = std::move(stored);
}

// Colours of the vertices of a mesh as its bytes number them. Vertices at one place have that of the first.
// vertex_of: of the mesh, for each of those places.
std::vector<VertexColour> stored_colours(const PlacedMesh& mesh, std::span<const std::uint32_t> vertex_of,
                                         std::span<const LatticeSteps> places, const StoredMesh& stored) {
    std::map<LatticeSteps, std::uint32_t> vertex_at;
    for (std::size_t i = 0; i < places.size(); ++i) vertex_at.emplace(places[i], vertex_of[i]);
    std::vector<VertexColour> colours(stored.places.size());
    for (std::size_t i = 0; i < colours.size(); ++i) {
        const auto found = vertex_at.find(stored.places[i]);
        if (found != vertex_at.end() && found->second < mesh.colours.size())
            colours[i] = mesh.colours[found->second];
    }
    return colours;
}

// Triangles in any order, each from any of its corners on, with their features: what tells them from others.
struct TriangleSum {
    std::uint64_t count{}, one{}, other{};
    void add(std::array<LatticeSteps, 3> corners, std::uint32_t label) {
        std::ranges::rotate(corners, std::ranges::min_element(corners));
        const std::uint64_t labelled = xxh64(std::as_bytes(std::span(&label, 1)));
        ++count;
        one += xxh64(std::as_bytes(std::span(corners)), labelled);
        other += xxh64(std::as_bytes(std::span(corners)), ~labelled);
    }
    bool operator==(const TriangleSum&) const = default;
};

// A mesh as its graph is built over it.
struct MeshOnLattice {
    LatticeMesh lattice;
    std::vector<LatticeSteps> places;  // of its vertices
    MeshOnLattice(const PlacedMesh& mesh, const UndulationField& undulation) {
        const std::vector<glm::dvec3> places_m = drawn_places_m(mesh, undulation, 1.0);
        lattice = lattice_mesh(places_m, mesh.triangles);
        places.reserve(lattice.vertex_of.size());
        for (const std::uint32_t vertex : lattice.vertex_of)
            places.push_back(lattice_point(places_m[vertex]).steps);
    }
    [[nodiscard]] TriangleSum sum(const PlacedMesh& mesh) const {
        TriangleSum sum;
        for (std::size_t i = 0; i < lattice.triangles.size(); ++i) {
            const auto& [a, b, c] = lattice.triangles[i];
            sum.add({places[a], places[b], places[c]},
                    mesh.features.empty() ? 0 : mesh.feature_of[lattice.triangle_of[i]]);
        }
        return sum;
    }
};

TriangleSum sum_of(const StoredMesh& stored) {
    TriangleSum sum;
    const ClusterGraph& graph = stored.graph.clusters;
    std::size_t number = 0;
    for (const Cluster& cluster : graph.clusters) {
        if (cluster.made_by != no_group) break;
        for (const VertexTriangle& triangle : graph.triangles_of(cluster)) {
            sum.add({stored.places[triangle[0]], stored.places[triangle[1]], stored.places[triangle[2]]},
                    stored.labels.empty() ? 0 : stored.labels[number]);
            ++number;
        }
    }
    return sum;
}

// scratch: where it grows; null: in memory.
Result<MeshGraph> graph_over(const LatticeMesh& lattice, const MeshGround& ground, int threads,
                             ScratchMemory* scratch) {
    if (lattice.triangles.empty()) return MeshGraph();
    MeshGraphOptions options{threads};
    options.ground = &ground, options.scratch = scratch;
    try {
        return build_mesh_graph(lattice.vertices, lattice.triangles, lattice.origin_m, options);
    } catch (const std::bad_alloc&) {
        if (scratch != nullptr && scratch->error()) return *scratch->error();
        throw;
    }
}

std::string folder_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

Result<PlacedMesh> read_mesh_of(const Container& container, const Chunk& facts_chunk,
                                const UndulationField& undulation) {
    ORO_TRY(const Chunk triangles_chunk, container.chunk(ChunkType::mesh_triangles, facts_chunk.grid));
    const OpenFile& file = container.file();
    ORO_TRY(const std::vector<std::byte> packed, container.read(facts_chunk, most_fact_bytes));
    const auto facts = decompressed(packed, most_fact_bytes);
    std::optional<PlacedMesh> mesh = facts ? facts_from_bytes(*facts) : std::nullopt;
    if (!mesh) return file.damaged(facts_chunk.offset, "facts of a mesh that are none");
    ORO_TRY(const std::vector<std::byte> bytes, container.read(triangles_chunk, most_triangle_bytes));
    auto stored = std::make_shared<StoredMesh>();
    if (const auto wrong = mesh_from_bytes(bytes, *stored))
        return file.damaged(triangles_chunk.offset, "the mesh " + *wrong);
    if (stored->label_count != mesh->features.size())
        return file.damaged(triangles_chunk.offset, "the mesh has " + std::to_string(stored->label_count) +
                                                        " features, expected " +
                                                        std::to_string(mesh->features.size()));
    if (!mesh->colours.empty() && mesh->colours.size() != stored->places.size())
        return file.damaged(facts_chunk.offset, "colours of " + std::to_string(mesh->colours.size()) +
                                                    " vertices, expected " +
                                                    std::to_string(stored->places.size()));
    add_triangles(std::move(stored), undulation, *mesh);
    return std::move(*mesh);
}

}  // namespace

std::string path_of_mesh(const std::string& path, std::size_t number) {
    return path + ".mesh-" + std::to_string(number + 1);
}

Result<BakedMeshReport> write_baked_mesh(const std::string& path, const PlacedMesh& mesh,
                                         const UndulationField& undulation, int threads, const Region* ground,
                                         std::size_t most_in_memory) {
    ORO_CHECK(check_bake_memory(mesh.path, mesh.triangles.size()));
    BakedMeshReport report;
    const auto start = Clock::now();
    MeshOnLattice on_lattice(mesh, undulation);
    LatticeMesh& lattice = on_lattice.lattice;
    ScratchMemory scratch(folder_of(path));
    MeshGround below;
    if (ground != nullptr)
        below = ground_below_parts(lattice.vertices, lattice.triangles, lattice.origin_m, *ground, 1.0);
    const bool is_large = lattice.triangles.size() > most_in_memory;
    ORO_TRY(const MeshGraph graph, graph_over(lattice, below, threads, is_large ? &scratch : nullptr));
    report.build_s = seconds_since(start);
    report.triangles = lattice.triangles.size();
    lattice.vertices = {}, lattice.triangles = {};
    std::vector<std::uint32_t> labels;
    if (!mesh.features.empty())
        for (const std::uint32_t triangle : lattice.triangle_of) labels.push_back(mesh.feature_of[triangle]);
    Result<std::vector<std::byte>> bytes = mesh_to_bytes(
        {lattice_point(lattice.origin_m).steps, on_lattice.places, labels,
         static_cast<std::uint32_t>(mesh.features.size()), graph, fingerprint_of(below, lattice.origin_m)});
    if (!bytes) return Error{bytes.error().kind, mesh.path, bytes.error().what};
    std::vector<VertexColour> colours;
    if (StoredMesh stored; !mesh.colours.empty() && !mesh_from_bytes(*bytes, stored))
        colours = stored_colours(mesh, lattice.vertex_of, on_lattice.places, stored);
    const std::vector<std::byte> facts = compressed(facts_to_bytes(mesh, std::move(colours)));
    ORO_CHECK(write_container(path, facts, *bytes));
    report.graph_triangles = graph.clusters.triangles.size();
    report.levels = graph.clusters.levels.size();
    report.bytes = bytes->size(), report.fact_bytes = facts.size();
    return report;
}

std::optional<BakedMeshReport> mesh_baked_before(const std::string& path, const PlacedMesh& mesh,
                                                 const UndulationField& undulation, const Region* ground) {
    const auto container = Container::open(path);
    if (!container.ok()) return std::nullopt;
    const Chunk* const facts_chunk = (*container)->find(ChunkType::mesh_facts, 0);
    const Chunk* const triangles_chunk = (*container)->find(ChunkType::mesh_triangles, 0);
    if (facts_chunk == nullptr || triangles_chunk == nullptr) return std::nullopt;
    const auto packed = (*container)->read(*facts_chunk, most_fact_bytes);
    const auto bytes = (*container)->read(*triangles_chunk, most_triangle_bytes);
    StoredMesh stored;
    if (!packed.ok() || !bytes.ok() || mesh_from_bytes(*bytes, stored)) return std::nullopt;
    const MeshOnLattice now(mesh, undulation);
    if (stored.origin != lattice_point(now.lattice.origin_m).steps ||
        stored.label_count != mesh.features.size() || sum_of(stored) != now.sum(mesh))
        return std::nullopt;
    MeshGround below;
    if (ground != nullptr)
        below = ground_below_parts(now.lattice.vertices, now.lattice.triangles, now.lattice.origin_m, *ground,
                                   1.0);
    if (stored.ground_fingerprint != fingerprint_of(below, now.lattice.origin_m)) return std::nullopt;
    std::vector<VertexColour> colours;
    if (!mesh.colours.empty()) colours = stored_colours(mesh, now.lattice.vertex_of, now.places, stored);
    if (decompressed(*packed, most_fact_bytes) != facts_to_bytes(mesh, std::move(colours)))
        return std::nullopt;
    BakedMeshReport report;
    report.triangles = now.lattice.triangles.size();
    report.graph_triangles = stored.graph.clusters.triangles.size();
    report.levels = stored.graph.clusters.levels.size();
    report.bytes = bytes->size(), report.fact_bytes = packed->size();
    report.was_there = true;
    return report;
}

Result<std::vector<PlacedMesh>> read_baked_meshes(const Container& container,
                                                  const UndulationField& undulation) {
    std::vector<PlacedMesh> meshes;
    for (std::uint32_t number = 0;; ++number) {
        const Chunk* const facts = container.find(ChunkType::mesh_facts, number);
        if (facts == nullptr) return meshes;
        ORO_TRY(PlacedMesh mesh, read_mesh_of(container, *facts, undulation));
        meshes.push_back(std::move(mesh));
    }
}

}  // namespace oro
