// Groups of a mesh by themselves: each has the triangles that the whole mesh has of it, in the same order,
// and any bytes are that or refused.
#include "core/streamed_mesh/mesh_records.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "core/base/checksum.h"
#include "core/base/little_endian.h"
#include "core/mesh_file/mesh_bytes.h"
#include "tests/support/made_space_meshes.h"

namespace oro {
namespace {

using namespace test;

// A mesh as it is read from a file: with seven labels.
StoredMesh stored_mesh_of(const SpaceMesh& mesh) {
    const LatticeSteps middle{8192000000, 1228800000, 10035200000};  // 4,000, 600 and 4,900 km
    std::vector<LatticeSteps> places;
    for (const glm::dvec3& at : mesh.vertices)
        places.push_back({middle[0] + std::llround(2048.0 * at.x), middle[1] + std::llround(2048.0 * at.y),
                          middle[2] + std::llround(2048.0 * at.z)});
    std::vector<std::uint32_t> labels;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        labels.push_back(static_cast<std::uint32_t>(i / 40 % 7));
    const MeshGraph graph = build_mesh_graph(mesh.vertices, mesh.triangles, {4.0e6, 6.0e5, 4.9e6}, {2});
    const auto bytes = mesh_to_bytes({middle, places, labels, 7, graph});
    StoredMesh stored;
    EXPECT_TRUE(bytes.ok());
    EXPECT_FALSE(mesh_from_bytes(*bytes, stored));
    return stored;
}

std::vector<VertexColour> colours_for(const StoredMesh& mesh) {
    std::vector<VertexColour> colours;
    for (std::size_t i = 0; i < mesh.places.size(); ++i) {
        const auto code = static_cast<std::uint8_t>(i * 37 % 251);
        colours.push_back(i % 11 == 0 ? VertexColour{}
                                      : VertexColour{code, 200, static_cast<std::uint8_t>(255 - code), 1});
    }
    return colours;
}

// Of a mesh that was built over the ground of one grid.
GroundCells some_cells() {
    return {46.0, 46.1, 8.0, 8.2, {{77, {{10, 20, 5}, {11, 19, 7}, {11, 40, 1}}}}};
}

std::span<const std::byte> bytes_at(const StreamedBytes& bytes, const MeshRecords& records,
                                    std::uint32_t number) {
    return std::span(bytes.payloads).subspan(records.payloads[number].offset, records.payloads[number].bytes);
}

// What a payload is told by, out of all that are before it.
std::vector<const MeshPayload*> sources_in(std::span<const MeshPayload> payloads, const MeshRecords& records,
                                           std::uint32_t number) {
    std::vector<const MeshPayload*> sources;
    for (const std::uint32_t one : records.sources_of(number)) {
        EXPECT_LT(one, number);
        sources.push_back(&payloads[one]);
    }
    return sources;
}

std::vector<MeshPayload> payloads_of(const StreamedBytes& bytes, const MeshRecords& records) {
    std::vector<MeshPayload> payloads(records.payloads.size());
    for (std::uint32_t number = 0; number < payloads.size(); ++number) {
        const auto wrong = payload_of_records(bytes_at(bytes, records, number), records, number,
                                              sources_in(payloads, records, number), payloads[number]);
        EXPECT_FALSE(wrong) << *wrong;
    }
    return payloads;
}

// The payload of that number by any bytes, whatever its checksum is.
std::optional<std::string> payload_of_any(std::span<const std::byte> bytes, MeshRecords& records,
                                          std::uint32_t number, std::span<const MeshPayload> payloads,
                                          MeshPayload& payload) {
    records.payloads[number].checksum = xxh64(bytes, number);
    return payload_of_records(bytes, records, number, sources_in(payloads, records, number), payload);
}

// Each triangle of each cluster is that of the stored mesh, from the same corner on.
void expect_clusters_of(const StoredMesh& mesh, std::span<const VertexColour> colours,
                        const StreamedBytes& bytes, const MeshRecords& records) {
    const ClusterGraph& graph = mesh.graph.clusters;
    std::size_t triangles = 0;
    const std::vector<MeshPayload> payloads = payloads_of(bytes, records);
    for (std::uint32_t number = 0; number < payloads.size(); ++number) {
        const MeshPayload& payload = payloads[number];
        std::size_t at = 0;
        for (const std::uint32_t one : records.clusters_of(number)) {
            const Cluster& cluster = graph.clusters[one];
            ASSERT_EQ(records.first_in_payload(one), at);
            ASSERT_EQ(records.payload_of(records.graph.clusters.clusters[one]), number);
            for (std::uint32_t i = cluster.first_triangle; i < cluster.first_triangle + cluster.triangles;
                 ++i, ++at) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::uint32_t vertex = graph.triangles[i][k];
                    const std::uint16_t here = payload.triangles[at][k];
                    ASSERT_EQ(payload.places[here], mesh.places[vertex]) << "cluster " << one;
                    if (!colours.empty()) {
                        ASSERT_EQ(payload.colours[here], colours[vertex]);
                    }
                }
                ASSERT_EQ(payload.labels[at], mesh.labels[mesh.graph.original_of[i]]);
            }
        }
        ASSERT_EQ(at, payload.triangles.size());
        triangles += at;
    }
    EXPECT_EQ(triangles, graph.triangles.size());
}

