// Another region, read while a window goes on.
#include "apps/window/region_opening.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "tests/support/test_data.h"

namespace {

oro::WindowOptions options_of(const std::string& path) {
    oro::WindowOptions options;
    options.region.paths = {path};
    options.view.size = "160x90";
    options.quiet = true;
    return options;
}

TEST(RegionOpening, ReadsInTheBackground) {
    oro::RegionOpening opening(options_of((oro::test::bundled_data() / "jacksboro.tif").string()), {});
    EXPECT_EQ(opening.name(), "jacksboro.tif");
    for (int i = 0; i < 6000 && !opening.ready(); ++i) {
        EXPECT_GE(opening.share(), 0.0);
        EXPECT_LE(opening.share(), 1.0);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ASSERT_TRUE(opening.ready());
    EXPECT_FALSE(opening.step().empty());
    auto opened = opening.wait();
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    ASSERT_EQ(opened->region.grids.size(), 1U);
    ASSERT_EQ(opened->pages.size(), 1U);
    EXPECT_EQ(opened->view.camera.width_px, 160);
    EXPECT_EQ(opened->options.region.paths.size(), 1U);
}

TEST(RegionOpening, TellsWhatCannotBeOpened) {
    oro::RegionOpening opening(options_of((oro::test::scratch_folder() / "none.tif").string()), {});
    const auto opened = opening.wait();
    ASSERT_FALSE(opened.ok());
    EXPECT_NE(opened.error().line().find("none.tif"), std::string::npos) << opened.error().line();
}

}  // namespace
