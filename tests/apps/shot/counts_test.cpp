// What five views of the bundled region take at the default tau: counts that a change of code must not raise
// unseen. Bounds lie 3 % above what was counted when they were set.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;

struct Counted {
    const char* name;
    std::vector<std::string> view;
    int triangles;
    int mesh_workgroups;  // of two meshlets each on the software driver
    int pages;            // on the GPU
};

class Counts : public ::testing::TestWithParam<Counted> {};

TEST_P(Counts, StayWithinTheirBounds) {
    const fs::path picture = oro::test::scratch_folder() / "counted.png";
    std::vector<std::string> words{"shot",          (oro::test::bundled_data() / "jacksboro.tif").string(),
                                   "--size",        "320x180",
                                   "--overwrite",   "-q",
                                   "--json",        "--pipeline",
                                   "mesh",          "--out",
                                   picture.string()};
    words.insert(words.end(), GetParam().view.begin(), GetParam().view.end());
    const auto outcome = oro::test::run_orograph(words);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto said = nlohmann::json::parse(outcome.out);
    const auto within = [](const nlohmann::json& counted, int bound, const char* what) {
        EXPECT_LE(counted.get<double>(), bound) << what;
        EXPECT_GT(counted.get<double>(), 0.5 * bound) << what << ": the bound is too loose now";
    };
    EXPECT_TRUE(said["settled"].get<bool>());
    within(said["triangles"]["drawn"], GetParam().triangles, "triangles");
    within(said["meshlets"]["mesh_workgroups"], GetParam().mesh_workgroups, "mesh workgroups");
    within(said["pages"]["on_gpu"], GetParam().pages, "pages");
}

INSTANTIATE_TEST_SUITE_P(
    Jacksboro, Counts,
    ::testing::Values(  // from where the whole region was seen when it was counted
        Counted{"overview",
                {"--at", "geo:36.31908402195145,-84.24583444757508,19462.21847260557", "--pitch",
                 "-32.27179029236471"},
                20087,
                85,
                11},
        Counted{"valley",
                {"--at", "36.47,-84.27", "--above", "300", "--heading", "50", "--pitch", "-8"},
                43882,
                181,
                14},
        Counted{
            "edge",
            {"--at", "36.6,-84.38", "--above", "1500", "--heading", "250", "--pitch", "-15", "--roll", "10"},
            3164,
            13,
            3},
        Counted{"from_space",
                {"--at", "36.5,-84.2", "--altitude", "2000000", "--pitch", "-89", "--fov", "4"},
                17893,
                74,
                1},
        Counted{"nadir",
                {"--at", "36.5,-84.2", "--altitude", "30000", "--pitch", "-90", "--sun", "90,20"},
                11880,
                50,
                13}),
    [](const auto& counted) { return std::string(counted.param.name); });

}  // namespace
