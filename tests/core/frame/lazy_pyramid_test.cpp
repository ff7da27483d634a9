// Nodes chosen from pages that are read one by one: those that a whole pyramid gives.
#include "core/frame/lazy_pyramid.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "core/lod/levels.h"
#include "tests/core/lod/pyramid_region.h"

namespace oro {
namespace {

using test::Region, test::patchy_field, test::random_camera, test::whole, test::taus_px;

TEST(LazyPyramid, GiveTheNodesOfAPyramid) {
    HeightField with_voids = patchy_field(420, 470);
    for (int row = 130; row < 200; ++row)
        for (int column = 129; column < 256; ++column)
            with_voids.H_m[static_cast<std::size_t>(row * 470 + column)] = void_height_m;
    const Region regions[] = {Region(patchy_field(600, 521)), Region(std::move(with_voids))};
    std::mt19937_64 random(310);
    std::size_t asked = 0, all = 0, drawn = 0;
    for (const Region& region : regions) {
        const std::unique_ptr<RegionPages> pages = pages_in_memory(region.field, 1.0, 2);
        std::size_t count = 0;
        for (const PyramidLevel& level : region.pyramid.levels) count += level.pages.size();
        for (int i = 0; i < 60; ++i) {
            const Camera camera = random_camera(random, region);
            const double tau_px = taus_px[i % 3];
            const LazyPyramid from(*pages);
            const NodeSelection found = select_nodes(from, camera, whole(camera), tau_px);
            const NodeSelection expected = select_nodes(region.pyramid, camera, whole(camera), tau_px);
            ASSERT_EQ(found.nodes.size(), expected.nodes.size()) << i;
            for (std::size_t j = 0; j < found.nodes.size(); ++j) {
                const DrawnNode &a = found.nodes[j], &b = expected.nodes[j];
                ASSERT_TRUE(a.level == b.level && a.row == b.row && a.column == b.column &&
                            a.edges == b.edges)
                    << i << ": node " << j;
            }
            EXPECT_EQ(found.pages_seen, expected.pages_seen);
            EXPECT_TRUE(from.health().ok());
            asked += from.kept();
            all += count;
            drawn += found.nodes.size();
        }
    }
    EXPECT_GT(drawn, 10000U);
    // Those that cannot be seen are not read.
    EXPECT_LT(2 * asked, all);
}

// Of pages whose file is damaged.
class PagesOfDamage : public RegionPages {
  public:
    explicit PagesOfDamage(const RegionPages& pages) : RegionPages(pages.facts()), pages_(pages) {}
    [[nodiscard]] Result<PageRecord> record(const PageIndex& page) const override {
        return pages_.record(page);
    }
    Result<void> load(const PageIndex& page, gpu::PageBlock& block) const override {
        if (page.level == 0) return Error{ErrorKind::failed, "a.oro", "is damaged"};
        return pages_.load(page, block);
    }

  private:
    const RegionPages& pages_;
};

TEST(LazyPyramid, TellOfDamage) {
    const Region region(patchy_field(300, 280));
    const std::unique_ptr<RegionPages> pages = pages_in_memory(region.field, 1.0, 2);
    const PagesOfDamage damaged(*pages);
    std::mt19937_64 random(311);
    const Camera camera = random_camera(random, region);
    const LazyPyramid from(damaged);
    const NodeSelection found = select_nodes(from, camera, whole(camera), 0.0);
    EXPECT_TRUE(found.nodes.empty());
    ASSERT_FALSE(from.health().ok());
    EXPECT_EQ(from.health().error().line(), "a.oro: is damaged");
}

}  // namespace
}  // namespace oro
