// Must hold: heights of made terrain are the same on the GPU as on the CPU, to the bit.
#include "render/made/made_posts.h"

#include <array>
#include <vector>

#include "tests/support/gpu_fixture.h"
#include "tests/support/made_posts.h"

namespace oro {
namespace {

class MadePostsOnGpu : public test::GpuTest {
  protected:
    std::vector<std::int32_t> on_gpu(const MadeTerrain& made) const {
        auto posts = MadePosts::create(*gpu_, made);
        EXPECT_TRUE(posts.ok()) << posts.error().line();
        const std::array whole{MadeRectangle{0, made.rows(), 0, made.columns()}};
        std::vector<std::int32_t> steps(whole[0].count());
        const auto done = posts->make(whole, steps);
        EXPECT_TRUE(done.ok()) << done.error().line();
        return steps;
    }
};

TEST_F(MadePostsOnGpu, AMillionOfEachKindAreThoseOfTheCpu) {
    for (int kind = 0; kind < 8; ++kind) {
        const MadeTerrain made = test::made_example(static_cast<MadeKind>(kind));
        EXPECT_EQ(on_gpu(made), test::heights_of(made)) << "kind " << kind;
    }
}

// Round the whole Earth, both poles and 180 degrees.
TEST_F(MadePostsOnGpu, OfAWholeWorldAreThoseOfTheCpu) {
    for (int kind = 0; kind < 8; ++kind) {
        MadeTerrain made = test::made_example(static_cast<MadeKind>(kind));
        made.posts_per_deg = 2;
        made.west = -360;
        made.east = 360;
        made.south = -180;
        made.north = 180;
        made.cell_shift = 28;
        made.octaves = 20;
        made.radius_m = 1000000;
        EXPECT_EQ(on_gpu(made), test::heights_of(made)) << "kind " << kind;
    }
}

// Rectangles in one submission, poles among them: each has the posts of the whole.
TEST_F(MadePostsOnGpu, OfRectanglesAreThoseOfTheWhole) {
    for (const MadeKind kind : {MadeKind::fbm, MadeKind::checker}) {
        MadeTerrain made = test::made_example(kind);
        made.posts_per_deg = 2;
        made.west = -360;
        made.east = 359;
        made.south = -180;
        made.north = 180;
        made.cell_shift = 28;
        const std::vector<std::int32_t> all = test::heights_of(made);
        const std::array parts{MadeRectangle{0, 131, 5, 131}, MadeRectangle{77, 3, 600, 20},
                               MadeRectangle{300, 61, 0, 131}};
        auto posts = MadePosts::create(*gpu_, made);
        ASSERT_TRUE(posts.ok()) << posts.error().line();
        std::size_t count = 0;
        for (const MadeRectangle& part : parts) count += part.count();
        std::vector<std::int32_t> steps(count);
        ASSERT_TRUE(posts->make(parts, steps).ok());
        std::size_t at = 0;
        for (const MadeRectangle& part : parts)
            for (int row = 0; row < part.rows; ++row)
                for (int column = 0; column < part.columns; ++column)
                    ASSERT_EQ(steps[at++], all[static_cast<std::size_t>(part.first_row + row) *
                                                   static_cast<std::size_t>(made.columns()) +
                                               static_cast<std::size_t>(part.first_column + column)]);
    }
}

}  // namespace
}  // namespace oro