void expect_same_graph(const ClusterGraph& a, const ClusterGraph& b) {
    ASSERT_EQ(a.groups.size(), b.groups.size());
    ASSERT_EQ(a.clusters.size(), b.clusters.size());
    EXPECT_EQ(a.members, b.members);
    for (std::size_t i = 0; i < a.groups.size(); ++i) {
        const ClusterGroup &one = a.groups[i], &other = b.groups[i];
        ASSERT_EQ(one.level, other.level);
        ASSERT_EQ(one.first_member, other.first_member);
        ASSERT_EQ(one.members, other.members);
        ASSERT_EQ(one.first_made, other.first_made);
        ASSERT_EQ(one.made, other.made);
        ASSERT_EQ(one.error_m, other.error_m);
        ASSERT_EQ(one.centre.m, other.centre.m);
        ASSERT_EQ(one.radius_m, other.radius_m);
    }
    for (std::size_t i = 0; i < a.clusters.size(); ++i) {
        ASSERT_EQ(a.clusters[i].triangles, b.clusters[i].triangles);
        ASSERT_EQ(a.clusters[i].first_triangle, b.clusters[i].first_triangle);
        ASSERT_EQ(a.clusters[i].made_by, b.clusters[i].made_by);
        ASSERT_EQ(a.clusters[i].used_by, b.clusters[i].used_by);
    }
    ASSERT_EQ(a.levels.size(), b.levels.size());
    for (std::size_t i = 0; i < a.levels.size(); ++i) {
        EXPECT_EQ(a.levels[i].triangles_in, b.levels[i].triangles_in);
        EXPECT_EQ(a.levels[i].triangles_out, b.levels[i].triangles_out);
        EXPECT_EQ(a.levels[i].groups, b.levels[i].groups);
        EXPECT_EQ(a.levels[i].clusters_out, b.levels[i].clusters_out);
        EXPECT_EQ(a.levels[i].stuck_groups, b.levels[i].stuck_groups);
        EXPECT_EQ(a.levels[i].largest_error_m, b.levels[i].largest_error_m);
    }
}

// Records and payloads of a mesh, and back.
void expect_mesh_comes_back(StoredMesh mesh, std::size_t triangles, std::span<const VertexColour> colours,
                            const GroundCells* cells, PayloadForm form) {
    mesh.ground_fingerprint = cells != nullptr ? 52 : 0;
    const StreamedBytes bytes = streamed_bytes_of(mesh, colours, 2, cells, nullptr, form);
    MeshRecords records;
    const auto wrong = records_from_bytes(bytes.records, bytes.payloads.size(), records);
    ASSERT_FALSE(wrong) << *wrong;
    EXPECT_EQ(records.triangles, triangles);
    EXPECT_EQ(records.label_count, 7U);
    EXPECT_EQ(records.has_colours, !colours.empty());
    EXPECT_EQ(records.origin, mesh.origin);
    EXPECT_EQ(records.ground_fingerprint, mesh.ground_fingerprint);
    EXPECT_EQ(records.ground_cells, cells != nullptr ? *cells : GroundCells());
    EXPECT_EQ(records.is_town(), cells != nullptr);
    EXPECT_EQ(records.form, form);
    expect_same_graph(records.graph.clusters, mesh.graph.clusters);
    expect_clusters_of(mesh, colours, bytes, records);
    const auto of_all = static_cast<double>(mesh.graph.clusters.triangles.size());
    std::printf("%zu triangles, %.0f of all levels%s%s: records %.2f, groups %.2f bytes a triangle of all\n",
                triangles, of_all, records.is_town() ? ", as a town's" : "",
                form == PayloadForm::alone ? ", each alone" : "",
                static_cast<double>(bytes.records.size()) / of_all,
                static_cast<double>(bytes.payloads.size()) / of_all);
    EXPECT_LT(static_cast<double>(bytes.records.size()), 1.0 * of_all);
    const double most = form == PayloadForm::alone ? (colours.empty() ? 7.0 : 9.0)
                        : colours.empty()          ? 4.0
                                                   : 6.0;
    EXPECT_LT(static_cast<double>(bytes.payloads.size()), most * of_all);
}

