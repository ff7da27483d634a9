// Maps of what a window shows.
#include "apps/window/maps.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace oro {
namespace {

TEST(Maps, HaveTheGroundThatIsSeenWithoutWhatIsVeryFar) {
    EXPECT_FALSE(box_of_places({}).has_value());
    // The last one is more than three times as far as the median, 3,000 m.
    const auto box = box_of_places({{46.50, 8.00, 1000.0},
                                    {46.55, 7.95, 2000.0},
                                    {46.60, 8.05, 3000.0},
                                    {46.62, 8.10, 8900.0},
                                    {47.9, 9.9, 9100.0}});
    ASSERT_TRUE(box.has_value());
    EXPECT_NEAR(box->west_deg, 7.95, 1e-12);
    EXPECT_NEAR(box->south_deg, 46.50, 1e-12);
    EXPECT_NEAR(box->east_deg, 8.10, 1e-12);
    EXPECT_NEAR(box->north_deg, 46.62, 1e-12);
}

TEST(Maps, GoOverThe180thMeridianAndAreNeverEmpty) {
    const auto box = box_of_places({{-17.0, 179.9, 10.0}, {-16.9, -179.8, 20.0}});
    ASSERT_TRUE(box.has_value());
    EXPECT_NEAR(box->west_deg, 179.9, 1e-9);
    EXPECT_NEAR(box->east_deg, -179.8, 1e-9);
    const auto one = box_of_places({{0.0, 0.0, 1.0}});
    ASSERT_TRUE(one.has_value());
    EXPECT_NEAR(one->east_deg - one->west_deg, 0.002, 1e-12);
    EXPECT_NEAR(one->north_deg - one->south_deg, 0.002, 1e-12);
}

TEST(Maps, AreAskedForInWordsThatMapsTake) {
    View view;
    view.region.paths = {"N46E008.hgt"};
    view.style = "plain";
    view.vectors.overlay = {"track.gpx"};
    view.samples = 4;
    MapChoice choice;
    choice.box = "8,46.5,8.1,46.6";
    choice.resolution_m = 20.0;
    const auto words = map_words(view, choice, "map.tif");
    const std::vector<std::string> expected{"shot",    "N46E008.hgt", "--bbox",  "8,46.5,8.1,46.6",
                                            "--style", "plain",       "--ortho", "--resolution",
                                            "20",      "--out",       "map.tif"};
    EXPECT_EQ(words, expected);
    choice.contours = true;
    choice.resolution_m = 0.0;
    const auto lines = map_words(view, choice, "map.tif");
    EXPECT_EQ(std::ranges::count(lines, std::string("contours")), 1);
    EXPECT_EQ(std::ranges::count(lines, std::string("--resolution")), 0);
}

}  // namespace
}  // namespace oro
