// What is told where pixels cannot be coloured by means of the ground.
#include <gtest/gtest.h>

#include <memory>

#include "apps/drawing/region_scene.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

// As of a baked region with too many posts, which would take gigabytes.
class PagesWithoutMeans : public RegionPages {
  public:
    using RegionPages::RegionPages;
    [[nodiscard]] Result<PageRecord> record(const PageIndex&) const override { return PageRecord{}; }
    Result<void> load(const PageIndex&, gpu::PageBlock&) const override { return {}; }
};

TEST(NoteOfMissingFootprints, IsGivenWhereTheyAreAskedForAndNotKnown) {
    const HeightField field = test::rough_field(46.0, 8.0, 40, 50);
    const std::unique_ptr<RegionPages> known = pages_in_memory(field, 1.0, 1);
    const PagesWithoutMeans unknown(known->facts());
    gpu::FrameStyle style{};
    style.footprint = gpu::footprint_mean;
    EXPECT_EQ(note_of_missing_footprints(style, *known), "");
    EXPECT_EQ(
        note_of_missing_footprints(style, unknown),
        "note: the region has 2,000 posts, too many to colour pixels by the mean of the ground that they "
        "cover: each has the colour of the ground in its middle");
    style.footprint = gpu::footprint_point;
    EXPECT_EQ(note_of_missing_footprints(style, unknown), "");
}

}  // namespace
}  // namespace oro