// A closed ball, a town of boxes, a sheet that lies over itself; each over ground, too.
TEST(MeshRecords, HaveOfEachGroupWhatTheWholeMeshHas) {
    const GroundCells cells = some_cells();
    for (const SpaceMesh& made : {hilly_ball(40, 50.0), box_town(14), folded_sheet(48)}) {
        const StoredMesh mesh = stored_mesh_of(made);
        for (const std::vector<VertexColour>& colours : {std::vector<VertexColour>(), colours_for(mesh)})
            for (const GroundCells* const ground : {static_cast<const GroundCells*>(nullptr), &cells})
                for (const PayloadForm form : {PayloadForm::alone, PayloadForm::from_below})
                    expect_mesh_comes_back(mesh, made.triangles.size(), colours, ground, form);
    }
}

// Which version records are of, and whether they have a fingerprint of ground, go together.
TEST(MeshRecords, OfGroundWithoutCellsAreRefused) {
    StoredMesh mesh = stored_mesh_of(box_town(4));
    const GroundCells cells = some_cells();
    const auto refusal = [&](std::uint64_t fingerprint, const GroundCells* ground) {
        mesh.ground_fingerprint = fingerprint;
        const StreamedBytes bytes = streamed_bytes_of(mesh, {}, 1, ground);
        MeshRecords records;
        return records_from_bytes(bytes.records, bytes.payloads.size(), records).value_or("");
    };
    EXPECT_EQ(refusal(0, nullptr), "");
    EXPECT_EQ(refusal(5, &cells), "");
    EXPECT_EQ(refusal(5, nullptr), "has ground without a place");
    EXPECT_EQ(refusal(0, &cells), "has ground without a place");
    mesh.ground_fingerprint = 5;
    const StreamedBytes bytes = streamed_bytes_of(mesh, {}, 1, &cells);
    for (std::size_t size = bytes.records.size() - 80; size < bytes.records.size(); ++size) {
        MeshRecords records;
        EXPECT_TRUE(records_from_bytes(std::span(bytes.records).first(size), bytes.payloads.size(), records));
    }
}

TEST(MeshRecords, AreTheSameBytesByAnyNumberOfThreads) {
    const StoredMesh mesh = stored_mesh_of(hilly_ball(30, 50.0));
    const StreamedBytes one = streamed_bytes_of(mesh, colours_for(mesh), 1),
                        many = streamed_bytes_of(mesh, colours_for(mesh), 5);
    EXPECT_EQ(one.records, many.records);
    EXPECT_EQ(one.payloads, many.payloads);
}

// One bit of a payload is told by its checksum; so is another payload of the same size in its place.
TEST(MeshRecords, TellDamageOfAPayload) {
    const StoredMesh mesh = stored_mesh_of(hilly_ball(24, 50.0));
    const StreamedBytes bytes = streamed_bytes_of(mesh, {}, 1);
    MeshRecords records;
    ASSERT_FALSE(records_from_bytes(bytes.records, bytes.payloads.size(), records));
    const std::vector<MeshPayload> payloads = payloads_of(bytes, records);
    for (const std::uint32_t number : {0U, static_cast<std::uint32_t>(records.payloads.size()) - 1}) {
        const auto whole = bytes_at(bytes, records, number);
        std::vector<std::byte> changed(whole.begin(), whole.end());
        changed[changed.size() / 2] ^= std::byte{4};
        MeshPayload payload;
        const auto wrong =
            payload_of_records(changed, records, number, sources_in(payloads, records, number), payload);
        ASSERT_TRUE(wrong);
        EXPECT_NE(wrong->find("of the mesh has checksum"), std::string::npos) << *wrong;
    }
}

