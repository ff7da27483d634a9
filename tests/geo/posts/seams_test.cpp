// Must hold: sources laid stretch by stretch make the surface, and the counts, that they make post by post.
#include "geo/posts/seams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

namespace oro {
namespace {

// The old rule, in words: a post takes the first height that comes; a later one of its own is compared.
struct PlainSurface {
    struct Post {
        float height_m{void_height_m};
        bool covered{}, own{}, shared{}, disagreeing{};
    };
    std::vector<Post> posts;
    SeamReport seams;

    std::uint64_t lay(Post& post, float height_m, bool own_posts, SeamReport& of_source) {
        const bool covered_before = post.covered;
        post.covered = true;
        if (is_void(height_m)) return 0;
        if (is_void(post.height_m)) {
            post.height_m = height_m;
            post.own = own_posts;
            return covered_before ? 1 : 0;
        }
        const double apart_m = std::abs(static_cast<double>(height_m) - static_cast<double>(post.height_m));
        ++of_source.compared_posts;
        if (apart_m > contradiction_m) {
            ++of_source.contradicting_posts;
            of_source.largest_contradiction_m = std::max(of_source.largest_contradiction_m, apart_m);
        }
        if (!own_posts || !post.own) return 0;
        seams.shared_posts += post.shared ? 0 : 1;
        seams.disagreeing_posts += apart_m > 0.0 && !post.disagreeing ? 1 : 0;
        post.shared = true;
        post.disagreeing |= apart_m > 0.0;
        ++of_source.shared_posts;
        of_source.disagreeing_posts += apart_m > 0.0;
        of_source.largest_difference_m = std::max(of_source.largest_difference_m, apart_m);
        seams.largest_difference_m = std::max(seams.largest_difference_m, apart_m);
        return 0;
    }
};

void expect_same(const SeamReport& one, const SeamReport& other) {
    EXPECT_EQ(one.compared_posts, other.compared_posts);
    EXPECT_EQ(one.contradicting_posts, other.contradicting_posts);
    EXPECT_EQ(one.largest_contradiction_m, other.largest_contradiction_m);
    EXPECT_EQ(one.shared_posts, other.shared_posts);
    EXPECT_EQ(one.disagreeing_posts, other.disagreeing_posts);
    EXPECT_EQ(one.largest_difference_m, other.largest_difference_m);
}

TEST(JoinedSurface, IsWhatPostsLaidOneByOneAre) {
    constexpr unsigned seed = 20261128;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    PostGrid grid;
    grid.lat = {1200.0, 47.0, 0, -1, 3};
    grid.lon = {1200.0, 8.0, 0, +1, 1000};
    std::uint64_t filled = 0, shared = 0;
    for (int turn = 0; turn < 200; ++turn) {
        JoinedSurface surface(grid);
        PlainSurface plain{std::vector<PlainSurface::Post>(grid.post_count()), {}};
        for (int source = 0; source < 6; ++source) {
            const int row = static_cast<int>(random() % 3U), first = static_cast<int>(random() % 900U);
            const std::size_t count = 1 + random() % static_cast<unsigned>(grid.columns() - first);
            const bool own_posts = random() % 3U != 0;
            const std::size_t one_void_in = 1 + random() % 500U, one_outside_in = 1 + random() % 2000U;
            std::vector<float> heights(count);
            std::vector<unsigned char> inside(count, 1);
            for (std::size_t c = 0; c < count; ++c) {
                heights[c] =
                    random() % one_void_in == 0 ? void_height_m : 500.0F + static_cast<float>(random() % 40U);
                inside[c] = random() % one_outside_in != 0 ? 1 : 0;
            }
            SeamReport of_source, of_plain;
            std::uint64_t by_posts = 0;
            for (std::size_t c = 0; c < count; ++c)
                if (inside[c] != 0)
                    by_posts +=
                        plain.lay(plain.posts[static_cast<std::size_t>(row * grid.columns() + first) + c],
                                  heights[c], own_posts, of_plain);
            EXPECT_EQ(surface.lay(row, first, heights, inside, own_posts, of_source), by_posts);
            expect_same(of_source, of_plain);
            filled += by_posts;
            shared += of_plain.shared_posts;
        }
        expect_same(surface.seams(), plain.seams);
        for (std::size_t post = 0; post < plain.posts.size(); ++post) {
            ASSERT_EQ(surface.heights()[post], plain.posts[post].height_m) << turn << ": " << post;
            ASSERT_EQ(surface.covered(post), plain.posts[post].covered) << turn << ": " << post;
        }
    }
    EXPECT_GT(filled, 1000U);
    EXPECT_GT(shared, 1000U);
}

}  // namespace
}  // namespace oro
