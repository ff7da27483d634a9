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
#include "core/mesh_file/written_mesh.h"
#include "core/mesh_graph/grown_mesh_graph.h"
#include "core/mesh_graph/mesh_graph.h"
#include "core/streamed_mesh/streamed_mesh.h"
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
                             std::span<const std::byte> triangles, const StreamedBytes& streamed) {
    const std::span<const std::byte> records = streamed.records, payloads = streamed.payloads;
    ChunkTable table{0,
                     {{ChunkType::mesh_facts, 0, 0, facts.size(), xxh64(facts)},
                      {ChunkType::mesh_triangles, 0, 0, triangles.size(), xxh64(triangles)}}};
    if (!records.empty()) {
        table.chunks.push_back({ChunkType::mesh_records, 0, 0, records.size(), xxh64(records)});
        table.chunks.push_back({ChunkType::mesh_payloads, 0, 0, payloads.size(), xxh64(payloads)});
    }
    table.file_bytes = table.place();
    ORO_TRY(WholeFile whole, WholeFile::create(path, true));
    const std::vector<std::byte> front = table.to_bytes();
    for (const std::span<const std::byte> bytes :
         {std::span<const std::byte>(front), facts, triangles, records, payloads})
        ORO_CHECK(whole.write(bytes.data(), bytes.size()));
    return whole.commit();
}

// The vertices and triangles of a mesh as its file has them.
void add_triangles(std::shared_ptr<const StoredMesh> stored, const UndulationField& undulation,
                   PlacedMesh& mesh) {
    mesh.vertices.resize(stored->places.size());
    in_chunks(mesh.vertices.size(), thread_count(),
              [&](std::size_t i) { mesh.vertices[i] = vertex_on_lattice(stored->places[i], undulation); });
    const ClusterGraph& graph = stored->graph.clusters;
    for (const Cluster& cluster : graph.clusters) {
        if (cluster.made_by != no_group) break;
        for (const VertexTriangle& triangle : graph.triangles_of(cluster)) mesh.triangles.push_back(triangle);
    }
    mesh.feature_of.assign(stored->labels.begin(), stored->labels.end());
    mesh.not_added = mesh.triangles.size();
    mesh.baked = std::make_shared<const BakedMesh>(BakedMesh{std::move(stored), nullptr, 0});
}

