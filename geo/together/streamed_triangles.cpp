#include "geo/together/streamed_triangles.h"

#include <algorithm>
#include <cstddef>
#include <unordered_map>
#include <utility>

#include "core/base/parallel.h"
#include "core/streamed_mesh/place_hash.h"
#include "core/streamed_mesh/streamed_mesh.h"
#include "geo/together/baked_meshes.h"
#include "geo/together/mesh_ground.h"
#include "geo/together/mesh_surface.h"

namespace oro {
namespace {

// Puts clusters into a mesh one after another. Vertices are told apart by their places.
class CutOfPayloads {
  public:
    CutOfPayloads(const PlacedMesh& mesh, PlacedMesh& drawn)
        : records_(mesh.streamed()->records()), drawn_(drawn) {}

    // The triangles of a payload from that one on.
    void add(const MeshPayload& payload, std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            SourceTriangle& triangle = drawn_.triangles.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) triangle[k] = vertex(payload, payload.triangles[i][k]);
            if (records_.label_count > 0) drawn_.feature_of.push_back(payload.labels[i]);
        }
    }
    void place(const UndulationField& undulation, int threads) {
        drawn_.vertices.resize(places_.size());
        in_chunks(places_.size(), threads,
                  [&](std::size_t i) { drawn_.vertices[i] = vertex_on_lattice(places_[i], undulation); });
    }

  private:
    std::uint32_t vertex(const MeshPayload& payload, std::uint16_t corner) {
        const auto [found, is_new] =
            numbers_.try_emplace(payload.places[corner], static_cast<std::uint32_t>(places_.size()));
        if (is_new) {
            places_.push_back(payload.places[corner]);
            if (records_.has_colours) drawn_.colours.push_back(payload.colours[corner]);
        }
        return found->second;
    }

    const MeshRecords& records_;
    PlacedMesh& drawn_;
    std::vector<LatticeSteps> places_;
    std::unordered_map<LatticeSteps, std::uint32_t, PlaceHash> numbers_;
};

class TrianglesOfStreamed final : public TriangleSource {
  public:
    TrianglesOfStreamed(const PlacedMesh& mesh, const UndulationField& undulation)
        : mesh_(mesh), undulation_(undulation) {
        const MeshRecords& records = mesh.streamed()->records();
        for (std::uint32_t i = 0; i < records.leaf_payloads(); ++i) {
            const ClusterGroup& group = records.group_around(i);
            spheres_.push_back({group.centre.m, group.radius_m});
        }
    }
    [[nodiscard]] std::span<const Sphere> spheres() const override { return spheres_; }
    [[nodiscard]] std::size_t triangles() const override { return mesh_.streamed()->records().triangles; }
    [[nodiscard]] Result<Part> part(std::size_t number) const override {
        const auto payload = static_cast<std::uint32_t>(number);
        ORO_TRY(const auto read, mesh_.streamed()->read(std::span(&payload, 1), 1));
        const MeshPayload& found = *read.front();
        Part part;
        for (const LatticeSteps& at : found.places)
            part.triangles.vertices_m.push_back(glm::dvec3(static_cast<double>(at[0]),
                                                           static_cast<double>(at[1]),
                                                           static_cast<double>(at[2])) /
                                                lattice_steps_per_m);
        for (const auto& [a, b, c] : found.triangles) part.triangles.triangles.push_back({a, b, c});
        for (const std::uint32_t label : found.labels) part.triangles.features.push_back(label + 1);
        const MeshRecords& records = mesh_.streamed()->records();
        for (const std::uint32_t one : records.clusters_of(payload)) {
            const Cluster& cluster = records.graph.clusters.clusters[one];
            for (std::uint32_t i = 0; i < cluster.triangles; ++i)
                part.numbers.push_back(cluster.first_triangle + i);
        }
        return part;
    }
    [[nodiscard]] Result<MeshTriangles> whole() const override {
        ORO_TRY(const PlacedMesh all, read_whole_mesh(mesh_, undulation_));
        return true_triangles(all, undulation_, 1.0);
    }

  private:
    const PlacedMesh& mesh_;
    const UndulationField& undulation_;
    std::vector<Sphere> spheres_;
};

}  // namespace

PlacedMesh without_triangles(const PlacedMesh& mesh) {
    PlacedMesh bare;
    bare.path = mesh.path, bare.format = mesh.format, bare.crs = mesh.crs, bare.heights = mesh.heights;
    bare.kind = mesh.kind, bare.look = mesh.look, bare.has_look_by_type = mesh.has_look_by_type;
    bare.crease_deg = mesh.crease_deg;
    bare.features = mesh.features, bare.in_file = mesh.in_file, bare.fingerprint = mesh.fingerprint;
    return bare;
}

bool streams_as_drawn(const PlacedMesh& mesh, const Region& region, double exaggeration) {
    if (!is_drawn_as_streamed(mesh, region.grids.front().field.undulation, exaggeration)) return false;
    const MeshRecords& records = mesh.streamed()->records();
    if (records.ground_fingerprint == 0) return true;
    const glm::dvec3 origin_m =
        glm::dvec3(static_cast<double>(records.origin[0]), static_cast<double>(records.origin[1]),
                   static_cast<double>(records.origin[2])) /
        lattice_steps_per_m;
    const MeshGround ground = ground_in_cells(records.ground_cells, origin_m, region, exaggeration);
    return fingerprint_of(ground, origin_m) == records.ground_fingerprint;
}

Result<PlacedMesh> streamed_cut(const PlacedMesh& mesh, const std::vector<std::uint32_t>& clusters,
                                const UndulationField& undulation, int threads) {
    PlacedMesh drawn = without_triangles(mesh);
    const MeshRecords& records = mesh.streamed()->records();
    CutOfPayloads cut(mesh, drawn);
    constexpr std::size_t at_a_time = 4096;
    for (std::size_t first = 0; first < clusters.size(); first += at_a_time) {
        const auto some = std::span(clusters).subspan(first, std::min(at_a_time, clusters.size() - first));
        std::vector<std::uint32_t> payloads;
        for (const std::uint32_t one : some)
            payloads.push_back(records.payload_of(records.graph.clusters.clusters[one]));
        std::ranges::sort(payloads);
        payloads.erase(std::unique(payloads.begin(), payloads.end()), payloads.end());
        ORO_TRY(const std::vector<StreamedMesh::Payload> read, mesh.streamed()->read(payloads, threads));
        for (const std::uint32_t one : some) {
            const Cluster& cluster = records.graph.clusters.clusters[one];
            const std::uint32_t payload = records.payload_of(cluster);
            const auto at = std::ranges::lower_bound(payloads, payload) - payloads.begin();
            cut.add(*read[static_cast<std::size_t>(at)], records.first_in_payload(one), cluster.triangles);
        }
    }
    cut.place(undulation, threads);
    return drawn;
}

std::shared_ptr<const TriangleSource> true_triangles_of_streamed(const PlacedMesh& mesh,
                                                                 const UndulationField& undulation) {
    return std::make_shared<const TrianglesOfStreamed>(mesh, undulation);
}

void hold_streamed_at_most(const std::vector<PlacedMesh>& meshes, std::uint64_t bytes) {
    const auto count = static_cast<std::uint64_t>(
        std::ranges::count_if(meshes, [](const PlacedMesh& mesh) { return mesh.streamed() != nullptr; }));
    for (const PlacedMesh& mesh : meshes)
        if (mesh.streamed()) mesh.streamed()->hold_at_most(bytes / count);
}

}  // namespace oro
