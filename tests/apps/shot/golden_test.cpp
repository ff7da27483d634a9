// Golden pictures of the bundled region on the software driver: what a change of code must not change unseen.
// To make them anew after a wanted change, run with OROGRAPH_WRITE_GOLDENS=1 and look at every one.
#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::Pixels;
using oro::test::pixels_of;

constexpr int largest_difference = 3;              // of 255, in any channel, for a pixel to count as the same
constexpr double largest_share_differing = 0.002;  // of all pixels

struct Golden {
    const char* name;
    std::vector<std::string> view;
};

class GoldenPicture : public ::testing::TestWithParam<Golden> {
  protected:
    void draw(const char* pipeline);
};

// By both ways of drawing: auto may choose either.
TEST_P(GoldenPicture, IsDrawnAsItWas) {
    draw("mesh");
}
TEST_P(GoldenPicture, IsDrawnAsItWasByCompute) {
    if (std::getenv("OROGRAPH_WRITE_GOLDENS")) GTEST_SKIP() << "goldens are drawn by mesh shaders";
    draw("compute");
}

void GoldenPicture::draw(const char* pipeline) {
    const fs::path golden =
        oro::test::bundled_data() / ".." / "tests" / "goldens" / (std::string(GetParam().name) + ".png");
    const bool write = std::getenv("OROGRAPH_WRITE_GOLDENS") != nullptr;
    const fs::path drawn = write ? golden : oro::test::scratch_folder() / "drawn.png";
    std::vector<std::string> words{"shot",   "jacksboro.tif",        "--size",      "320x180",
                                   "--time", "2026-01-01T00:00:00Z", "--overwrite", "-q",
                                   "--out",  drawn.string(),         "--pipeline",  pipeline};
    words.insert(words.end(), GetParam().view.begin(), GetParam().view.end());
    // Named as seen from its folder: a picture carries the names of its sources, and a golden must not carry
    // a machine's.
    oro::test::Circumstances in_data;
    in_data.folder = oro::test::bundled_data();
    in_data.environment = {"OROGRAPH_VALIDATION=1"};
    const auto outcome = oro::test::run_orograph(words, in_data);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    if (write) FAIL() << "wrote " << golden << ": look at it, then run without OROGRAPH_WRITE_GOLDENS";
    const Pixels is = pixels_of(drawn), was = pixels_of(golden);
    ASSERT_GT(was.width, 0U) << golden << " cannot be read";
    ASSERT_EQ(is.width, was.width);
    ASSERT_EQ(is.height, was.height);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < is.rgb.size(); i += 3) {
        int most = 0;
        for (std::size_t c = i; c < i + 3; ++c)
            most = std::max(most, std::abs(int{is.rgb[c]} - int{was.rgb[c]}));
        differing += most > largest_difference ? 1U : 0U;
    }
    EXPECT_LE(static_cast<double>(differing),
              largest_share_differing * static_cast<double>(is.rgb.size() / 3))
        << differing << " pixels differ by more than " << largest_difference;
}

// Over the whole region, from where it was seen without --at when these were drawn.
std::vector<std::string> overview(const char* at, const char* pitch, std::vector<std::string> more) {
    more.insert(more.end(), {"--at", at, "--pitch", pitch});
    return more;
}
constexpr const char* high = "geo:36.31908402195145,-84.24583444757508,19462.21847260557";
constexpr const char* high_pitch = "-32.27179029236471";

INSTANTIATE_TEST_SUITE_P(
    Jacksboro, GoldenPicture,
    ::testing::Values(
        Golden{"levels_overview", overview(high, high_pitch, {})},
        Golden{"levels_valley",
               {"--at", "36.47,-84.27", "--above", "300", "--heading", "50", "--pitch", "-8"}},
        Golden{"levels_coarse", overview(high, high_pitch, {"--tau", "6"})},
        Golden{"overview", overview("geo:36.319084019283,-84.2458344475751,19462.21865897812",
                                    "-32.27179029503319", {"--tau", "0"})},
        Golden{"overview_samples",
               overview("geo:36.315628163967396,-84.24583555921514,20236.995972077362", "-32.27524615065357",
                        {"--tau", "0", "--samples", "8", "--exaggeration", "2"})},
        Golden{"valley",
               {"--tau", "0", "--at", "36.47,-84.27", "--above", "300", "--heading", "50", "--pitch", "-8"}},
        Golden{"edge",
               {"--tau", "0", "--at", "36.6,-84.38", "--above", "1500", "--heading", "250", "--pitch", "-15",
                "--roll", "10"}},
        Golden{"from_space",
               {"--tau", "0", "--at", "36.5,-84.2", "--altitude", "2000000", "--pitch", "-89", "--fov", "4"}},
        Golden{
            "nadir",
            {"--tau", "0", "--at", "36.5,-84.2", "--altitude", "30000", "--pitch", "-90", "--sun", "90,20"}}),
    [](const auto& golden) { return std::string(golden.param.name); });

}  // namespace
