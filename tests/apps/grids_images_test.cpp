// Images over files that lie over each other: on the same places of each, and on the steps between them.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {

namespace fs = std::filesystem;
using oro::test::Pixels;
using oro::test::pixels_of;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::Words;

class GridsUnderImages : public ::testing::Test {
  protected:
    // A tile, a part of it in UTM as it is, and one that is higher; its heights as an image.
    void SetUp() override {
        folder_ = oro::test::scratch_folder();
        coarse_ = (oro::test::bundled_data() / "jacksboro.tif").string();
        same_ = folder_ / "same.tif";
        raised_ = folder_ / "raised.tif";
        grey_ = folder_ / "grey.tif";
        red_ = folder_ / "red.tif";
        run({"gdalwarp", "-q", "-t_srs", "EPSG:32616", "-te", "742000", "4046000", "747000", "4051000", "-tr",
             "20", "20", "-r", "bilinear", "-ot", "Float32", coarse_, same_});
        run({"gdal_translate", "-q", "-scale", "0", "1000", "80", "1080", same_, raised_});
        const Words bands{
            "gdal_translate", "-q",        "-ot", "Byte", "-b", "1", "-b", "1", "-b", "1", "-colorinterp",
            "red,green,blue", "-a_nodata", "none"};
        Words grey = bands, red = bands;
        grey.insert(grey.end(), {"-scale", "200", "1000", "0", "255", coarse_, grey_});
        red.insert(red.end(), {"-scale_1", "0", "2000", "255", "255", "-scale_2", "0", "2000", "0", "0",
                               "-scale_3", "0", "2000", "0", "0", coarse_, red_});
        run(grey);
        run(red);
    }
    static void run(const Words& words) {
        const auto outcome = run_program(words);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    }
    // From above one side of the part, looking over it: from row 60 on there is no sky.
    Pixels drawn(const Words& files, const std::string& image, const Words& more = {}) const {
        const std::string out = folder_ / "drawn.png";
        Words words{"shot"};
        words.insert(words.end(), files.begin(), files.end());
        words.insert(words.end(),
                     {"-q", "--at", "36.535,-84.33", "--above", "1800", "--look-at", "36.56,-84.265", "--fov",
                      "30", "--size", "320x180", "--style", "default", "--overwrite", "--out", out});
        if (!image.empty()) words.insert(words.end(), {"--drape", image});
        words.insert(words.end(), more.begin(), more.end());
        const auto outcome = run_orograph(words);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return pixels_of(out);
    }
    static double mean_difference(const Pixels& a, const Pixels& b) {
        EXPECT_EQ(a.rgb.size(), b.rgb.size());
        double sum = 0.0;
        for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(int{a.rgb[i]} - int{b.rgb[i]});
        return sum / static_cast<double>(a.rgb.size());
    }
    fs::path folder_;
    std::string coarse_, same_, raised_, grey_, red_;
};

// What the finer grid is made of is the coarser one: with its image, too, the pictures are nearly the same.
TEST_F(GridsUnderImages, LieOnTheSamePlaces) {
    for (const char* pipeline : {"mesh", "compute"}) {
        const Words by{"--pipeline", pipeline};
        const Pixels one = drawn({coarse_}, grey_, by), both = drawn({coarse_, same_}, grey_, by),
                     bare = drawn({coarse_, same_}, "", by);
        const double off = mean_difference(one, both), image = mean_difference(both, bare);
        std::printf("%s: mean difference %.2f of 255; of the image itself %.2f\n", pipeline, off, image);
        EXPECT_LT(off, 3.0) << pipeline;
        EXPECT_GT(image, 15.0) << pipeline;
    }
}

// The step of 80 m has the image's colour, as all ground has.
TEST_F(GridsUnderImages, CoverTheStepsBetweenThem) {
    for (const char* tau : {"0", "2"}) {
        const Pixels picture = drawn({coarse_, raised_}, red_, {"--tau", tau});
        int other = 0;
        for (std::size_t i = std::size_t{3} * 320 * 60; i < picture.rgb.size(); i += 3)
            other += picture.rgb[i] < 2 * picture.rgb[i + 1] + 10 ? 1 : 0;
        EXPECT_EQ(other, 0) << "pixels that are not red, tau " << tau;
    }
}

}  // namespace
