// What a window says can be seen from a place, against the command viewshed.
#include "apps/window/seen_around.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "apps/commands/commands.h"
#include "apps/commands/sight/sight_ground.h"
#include "apps/options/observers_options.h"
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
        const auto around = seen_around(choice, air, region, *cuts, {}, {}, {});
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
        const Result<void> ran = run_viewshed(options, {}, {});
        const std::string printed = testing::internal::GetCapturedStdout();
        ASSERT_TRUE(ran.ok()) << ran.error().line();
        EXPECT_EQ(printed, around->seen + "\nFrom: " + around->from + "\nLight: " + around->light + "\n");
        const std::string own = (folder / (bends ? "own bent.tif" : "own straight.tif")).string();
        ASSERT_TRUE(write_post_raster(own, false, around->raster).ok());
        EXPECT_TRUE(bytes_in(own) == bytes_in(options.out)) << "the two files differ";
    }
}

// With a canopy the eye and the targets stand on the ground, and the canopy hides, as for the command.
TEST(SeenAround, WithACanopyIsWhatTheCommandWrites) {
    const fs::path folder = test::scratch_folder();
    // 200 x 200 pixels of 0.002 degrees, trees in squares of three.
    const std::string trees = (folder / "trees.asc").string();
    std::ofstream grid(trees);
    grid << "ncols 200\nnrows 200\nxllcorner -84.4\nyllcorner 36.3\ncellsize 0.002\n";
    for (int row = 0; row < 200; ++row)
        for (int column = 0; column < 200; ++column)
            grid << ((row / 3 + column / 3) % 2 == 0 ? 12.5 + (row * 7 + column) % 9 : 0.0)
                 << (column < 199 ? ' ' : '\n');
    grid.close();
    std::ofstream(folder / "trees.prj")
        << R"(GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137,298.257223563]],)"
           R"(PRIMEM["Greenwich",0],UNIT["Degree",0.017453292519943295]])";
    ViewshedOptions options;
    options.region = bundled_region();
    options.at = {"36.512345678,-84.212345678"};
    options.above_m = 40.0;
    options.target_m = 1.75;
    options.radius_km = 5.0;
    options.view.canopy = {trees};
    options.out = (folder / "command.tif").string();
    options.quiet = true;
    testing::internal::CaptureStdout();
    const Result<void> ran = run_viewshed(options, {}, {});
    const std::string printed = testing::internal::GetCapturedStdout();
    ASSERT_TRUE(ran.ok()) << ran.error().line();
    const auto cover = open_sight_cover(options.view);
    ASSERT_TRUE(cover.ok()) << cover.error().line();
    const auto opened = open_sight_ground(
        bundled_region(), [](double, const std::string&) {}, *cover);
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    const Region& raised = (*opened)->canopy->region;
    const auto cuts = cut_regions(raised);
    ASSERT_TRUE(cuts.ok());
    SeenAroundChoice choice{{36.512345678, -84.212345678}, 40.0, 1.75, 5.0, true};
    const auto around = seen_around(choice, standard_air, raised, *cuts, *cover, {}, {});
    ASSERT_TRUE(around.ok()) << around.error().line();
    EXPECT_NE(printed.find(around->seen + "\nFrom: " + around->from), std::string::npos) << printed;
    ASSERT_TRUE(write_post_raster((folder / "own.tif").string(), false, around->raster).ok());
    EXPECT_TRUE(bytes_in(folder / "own.tif") == bytes_in(options.out)) << "the two files differ";
    // Under the trees nobody sees anything.
    choice.above_m = 2.0;
    const auto under = seen_around(choice, standard_air, raised, *cuts, *cover, {}, {});
    ASSERT_FALSE(under.ok());
    EXPECT_NE(under.error().line().find("stands in the canopy"), std::string::npos) << under.error().line();
}