// Colours of the vertices of a mesh as its bytes number them. Vertices at one place have that of the first.
// vertex_of: of the mesh, for each of those places.
ScratchVector<VertexColour> stored_colours(const PlacedMesh& mesh, std::span<const std::uint32_t> vertex_of,
                                           std::span<const LatticeSteps> places, const StoredMesh& stored) {
    std::map<LatticeSteps, std::uint32_t> vertex_at;
    for (std::size_t i = 0; i < places.size(); ++i) vertex_at.emplace(places[i], vertex_of[i]);
    ScratchVector<VertexColour> colours(stored.places.size());
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
        std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
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
    std::pmr::vector<LatticeSteps> places;  // of its vertices
    // scratch: where it lies, which it outlives; null: in memory.
    MeshOnLattice(const PlacedMesh& mesh, const UndulationField& undulation, ScratchMemory* scratch = nullptr)
        : lattice(array_memory(scratch)), places(array_memory(scratch)) {
        std::pmr::vector<glm::dvec3> places_m(mesh.vertices.size(), array_memory(scratch));
        drawn_places_m(mesh, undulation, 1.0, places_m);
        lattice = lattice_mesh(places_m, mesh.triangles, scratch);
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
GrownMeshGraph graph_over(const LatticeMesh& lattice, const MeshGround& ground, int threads,
                          ScratchMemory* scratch) {
    if (lattice.triangles.empty()) return {};
    MeshGraphOptions options{threads};
    options.ground = &ground, options.scratch = scratch;
    return grow_mesh_graph(lattice.vertices, lattice.triangles, lattice.origin_m, options);
}

std::string folder_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

// The ground that a mesh's graph is built over.
struct BakedGround {
    GroundCells cells;
    MeshGround triangles;
    // scratch: where what is of the mesh's size lies; null: in memory.
    BakedGround(const LatticeMesh& mesh, const Region* region, ScratchMemory* scratch = nullptr) {
        if (region == nullptr) return;
        cells = ground_cells_below_parts(mesh.vertices, mesh.triangles, mesh.origin_m, *region, scratch);
        triangles = ground_in_cells(cells, mesh.origin_m, *region, 1.0);
    }
};

// A mesh group by group. cells: of the ground that its graph was built over, if any.
StreamedBytes groups_of(const StoredMeshView& stored, std::span<const VertexColour> colours,
                        const GroundCells& cells, int threads, ScratchMemory* scratch = nullptr,
                        PayloadForm form = PayloadForm::from_below) {
    return streamed_bytes_of(stored, colours, threads, stored.ground_fingerprint != 0 ? &cells : nullptr,
                             scratch, form);
}

// Whether a file has a mesh group by group as these bytes have it.
bool has_streamed_bytes(const Container& container, std::uint32_t number, const StreamedBytes& expected) {
    const auto is_there = [&](ChunkType type, std::span<const std::byte> bytes) {
        const Chunk* const chunk = container.find(type, number);
        if (chunk == nullptr || chunk->bytes != bytes.size()) return chunk == nullptr && bytes.empty();
        const auto found = container.read(*chunk, bytes.size());
        return found.ok() && std::ranges::equal(*found, bytes);
    };
    return is_there(ChunkType::mesh_records, expected.records) &&
           is_there(ChunkType::mesh_payloads, expected.payloads);
}

// What is known of a mesh beside its triangles.
Result<PlacedMesh> read_facts(const Container& container, const Chunk& facts_chunk) {
    ORO_TRY(const std::vector<std::byte> packed, container.read(facts_chunk, most_fact_bytes));
    const auto facts = decompressed(packed, most_fact_bytes);
    std::optional<PlacedMesh> mesh = facts ? facts_from_bytes(*facts) : std::nullopt;
    if (!mesh) return container.file().damaged(facts_chunk.offset, "facts of a mesh that are none");
    return std::move(*mesh);
}

Result<void> check_features(const Container& container, const Chunk& chunk, std::uint32_t label_count,
                            const PlacedMesh& mesh) {
    if (label_count == mesh.features.size()) return {};
    return container.file().damaged(chunk.offset, "the mesh has " + std::to_string(label_count) +
                                                      " features, expected " +
                                                      std::to_string(mesh.features.size()));
}

// The mesh of that number with its graph; what its bytes do not tell is in its groups.
Result<std::shared_ptr<StoredMesh>> read_stored_mesh(const Container& container, std::uint32_t number) {
    ORO_TRY(const Chunk triangles_chunk, container.chunk(ChunkType::mesh_triangles, number));
    ORO_TRY(const std::vector<std::byte> bytes, container.read(triangles_chunk, most_triangle_bytes));
    MeshLeaves leaves;
    if (has_leaves_elsewhere(bytes)) {
        // It is not held beyond this.
        const std::shared_ptr<const Container> not_owned(std::shared_ptr<const Container>(), &container);
        ORO_TRY(const std::shared_ptr<const StreamedMesh> groups, StreamedMesh::open(not_owned, number));
        ORO_TRY(leaves, groups->leaves(thread_count()));
    }
    auto stored = std::make_shared<StoredMesh>();
    if (const auto wrong = mesh_from_bytes(bytes, *stored, &leaves))
        return container.file().damaged(triangles_chunk.offset, "the mesh " + *wrong);
    return stored;
}

Result<PlacedMesh> read_mesh_of(const Container& container, const Chunk& facts_chunk,
                                const UndulationField& undulation) {
    ORO_TRY(const Chunk triangles_chunk, container.chunk(ChunkType::mesh_triangles, facts_chunk.grid));
    ORO_TRY(PlacedMesh mesh, read_facts(container, facts_chunk));
    ORO_TRY(const std::shared_ptr<StoredMesh> stored, read_stored_mesh(container, facts_chunk.grid));
    ORO_CHECK(check_features(container, triangles_chunk, stored->label_count, mesh));
    if (!mesh.colours.empty() && mesh.colours.size() != stored->places.size())
        return container.file().damaged(
            facts_chunk.offset, "colours of " + std::to_string(mesh.colours.size()) + " vertices, expected " +
                                    std::to_string(stored->places.size()));
    // Every byte is under a checksum, also of what is read in another way.
    for (const ChunkType type : {ChunkType::mesh_records, ChunkType::mesh_payloads})
        if (const Chunk* const chunk = container.find(type, facts_chunk.grid))
            ORO_CHECK(container.check(*chunk));
    add_triangles(stored, undulation, mesh);
    return mesh;
}

// The same without its triangles, which are read as they are needed.
Result<PlacedMesh> open_mesh_of(const std::shared_ptr<const Container>& container, const Chunk& facts_chunk,
                                const UndulationField& undulation) {
    ORO_TRY(PlacedMesh mesh, read_facts(*container, facts_chunk));
    ORO_TRY(const std::shared_ptr<const StreamedMesh> streamed,
            StreamedMesh::open(container, facts_chunk.grid));
    const MeshRecords& records = streamed->records();
    const Chunk& records_chunk = *container->find(ChunkType::mesh_records, facts_chunk.grid);
    ORO_CHECK(check_features(*container, records_chunk, records.label_count, mesh));
    if (mesh.colours.empty() == records.has_colours)
        return container->file().damaged(records_chunk.offset, "the mesh has other colours than its facts");
    mesh.colours = {};  // groups have their own
    mesh.baked = std::make_shared<const BakedMesh>(
        BakedMesh{nullptr, streamed, fingerprint_of_undulation(undulation)});
    return mesh;
}

// What is baked of a mesh. scratch: where all that is of its size lies; null: in memory.
struct MeshBaking {
    const PlacedMesh& mesh;
    const UndulationField& undulation;
    int threads;
    const Region* ground;
    ScratchMemory* scratch;

    Result<BakedMeshReport> write(const std::string& path) const;

  private:
    // cells: become those of the ground that its graph is built over.
    Result<WrittenMesh> whole(MeshOnLattice& on_lattice, BakedMeshReport& report, GroundCells& cells) const;
    [[nodiscard]] ScratchVector<VertexColour> colours_of(const MeshOnLattice& on_lattice,
                                                         const WrittenMesh& written) const;
};

Result<WrittenMesh> MeshBaking::whole(MeshOnLattice& on_lattice, BakedMeshReport& report,
                                      GroundCells& cells) const {
    const auto start = Clock::now();
    LatticeMesh& lattice = on_lattice.lattice;
    BakedGround below(lattice, ground, scratch);
    const GrownMeshGraph graph = graph_over(lattice, below.triangles, threads, scratch);
    cells = std::move(below.cells);
    report.build_s = seconds_since(start);
    report.triangles = lattice.triangles.size();
    lattice.vertices = std::pmr::vector<glm::dvec3>(array_memory(scratch));
    lattice.triangles = std::pmr::vector<SourceTriangle>(array_memory(scratch));
    std::pmr::vector<std::uint32_t> labels(array_memory(scratch));
    if (!mesh.features.empty()) {
        labels.reserve(lattice.triangle_of.size());
        for (const std::uint32_t triangle : lattice.triangle_of) labels.push_back(mesh.feature_of[triangle]);
    }
    return write_mesh({lattice_point(lattice.origin_m).steps, on_lattice.places, labels,
                       static_cast<std::uint32_t>(mesh.features.size()), graph,
                       fingerprint_of(below.triangles, lattice.origin_m)},
                      scratch, LeavesIn::payloads);
}

// As stored_colours().
ScratchVector<VertexColour> MeshBaking::colours_of(const MeshOnLattice& on_lattice,
                                                   const WrittenMesh& written) const {
    if (mesh.colours.empty()) return {};
    ScratchVector<VertexColour> colours(mesh.colours.get_allocator());
    colours.reserve(written.given_vertex.size());
    for (const std::uint32_t given : written.given_vertex) {
        const std::uint32_t vertex = on_lattice.lattice.vertex_of[given];
        colours.push_back(vertex < mesh.colours.size() ? mesh.colours[vertex] : VertexColour{});
    }
    return colours;
}

Result<BakedMeshReport> MeshBaking::write(const std::string& path) const {
    BakedMeshReport report;
    MeshOnLattice on_lattice(mesh, undulation, scratch);
    const std::shared_ptr<ScratchMemory> of_mesh = mesh.vertices.get_allocator().scratch();
    if (of_mesh != nullptr) of_mesh->drop_pages();
    GroundCells cells;
    const Result<WrittenMesh> written = whole(on_lattice, report, cells);
    if (!written.ok()) return Error{written.error().kind, mesh.path, written.error().what};
    ScratchVector<VertexColour> colours = colours_of(on_lattice, *written);
    // Groups by themselves have the numbers and the order that whoever reads the whole mesh finds.
    const StreamedBytes streamed = groups_of(*written, colours, cells, threads, scratch);
    const std::vector<std::byte> facts = compressed(facts_to_bytes(mesh, std::move(colours)));
    ORO_CHECK(write_container(path, facts, written->bytes, streamed));
    report.graph_triangles = written->triangles.size();
    report.levels = written->clusters.levels.size();
    report.bytes = written->bytes.size();
    report.group_bytes = streamed.records.size() + streamed.payloads.size();
    report.fact_bytes = facts.size();
    return report;
}

}  // namespace

std::string path_of_mesh(const std::string& path, std::size_t number) {
    return path + ".mesh-" + std::to_string(number + 1);
}

Result<BakedMeshReport> write_baked_mesh(const std::string& path, const PlacedMesh& mesh,
                                         const UndulationField& undulation, int threads, const Region* ground,
                                         std::size_t most_in_memory) {
    ORO_CHECK(check_bake_memory(mesh.path, mesh.triangles.size()));
    ScratchMemory scratch(folder_of(path));
    ScratchMemory* const where = mesh.triangles.size() > most_in_memory ? &scratch : nullptr;
    try {
        return MeshBaking{mesh, undulation, threads, ground, where}.write(path);
    } catch (const std::bad_alloc&) {
        if (scratch.error()) return *scratch.error();
        throw;
    }
}

std::optional<BakedMeshReport> mesh_baked_before(const std::string& path, const PlacedMesh& mesh,
                                                 const UndulationField& undulation, const Region* ground) {
    const auto container = Container::open(path);
    if (!container.ok()) return std::nullopt;
    const Chunk* const facts_chunk = (*container)->find(ChunkType::mesh_facts, 0);
    const Chunk* const triangles_chunk = (*container)->find(ChunkType::mesh_triangles, 0);
    if (facts_chunk == nullptr || triangles_chunk == nullptr) return std::nullopt;
    const auto packed = (*container)->read(*facts_chunk, most_fact_bytes);
    const auto read = read_stored_mesh(**container, 0);
    if (!packed.ok() || !read.ok()) return std::nullopt;
    const StoredMesh& stored = **read;
    const MeshOnLattice now(mesh, undulation);
    if (stored.origin != lattice_point(now.lattice.origin_m).steps ||
        stored.label_count != mesh.features.size() || sum_of(stored) != now.sum(mesh))
        return std::nullopt;
    const BakedGround below(now.lattice, ground);
    if (stored.ground_fingerprint != fingerprint_of(below.triangles, now.lattice.origin_m))
        return std::nullopt;
    ScratchVector<VertexColour> colours;
    if (!mesh.colours.empty()) colours = stored_colours(mesh, now.lattice.vertex_of, now.places, stored);
    const StreamedBytes streamed = groups_of(stored, colours, below.cells, thread_count());
    if (!has_streamed_bytes(**container, 0, streamed)) return std::nullopt;
    if (decompressed(*packed, most_fact_bytes) != facts_to_bytes(mesh, std::move(colours)))
        return std::nullopt;
    BakedMeshReport report;
    report.triangles = now.lattice.triangles.size();
    report.graph_triangles = stored.graph.clusters.triangles.size();
    report.levels = stored.graph.clusters.levels.size();
    report.bytes = triangles_chunk->bytes;
    report.group_bytes = streamed.records.size() + streamed.payloads.size();
    report.fact_bytes = packed->size();
    report.was_there = true;
    return report;
}

Result<void> check_streamed_mesh(const Container& container, std::uint32_t number, const PlacedMesh& mesh,
                                 const Region& region) {
    if (!StreamedMesh::is_in(container, number)) return {};
    GroundCells cells;
    if (mesh.stored()->ground_fingerprint != 0) cells = ground_cells_below_parts(*mesh.stored(), region);
    const std::shared_ptr<const Container> not_owned(std::shared_ptr<const Container>(), &container);
    ORO_TRY(const std::shared_ptr<const StreamedMesh> groups, StreamedMesh::open(not_owned, number));
    const StreamedBytes expected =
        groups_of(*mesh.stored(), mesh.colours, cells, thread_count(), nullptr, groups->records().form);
    if (has_streamed_bytes(container, number, expected)) return {};
    return container.file().damaged(container.find(ChunkType::mesh_records, number)->offset,
                                    "the groups of the mesh are not those of its triangles");
}

Result<MeshesOfRegion> whole_meshes(const Region& region) {
    if (!region.meshes || std::ranges::none_of(*region.meshes, &PlacedMesh::streamed)) return region.meshes;
    auto meshes = std::make_shared<std::vector<PlacedMesh>>(*region.meshes);
    for (PlacedMesh& mesh : *meshes)
        if (mesh.streamed()) {
            ORO_TRY(mesh, read_whole_mesh(mesh, region.grids.front().field.undulation));
        }
    return MeshesOfRegion(std::move(meshes));
}

Result<PlacedMesh> read_whole_mesh(const PlacedMesh& mesh, const UndulationField& undulation) {
    const Container& container = mesh.streamed()->container();
    ORO_TRY(const Chunk facts, container.chunk(ChunkType::mesh_facts, mesh.streamed()->number()));
    return read_mesh_of(container, facts, undulation);
}

Result<std::vector<PlacedMesh>> open_baked_meshes(const std::shared_ptr<const Container>& container,
                                                  const UndulationField& undulation) {
    std::vector<PlacedMesh> meshes;
    for (std::uint32_t number = 0;; ++number) {
        const Chunk* const facts = container->find(ChunkType::mesh_facts, number);
        if (facts == nullptr) return meshes;
        ORO_TRY(PlacedMesh mesh, StreamedMesh::is_in(*container, number)
                                     ? open_mesh_of(container, *facts, undulation)
                                     : read_mesh_of(*container, *facts, undulation));
        meshes.push_back(std::move(mesh));
    }
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
