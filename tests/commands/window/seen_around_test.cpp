// What a window says can be seen from a place, against the command viewshed.
#include "apps/window/seen_around.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "apps/commands/commands.h"
#include "apps/commands/sight/sight_ground.h"
#include "apps/options/realisation_options.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

std::string bytes_in(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

RegionOptions bundled_region() {
    RegionOptions region;
    region.paths = {(test::bundled_data() / "jacksboro.tif").string()};
    return region;
}

TEST(SeenAround, IsWhatTheCommandPrintsAndWrites) {
    const fs::path folder = test::scratch_folder();
    const auto opened = open_sight_ground(bundled_region(), [](double, const std::string&) {});
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    const Region& region = (*opened)->region;
    const auto cuts = cut_regions(region);
    ASSERT_TRUE(cuts.ok());
    for (const bool bends : {true, false}) {
        SeenAroundChoice choice{{36.512345678, -84.212345678}, 12.5, 1.75, 6.0, bends};
        const Air air = air_around(choice, Air{});
        const auto around = seen_around(choice, air, region, *cuts, {}, {});
        ASSERT_TRUE(around.ok()) << around.error().line();
        ViewshedOptions options;
        options.region = bundled_region();
        options.at = {"36.512345678,-84.212345678"};
        EXPECT_EQ(at_text(choice.place), options.at.front());
        options.above_m = choice.above_m;
        options.target_m = choice.target_m;
        options.radius_km = choice.radius_km;
        if (!bends) options.view.refraction_k = 0.0;
        options.out = (folder / (bends ? "bent.tif" : "straight.tif")).string();
        options.quiet = true;
        testing::internal::CaptureStdout();
        const Result<void> ran = run_viewshed(options, {});
        const std::string printed = testing::internal::GetCapturedStdout();
        ASSERT_TRUE(ran.ok()) << ran.error().line();
        EXPECT_EQ(printed, around->seen + "\nFrom: " + around->from + "\nLight: " + around->light + "\n");
        const std::string own = (folder / (bends ? "own bent.tif" : "own straight.tif")).string();
        ASSERT_TRUE(write_post_raster(own, false, around->raster).ok());
        EXPECT_TRUE(bytes_in(own) == bytes_in(options.out)) << "the two files differ";
    }
}

TEST(SeenAround, HasColoursWhereItsFileHasValues) {
    const auto opened = open_sight_ground(bundled_region(), [](double, const std::string&) {});
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    const auto cuts = cut_regions((*opened)->region);
    ASSERT_TRUE(cuts.ok());
    double last_share = 0.0;
    const auto around = seen_around({{36.5, -84.2}, 2.0, 0.0, 3.0, true}, standard_air, (*opened)->region,
                                    *cuts, [&](double share) { last_share = share; }, {});
    ASSERT_TRUE(around.ok()) << around.error().line();
    EXPECT_EQ(last_share, 1.0);
    const std::vector<float>& seen = around->raster.bands.front().values;
    const std::vector<std::uint32_t>& colours = around->colours->rgba;
    ASSERT_EQ(seen.size(), colours.size());
    std::uint32_t bright = 0, dark = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (seen[i] == Viewshed::unknown) {
            ASSERT_EQ(colours[i], 0U);
            continue;
        }
        std::uint32_t& colour = seen[i] > 0.0F ? bright : dark;
        if (colour == 0) colour = colours[i];
        ASSERT_EQ(colours[i], colour);
    }
    EXPECT_NE(bright, dark);
    EXPECT_NE(bright, 0U);
    EXPECT_NE(dark, 0U);
}

TEST(SeenAround, StopsWhenItIsAsked) {
    const auto opened = open_sight_ground(bundled_region(), [](double, const std::string&) {});
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    const auto cuts = cut_regions((*opened)->region);
    ASSERT_TRUE(cuts.ok());
    std::stop_source stop;
    stop.request_stop();
    const auto around = seen_around({{36.5, -84.2}, 2.0, 0.0, 20.0, true}, standard_air, (*opened)->region,
                                    *cuts, {}, stop.get_token());
    EXPECT_FALSE(around.ok());
    const auto nowhere =
        seen_around({{0.0, 0.0}, 2.0, 0.0, 20.0, true}, standard_air, (*opened)->region, *cuts, {}, {});
    ASSERT_FALSE(nowhere.ok());
    EXPECT_EQ(nowhere.error().kind, ErrorKind::no_data);
}

}  // namespace
}  // namespace oro
