// Any bytes as the records of a mesh, or as one of its payloads. The first byte says how the others are
// taken: as records, as changes of true ones (three bytes each: where, and what is there instead), as a
// payload's bytes, or as changes of a true one's; of a mesh over ground where its fourth bit is set. What is
// read must be a graph that cuts can be chosen of, and triangles.
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/checksum.h"
#include "core/cluster_frame/cluster_cut.h"
#include "core/mesh_file/mesh_bytes.h"
#include "core/streamed_mesh/mesh_records.h"
#include "tests/fuzz/mesh_of_ball.h"

namespace {

using namespace oro;
using test::changed;
using test::expect;

// A ball of 264 triangles, with labels.
StoredMesh stored_ball() {
    const test::MeshOfBall ball = test::mesh_of_ball(12);
    std::vector<std::uint32_t> labels;
    for (std::uint32_t i = 0; i < ball.triangles.size(); ++i) labels.push_back(i / 9 % 5);
    StoredMesh mesh;
    expect(!mesh_from_bytes(mesh_to_bytes({{}, ball.places, labels, 5, ball.graph()}).value(), mesh));
    return mesh;
}

const StreamedBytes& true_streamed_bytes(bool is_town) {
    static const std::array<StreamedBytes, 2> bytes = [] {
        const GroundCells cells{46.0, 46.1, 8.0, 8.2, {{77, {{10, 20, 5}, {11, 19, 7}, {11, 40, 1}}}}};
        StoredMesh mesh = stored_ball();
        const StreamedBytes alone = streamed_bytes_of(mesh, {}, 1);
        mesh.ground_fingerprint = 1;
        return std::array{alone, streamed_bytes_of(mesh, {}, 1, &cells)};
    }();
    return bytes[is_town ? 1 : 0];
}

void use(const MeshRecords& records) {
    const ClusterGraph& graph = records.graph.clusters;
    for (const ClusterGroup& group : graph.groups) {
        expect(std::isfinite(group.error_m) && std::isfinite(group.radius_m));
        expect(group.error_m >= largest_member_error_m(graph, group));
    }
    expect(records.ground_cells.count() <= most_ground_cells);
    for (std::uint32_t level = 0; level <= graph.levels.size(); ++level)
        for (const std::uint32_t one : cut_by_level(graph, level))
            expect(records.payload_of(graph.clusters[one]) < records.payloads.size());
}

// What a payload is told by, out of all.
std::vector<const MeshPayload*> sources_in(const std::vector<MeshPayload>& payloads,
                                           const MeshRecords& records, std::uint32_t number) {
    std::vector<const MeshPayload*> sources;
    for (const std::uint32_t one : records.sources_of(number)) sources.push_back(&payloads[one]);
    return sources;
}

// As they were written; read once.
const std::vector<MeshPayload>& true_payloads(bool is_town, const MeshRecords& records) {
    static std::array<std::vector<MeshPayload>, 2> all;
    std::vector<MeshPayload>& payloads = all[is_town ? 1 : 0];
    if (!payloads.empty()) return payloads;
    payloads.resize(records.payloads.size());
    for (std::uint32_t i = 0; i < payloads.size(); ++i) {
        const auto bytes = std::span(true_streamed_bytes(is_town).payloads)
                               .subspan(records.payloads[i].offset, records.payloads[i].bytes);
        expect(!payload_of_records(bytes, records, i, sources_in(payloads, records, i), payloads[i]));
    }
    return payloads;
}

// The payload of that number by any bytes, with the checksum that these have.
void use_as_payload(std::span<const std::byte> bytes, MeshRecords& records, std::uint32_t number,
                    const std::vector<MeshPayload>& payloads) {
    std::size_t all = 0;
    for (const std::uint32_t one : records.clusters_of(number))
        all += records.graph.clusters.clusters[one].triangles;
    records.payloads[number].checksum = xxh64(bytes, number);
    MeshPayload payload;
    if (payload_of_records(bytes, records, number, sources_in(payloads, records, number), payload)) return;
    expect(payload.triangles.size() == all && payload.labels.size() == all);
    for (const auto& triangle : payload.triangles)
        for (const std::uint16_t corner : triangle) expect(corner < payload.places.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const std::uint8_t how = data[0] % 4, number = data[1];
    std::vector<std::byte> bytes;
    for (std::size_t i = 2; i < size; ++i) bytes.push_back(static_cast<std::byte>(data[i]));
    const StreamedBytes& whole = true_streamed_bytes((data[0] & 8U) != 0);
    MeshRecords records;
    if (how < 2) {
        if (how == 1) bytes = changed(whole.records, data + 2, size - 2);
        if (!records_from_bytes(bytes, whole.payloads.size(), records)) use(records);
        return 0;
    }
    expect(!records_from_bytes(whole.records, whole.payloads.size(), records));
    const std::uint32_t payload = number % static_cast<std::uint32_t>(records.payloads.size());
    if (how == 3) {
        const auto first =
            whole.payloads.begin() + static_cast<std::ptrdiff_t>(records.payloads[payload].offset);
        bytes = changed({first, first + records.payloads[payload].bytes}, data + 2, size - 2);
    }
    use_as_payload(bytes, records, payload, true_payloads((data[0] & 8U) != 0, records));
    return 0;
}
