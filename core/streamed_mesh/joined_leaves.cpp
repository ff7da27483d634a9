#include "core/streamed_mesh/joined_leaves.h"

#include <utility>

#include "core/streamed_mesh/place_hash.h"

namespace oro {

JoinedLeaves::JoinedLeaves(std::size_t leaves, bool has_labels) : leaves_(leaves), has_labels_(has_labels) {
    constexpr std::size_t least = 1024;
    table_.assign(least, none);
}

void JoinedLeaves::grow() {
    table_.assign(2 * table_.size(), none);
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
        std::size_t at = PlaceHash()(places_[i]) % table_.size();
        while (table_[at] != none) at = (at + 1) % table_.size();
        table_[at] = i;
    }
}

std::uint32_t JoinedLeaves::vertex(const LatticeSteps& place) {
    if (2 * places_.size() >= table_.size()) grow();
    std::size_t at = PlaceHash()(place) % table_.size();
    while (table_[at] != none && places_[table_[at]] != place) at = (at + 1) % table_.size();
    if (table_[at] == none) {
        table_[at] = static_cast<std::uint32_t>(places_.size());
        places_.push_back(place);
    }
    return table_[at];
}

void JoinedLeaves::add(std::uint32_t leaf, const MeshPayload& payload, std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
        VertexTriangle& triangle = leaves_[leaf].triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) triangle[k] = vertex(payload.places[payload.triangles[i][k]]);
        if (has_labels_) leaves_[leaf].labels.push_back(payload.labels[i]);
    }
}

MeshLeaves JoinedLeaves::take() {
    table_ = {};
    std::vector<std::uint32_t> number(places_.size(), none);
    MeshLeaves mesh;
    for (Leaf& leaf : leaves_) {
        for (VertexTriangle triangle : leaf.triangles) {
            for (std::uint32_t& corner : triangle) {
                if (number[corner] == none) {
                    number[corner] = static_cast<std::uint32_t>(mesh.places.size());
                    mesh.places.push_back(places_[corner]);
                }
                corner = number[corner];
            }
            mesh.triangles.push_back(triangle);
        }
        mesh.labels.insert(mesh.labels.end(), leaf.labels.begin(), leaf.labels.end());
        leaf = {};
    }
    return mesh;
}

}  // namespace oro