// With probabilities, too: the same seed, the same file.
TEST(SeenAround, WithErrorsOfHeightsIsWhatTheCommandWrites) {
    const fs::path folder = test::scratch_folder();
    const auto opened = open_sight_ground(bundled_region(), [](double, const std::string&) {});
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    const auto cuts = cut_regions((*opened)->region);
    ASSERT_TRUE(cuts.ok());
    SeenAroundChoice choice{{36.512345678, -84.212345678}, 12.5, 1.75, 2.0, true};
    choice.is_probable = true;
    choice.realisations = 6;
    // Nothing is known of the errors of these data.
    EXPECT_FALSE(seen_around(choice, standard_air, (*opened)->region, *cuts, {}, {}, {}).ok());
    choice.le90_m = 10.0;
    double last_share = 0.0;
    const auto around = seen_around(choice, standard_air, (*opened)->region, *cuts, {},
                                    [&](double share) { last_share = share; }, {});
    ASSERT_TRUE(around.ok()) << around.error().line();
    EXPECT_NEAR(last_share, 1.0, 1.0e-12);
    ViewshedOptions options;
    options.region = bundled_region();
    options.at = {"36.512345678,-84.212345678"};
    options.above_m = choice.above_m;
    options.target_m = choice.target_m;
    options.radius_km = choice.radius_km;
    options.out = (folder / "command.tif").string();
    options.quiet = true;
    RealisationOptions realisations;
    realisations.count = 6;
    realisations.le90_m = 10.0;
    testing::internal::CaptureStdout();
    const Result<void> ran = run_viewshed(options, realisations, {});
    const std::string printed = testing::internal::GetCapturedStdout();
    ASSERT_TRUE(ran.ok()) << ran.error().line();
    EXPECT_NE(printed.find(around->probable), std::string::npos) << printed << around->probable;
    ASSERT_TRUE(write_post_raster((folder / "own.tif").string(), false, around->raster).ok());
    EXPECT_TRUE(bytes_in(folder / "own.tif") == bytes_in(options.out)) << "the two files differ";
    // The tint is by the last band.
    const std::vector<float>& share = around->raster.bands.back().values;
    for (std::size_t i = 0; i < share.size(); ++i) {
        if (share[i] == Viewshed::unknown) {
            ASSERT_EQ(around->colours->rgba[i], 0U);
            continue;
        }
        const ProbabilityColour one = colour_of_probability(double{share[i]});
        ASSERT_EQ(around->colours->rgba[i], texel_of(one.rgb[0], one.rgb[1], one.rgb[2], one.alpha));
    }
}

TEST(SeenAround, WithErrorsOfHeightsEndsSoonWhenAsked) {
    const auto opened = open_sight_ground(bundled_region(), [](double, const std::string&) {});
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    const auto cuts = cut_regions((*opened)->region);
    ASSERT_TRUE(cuts.ok());
    SeenAroundChoice choice{{36.5, -84.2}, 2.0, 0.0, 2.0, true};
    choice.is_probable = true;
    choice.realisations = most_realisations;
    choice.le90_m = 10.0;
    std::stop_source stop;
    int calls = 0;
    const auto around = seen_around(
        choice, standard_air, (*opened)->region, *cuts, {},
        [&](double share) {
            if (share > 2.0 / most_realisations && ++calls == 3) stop.request_stop();
        },
        stop.get_token());
    EXPECT_FALSE(around.ok());
    EXPECT_LT(calls, 100);
}

TEST(SeenAround, ColoursOfProbabilityEndAtThoseOfWhatIsHiddenAndSeen) {
    EXPECT_EQ(colour_of_probability(0.0).rgb, (std::array<std::uint8_t, 3>{16, 22, 44}));
    EXPECT_EQ(colour_of_probability(1.0).rgb, (std::array<std::uint8_t, 3>{255, 176, 32}));
    for (double share = 0.05; share <= 1.0; share += 0.05)
        EXPECT_GT(colour_of_probability(share).rgb[0], colour_of_probability(share - 0.05).rgb[0]);
}

TEST(SeenAround, HasColoursWhereItsFileHasValues) {
    const auto opened = open_sight_ground(bundled_region(), [](double, const std::string&) {});
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    const auto cuts = cut_regions((*opened)->region);
    ASSERT_TRUE(cuts.ok());
    double last_share = 0.0;
    const auto around = seen_around({{36.5, -84.2}, 2.0, 0.0, 3.0, true}, standard_air, (*opened)->region,
                                    *cuts, {}, [&](double share) { last_share = share; }, {});
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
                                    *cuts, {}, {}, stop.get_token());
    EXPECT_FALSE(around.ok());
    const auto nowhere =
        seen_around({{0.0, 0.0}, 2.0, 0.0, 20.0, true}, standard_air, (*opened)->region, *cuts, {}, {}, {});
    ASSERT_FALSE(nowhere.ok());
    EXPECT_EQ(nowhere.error().kind, ErrorKind::no_data);
}

}  // namespace
}  // namespace oro
