// Cuts of a mesh that was read in two ways.
#pragma once

#include <gtest/gtest.h>

#include "geo/together/mesh_detail.h"

namespace oro::test {

// To the bit: vertices, triangles, features and colours, in their order.
inline void expect_same(const MeshCut& a, const MeshCut& b) {
    EXPECT_EQ(a.clusters, b.clusters);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.of_triangles, b.of_triangles);
    EXPECT_EQ(a.error_m, b.error_m);
    EXPECT_EQ(a.error_px, b.error_px);
    const PlacedMesh &one = a.meshes->front(), &other = b.meshes->front();
    EXPECT_EQ(one.triangles, other.triangles);
    EXPECT_EQ(one.feature_of, other.feature_of);
    EXPECT_EQ(one.colours, other.colours);
    EXPECT_EQ(one.part_colours, other.part_colours);
    EXPECT_EQ(one.fingerprint, other.fingerprint);
    ASSERT_EQ(one.vertices.size(), other.vertices.size());
    for (std::size_t i = 0; i < one.vertices.size(); ++i) {
        ASSERT_EQ(one.vertices[i].lat_deg, other.vertices[i].lat_deg);
        ASSERT_EQ(one.vertices[i].lon_deg, other.vertices[i].lon_deg);
        ASSERT_EQ(one.vertices[i].H_m, other.vertices[i].H_m);
    }
}

}  // namespace oro::test
