// Grids around the whole Earth, wherever they begin.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {

namespace fs = std::filesystem;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;

// The same heights from -180 to 180 degrees and from 0 to 360: the same picture, wherever the eye is.
TEST(WorldGrids, GiveOnePictureWhereverTheyBegin) {
    const auto extremes = oro::test::real_data("extremes");
    if (!extremes) GTEST_SKIP() << "needs extremes";
    const fs::path data = *extremes / "ETOPO1_1deg_global.tif";
    const fs::path folder = oro::test::scratch_folder();
    const auto run = [](const std::vector<std::string>& words) {
        const Outcome outcome = run_program(words);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    };
    const std::string east = folder / "east.tif", west = folder / "west.tif", moved = folder / "moved.tif",
                      both = folder / "both.vrt", turned = folder / "turned.tif";
    run({"gdal_translate", "-q", "-srcwin", "180", "0", "181", "181", data, east});
    run({"gdal_translate", "-q", "-srcwin", "0", "0", "181", "181", data, west});
    run({"gdal_translate", "-q", "-a_ullr", "179.5", "90.5", "360.5", "-90.5", west, moved});
    run({"gdalbuildvrt", "-q", both, east, moved});
    run({"gdal_translate", "-q", both, turned});
    for (const char* place : {"20,-170", "46,8", "10,179.7", "0,0", "-85,-0.2"}) {
        std::vector<std::string> pixels;
        for (const std::string& file : {data.string(), turned}) {
            const fs::path picture = folder / "world.png";
            const Outcome drawn =
                run_orograph({"shot", file, "--at", place, "--altitude", "300000", "--pitch", "-30",
                              "--heading", "80", "--size", "160x120", "--out", picture, "--overwrite", "-q"});
            ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
            const auto view = nlohmann::json::parse(oro::test::view_in(picture));
            pixels.push_back(view["fingerprints"]["pixels"].get<std::string>());
        }
        EXPECT_EQ(pixels[0], pixels[1]) << place;
    }
}

}  // namespace
