#include "core/streamed_mesh/made_payload.h"

#include <algorithm>

#include "core/cluster_file/number_code.h"

namespace oro {
namespace {

std::size_t vertex_count(std::span<const GroupMaps::Triangle> triangles) {
    std::size_t count = 0;
    for (const GroupMaps::Triangle& triangle : triangles)
        for (const std::uint32_t corner : triangle) count = std::max<std::size_t>(count, corner + 1U);
    return count;
}

// The triangles that are left, cluster by cluster, with their vertices numbered anew.
MeshPayload payload_of_left(const MeshPayload& used,
                            std::span<const std::vector<const GroupMaps::Left*>> of_cluster) {
    constexpr std::uint32_t not_met = ~std::uint32_t{0};
    std::vector<std::uint32_t> number(used.places.size(), not_met);
    MeshPayload payload;
    for (const std::vector<const GroupMaps::Left*>& cluster : of_cluster)
        for (const GroupMaps::Left* const one : cluster) {
            std::array<std::uint16_t, 3>& triangle = payload.triangles.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint32_t& corner = number[one->corners[k]];
                if (corner == not_met) {
                    corner = static_cast<std::uint32_t>(payload.places.size());
                    payload.places.push_back(used.places[one->corners[k]]);
                    if (!used.colours.empty()) payload.colours.push_back(used.colours[one->corners[k]]);
                }
                triangle[k] = static_cast<std::uint16_t>(corner);
            }
            if (!used.labels.empty()) payload.labels.push_back(used.labels[one->number]);
        }
    return payload;
}

}  // namespace

void JoinedPayload::add(const MeshPayload& payload, std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
        std::array<std::uint16_t, 3>& triangle = payload_.triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint16_t corner = payload.triangles[i][k];
            const auto [found, is_new] = numbers_.try_emplace(
                payload.places[corner], static_cast<std::uint16_t>(payload_.places.size()));
            if (is_new) {
                payload_.places.push_back(payload.places[corner]);
                if (!payload.colours.empty()) payload_.colours.push_back(payload.colours[corner]);
            }
            triangle[k] = found->second;
        }
        if (!payload.labels.empty()) payload_.labels.push_back(payload.labels[i]);
    }
}

std::vector<std::byte> made_to_bytes(std::span<const GroupMaps::Triangle> used, std::uint32_t made,
                                     std::vector<GroupMaps::Left> left) {
    const std::size_t vertices = vertex_count(used);
    RangeEncoder coder;
    GroupMaps maps(vertices);
    // Which vertices are on a border is not known where a group is read alone. A map that leads there with
    // borders does without: a vertex of a border goes nowhere, but where nothing is left of it.
    if (!maps.code(coder, used, std::vector<char>(vertices, 0), made, left)) return {};
    return coder.finish();
}

std::optional<std::string> made_from_bytes(std::span<const std::byte> bytes, const MeshPayload& used,
                                           std::span<const std::uint32_t> clusters, MeshPayload& payload) {
    payload = {};
    std::vector<GroupMaps::Triangle> triangles;
    for (const auto& [a, b, c] : used.triangles) triangles.push_back({a, b, c});
    RangeDecoder coder(bytes);
    GroupMaps maps(used.places.size());
    std::vector<GroupMaps::Left> left;
    if (!maps.code(coder, triangles, std::vector<char>(used.places.size(), 0),
                   static_cast<std::uint32_t>(clusters.size()), left))
        return "has vertices that lead nowhere";
    if (coder.is_wrong()) return "is cut off";
    if (!coder.at_end()) return "goes on after its last triangle";
    std::vector<std::vector<const GroupMaps::Left*>> of_cluster(clusters.size());
    for (const GroupMaps::Left& one : left) of_cluster[one.cluster].push_back(&one);
    for (std::size_t i = 0; i < clusters.size(); ++i)
        if (of_cluster[i].size() != clusters[i])
            return "has a cluster of " + std::to_string(of_cluster[i].size()) + " triangles, expected " +
                   std::to_string(clusters[i]);
    payload = payload_of_left(used, of_cluster);
    return wrong_with_triangles(payload, clusters);
}

}  // namespace oro