// What no graph is, with right checksums.
TEST(MeshRecords, ThatLieAreRefused) {
    const StoredMesh mesh = stored_mesh_of(hilly_ball(24, 50.0));
    const auto refusal = [&](const auto& change) {
        StoredMesh other = mesh;
        change(other);
        const StreamedBytes bytes = streamed_bytes_of(other, {}, 1);
        MeshRecords records;
        return records_from_bytes(bytes.records, bytes.payloads.size(), records).value_or("");
    };
    EXPECT_EQ(refusal([](StoredMesh&) {}), "");
    const auto last = [](StoredMesh& other) -> ClusterGroup& { return other.graph.clusters.groups.back(); };
    EXPECT_NE(refusal([&](StoredMesh& other) { last(other).error_m = 0.0; }).find("smaller error"),
              std::string::npos);
    EXPECT_NE(
        refusal([&](StoredMesh& other) { last(other).error_m = std::nan(""); }).find("an error that is none"),
        std::string::npos);
    EXPECT_NE(refusal([&](StoredMesh& other) { last(other).radius_m *= 0.5; }).find("sphere"),
              std::string::npos);
    EXPECT_NE(refusal([&](StoredMesh& other) { last(other).radius_m = -1.0; }).find("a place that is none"),
              std::string::npos);
    EXPECT_NE(refusal([&](StoredMesh& other) {
                  other.graph.clusters.clusters[0].used_by = 4000;
              }).find("a group of another level"),
              std::string::npos);
    // A group of any size: nothing is allocated for it.
    StreamedBytes large = streamed_bytes_of(mesh, {}, 1);
    to_little_endian(std::uint32_t{4000000000U}, &large.records[large.records.size() - 12]);
    MeshRecords none;
    EXPECT_NE(records_from_bytes(large.records, large.payloads.size(), none)
                  .value_or("")
                  .find("has a group of 4000000000 bytes"),
              std::string::npos);
    const StreamedBytes bytes = streamed_bytes_of(mesh, {}, 1);
    MeshRecords records;
    EXPECT_NE(records_from_bytes(bytes.records, bytes.payloads.size() + 1, records)->find("and the file has"),
              std::string::npos);
    for (std::size_t size = 0; size < bytes.records.size(); size += 7)
        EXPECT_TRUE(records_from_bytes(std::span(bytes.records).first(size), bytes.payloads.size(), records))
            << size;
}

// A sphere that is too small for what it says it holds is refused where that is read.
TEST(MeshRecords, ThatPutAGroupElsewhereAreRefusedWhereItIsRead) {
    const StoredMesh mesh = stored_mesh_of(hilly_ball(24, 50.0));
    const StreamedBytes bytes = streamed_bytes_of(mesh, {}, 1);
    MeshRecords records;
    ASSERT_FALSE(records_from_bytes(bytes.records, bytes.payloads.size(), records));
    MeshPayload payload;
    ASSERT_FALSE(payload_of_records(bytes_at(bytes, records, 0), records, 0, {}, payload));
    records.graph.clusters.groups[0].radius_m *= 0.7;
    const auto wrong = payload_of_records(bytes_at(bytes, records, 0), records, 0, {}, payload);
    EXPECT_EQ(wrong.value_or(""), "level 0 below group 0 of the mesh lies outside of its sphere");
}

// 20,000 changes of records: refused, or a graph that cuts can be chosen of.
TEST(MeshRecords, OfAnyBytesAreAGraphOrRefused) {
    const StoredMesh mesh = stored_mesh_of(hilly_ball(20, 50.0));
    const StreamedBytes bytes = streamed_bytes_of(mesh, {}, 1);
    std::mt19937 random(52);
    int taken = 0;
    for (int i = 0; i < 20000; ++i) {
        std::vector<std::byte> changed = bytes.records;
        for (std::uint32_t k = 0; k <= random() % 3; ++k)
            changed[random() % changed.size()] = static_cast<std::byte>(random());
        MeshRecords records;
        if (records_from_bytes(changed, bytes.payloads.size(), records)) continue;
        ++taken;
        const ClusterGraph& graph = records.graph.clusters;
        for (const ClusterGroup& group : graph.groups) {
            ASSERT_GE(group.error_m, largest_member_error_m(graph, group));
            for (const std::uint32_t member : graph.members_of(group))
                ASSERT_LT(member, graph.clusters.size());
        }
        std::uint64_t end = 0;
        for (std::uint32_t k = 0; k < records.payloads.size(); ++k) {
            ASSERT_EQ(records.payloads[k].offset, end);
            end += records.payloads[k].bytes;
            for (const std::uint32_t cluster : records.clusters_of(k))
                ASSERT_LT(cluster, graph.clusters.size());
        }
        ASSERT_EQ(end, bytes.payloads.size());
    }
    std::printf("%d of 20,000 changes left a graph\n", taken);
    EXPECT_GT(taken, 500);  // errors that grow, checksums, colours
    EXPECT_LT(taken, 19000);
}

