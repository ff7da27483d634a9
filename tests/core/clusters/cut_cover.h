// Whether the clusters of a cut cover what the original covers: once, with edges that meet.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <vector>

#include "tests/core/clusters/cluster_terrain.h"

namespace oro::test {

inline std::int64_t twice_area_of(const OriginalSurface& surface,
                                  const std::vector<VertexTriangle>& triangles) {
    std::int64_t sum = 0;
    for (const VertexTriangle& triangle : triangles) {
        const std::int64_t area =
            twice_area(surface.vertex(triangle[0]), surface.vertex(triangle[1]), surface.vertex(triangle[2]));
        EXPECT_GT(area, 0);
        sum += area;
    }
    return sum;
}

// The original's triangles, their area, and its rim.
struct Whole {
    std::int64_t area;
    std::set<DirectedEdge> rim;
};
inline Whole whole_of(const OriginalSurface& surface) {
    const auto triangles = original_triangles(surface);
    std::size_t twice = 0;
    Whole whole{twice_area_of(surface, triangles), rim_of(triangles, twice)};
    EXPECT_EQ(twice, 0U);
    return whole;
}

// Same area, each edge once each way, and no edge without a partner but along the original's rim, all of it:
// then the triangles lie beside each other, and each place of the original is in one of them.
inline void expect_cover(const ClusterTerrain& terrain, const Whole& whole,
                         const std::vector<std::uint32_t>& cut) {
    const auto triangles = triangles_of(terrain.graph, cut);
    EXPECT_EQ(twice_area_of(terrain.surface, triangles), whole.area);
    std::size_t twice = 0;
    std::set<DirectedEdge> steps;
    for (const DirectedEdge& edge : rim_of(triangles, twice)) {
        for (const DirectedEdge& step : unit_steps(terrain.surface, edge, terrain.heights.columns))
            EXPECT_TRUE(steps.insert(step).second);
    }
    EXPECT_EQ(twice, 0U) << "edges of two triangles on the same side";
    EXPECT_TRUE(steps == whole.rim) << steps.size() << " steps along rims, for " << whole.rim.size();
}

}  // namespace oro::test
