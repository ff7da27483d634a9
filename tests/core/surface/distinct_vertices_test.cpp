// Vertices of triangles, each once, against a set.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>
#include <set>

#include "core/surface/distinct_vertices.h"

namespace oro {
namespace {

TEST(DistinctVertices, AreThoseOfASet) {
    constexpr unsigned seed = 51;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    for (std::size_t count = 0; count < 300; ++count) {
        const bool few = random() % 2 == 0;
        std::uniform_int_distribution<VertexNumber> number(0, few ? 80 : 0xFFFFFFFF);
        std::vector<VertexTriangle> triangles(count);
        std::set<VertexNumber> expected;
        for (VertexTriangle& triangle : triangles) {
            for (VertexNumber& vertex : triangle) expected.insert(vertex = number(random));
        }
        const std::vector<VertexNumber> vertices = distinct_vertices(triangles);
        EXPECT_EQ(vertices, std::vector<VertexNumber>(expected.begin(), expected.end())) << count;
    }
}

}  // namespace
}  // namespace oro