// 4,000 changes of payloads, by the shape that records have: refused, or triangles that can be drawn.
void expect_any_payloads_are_sound(const StoredMesh& mesh, const GroundCells* cells) {
    const StreamedBytes bytes = streamed_bytes_of(mesh, colours_for(mesh), 1, cells);
    MeshRecords records;
    ASSERT_FALSE(records_from_bytes(bytes.records, bytes.payloads.size(), records));
    const std::vector<MeshPayload> payloads = payloads_of(bytes, records);
    std::mt19937 random(53);
    int taken = 0;
    for (int i = 0; i < 4000; ++i) {
        const auto number = static_cast<std::uint32_t>(random() % records.payloads.size());
        const auto whole = bytes_at(bytes, records, number);
        std::vector<std::byte> changed(whole.begin(), whole.end());
        if (changed.empty()) continue;
        changed[random() % changed.size()] = static_cast<std::byte>(random());
        if (i % 5 == 0) changed.resize(random() % changed.size());
        std::size_t all = 0;
        for (const std::uint32_t one : records.clusters_of(number))
            all += records.graph.clusters.clusters[one].triangles;
        MeshPayload payload;
        if (payload_of_any(changed, records, number, payloads, payload)) continue;
        ++taken;
        ASSERT_EQ(payload.triangles.size(), all);
        ASSERT_EQ(payload.labels.size(), all);
        ASSERT_EQ(payload.colours.size(), payload.places.size());
        for (const auto& triangle : payload.triangles)
            for (const std::uint16_t corner : triangle) ASSERT_LT(corner, payload.places.size());
        for (const std::uint32_t label : payload.labels) ASSERT_LT(label, 7U);
    }
    std::printf("%d of 4,000 changes left triangles\n", taken);
    EXPECT_LT(taken, 400);
}

TEST(MeshRecords, PayloadsOfAnyBytesAreTrianglesOrRefused) {
    expect_any_payloads_are_sound(stored_mesh_of(hilly_ball(20, 50.0)), nullptr);
}

// Bytes that tell a map, of another group's triangles: refused, or triangles that can be drawn.
TEST(MeshRecords, MapsOfOtherTrianglesAreTrianglesOrRefused) {
    const StoredMesh mesh = stored_mesh_of(hilly_ball(30, 50.0));
    const StreamedBytes bytes = streamed_bytes_of(mesh, {}, 1);
    MeshRecords records;
    ASSERT_FALSE(records_from_bytes(bytes.records, bytes.payloads.size(), records));
    const std::vector<MeshPayload> payloads = payloads_of(bytes, records);
    int maps = 0, taken = 0;
    for (std::uint32_t number = records.leaf_payloads(); number < payloads.size(); ++number) {
        if (records.levels_below(number) == 0) continue;
        std::vector<const MeshPayload*> sources = sources_in(payloads, records, number);
        for (std::size_t i = 0; i < sources.size(); ++i) {
            // The same triangles, with vertices in another order.
            MeshPayload turned = *sources[i];
            std::ranges::reverse(turned.triangles);
            std::vector<const MeshPayload*> others = sources;
            others[i] = &turned;
            MeshPayload payload;
            ++maps;
            if (payload_of_records(bytes_at(bytes, records, number), records, number, others, payload))
                continue;
            ++taken;
            for (const auto& triangle : payload.triangles)
                for (const std::uint16_t corner : triangle) ASSERT_LT(corner, payload.places.size());
        }
    }
    std::printf("%d of %d maps of other triangles left triangles\n", taken, maps);
    EXPECT_GT(maps, 10);
    EXPECT_LT(taken, maps);
}

TEST(MeshRecords, PayloadsOfATownOfAnyBytesAreTrianglesOrRefused) {
    StoredMesh mesh = stored_mesh_of(box_town(10));
    mesh.ground_fingerprint = 9;
    const GroundCells cells = some_cells();
    expect_any_payloads_are_sound(mesh, &cells);
}

}  // namespace
}  // namespace oro
