// What windows keep of a group comes back as it was, and damage does no harm.
#include "core/cluster_windows/window_file.h"

#include <random>

#include "tests/core/cluster_file/made_cluster_file.h"

namespace oro {
namespace {

using namespace test;

TEST(WindowCode, GivesBackEachGroup) {
    for (const bool holes : {false, true}) {
        const ClusterTerrain terrain(holes ? holed_field(170, 190, 5) : rough_field(47.0, 8.0, 150, 200));
        std::size_t triangles = 0, bytes = 0;
        for (std::uint32_t i = 0; i < terrain.graph.groups.size(); ++i) {
            const GroupPart part = part_of(terrain.graph, i);
            const std::vector<std::byte> packed = pack_made(part, posts_of(terrain));
            GroupPart back{part.number, part.group, {}, {}, {}};
            ASSERT_TRUE(unpack_made(packed, posts_of(terrain), back)) << "group " << i;
            ASSERT_EQ(back.triangles, part.triangles) << "group " << i;
            ASSERT_EQ(back.made.size(), part.made.size());
            for (std::size_t j = 0; j < part.made.size(); ++j) {
                EXPECT_EQ(back.made[j].first_triangle, part.made[j].first_triangle);
                EXPECT_EQ(back.made[j].triangles, part.made[j].triangles);
                EXPECT_EQ(back.made[j].vertices, part.made[j].vertices);
            }
            triangles += part.triangles.size();
            bytes += packed.size();
        }
        std::printf("%zu triangles in %.2f bytes each, holes %d\n", triangles,
                    static_cast<double>(bytes) / static_cast<double>(triangles), holes ? 1 : 0);
        EXPECT_LT(bytes, 4 * triangles);
    }
}

TEST(WindowCode, TakesAnyBytes) {
    const ClusterTerrain terrain(rough_field(47.0, 8.0, 60, 70));
    const GroupPart part = part_of(terrain.graph, 0);
    const std::vector<std::byte> packed = pack_made(part, posts_of(terrain));
    std::mt19937 random(15);
    for (int i = 0; i < 3000; ++i) {
        std::vector<std::byte> bytes = packed;
        for (int flips = 1 + i % 4; flips > 0; --flips)
            bytes[random() % bytes.size()] ^= static_cast<std::byte>(1U << random() % 8);
        if (i % 5 == 0) bytes.resize(random() % bytes.size());
        GroupPart back{part.number, part.group, {}, {}, {}};
        if (!unpack_made(bytes, posts_of(terrain), back)) continue;
        for (const VertexTriangle& triangle : back.triangles)
            for (const VertexNumber vertex : triangle) EXPECT_LT(vertex, terrain.surface.vertex_count());
    }
}

}  // namespace
}  // namespace oro
