// What the program says of data that are not what the user thinks: tags in another alphabet, holes of three
// kinds, places where there are no data.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::Outcome;
using oro::test::run_orograph;
using Words = std::vector<std::string>;

std::string bundled() {
    return (oro::test::bundled_data() / "jacksboro.tif").string();
}

TEST(RegionWords, ACopyrightThatIsNoUtf8IsDrawnWithItsBadByteReplaced) {
    const fs::path folder = oro::test::scratch_folder();
    std::string raster = bytes_of(bundled());
    const std::size_t at = raster.find("USGS, public domain");
    ASSERT_NE(at, std::string::npos);
    raster[at] = '\xA9';  // (c) in Latin-1
    oro::test::write_bytes(folder / "latin.tif", raster);
    const std::string shown = "\xEF\xBF\xBDSGS, public domain";
    for (const char* picture : {"a.png", "b.jpg", "c.tif"}) {
        const Outcome shot = run_orograph(
            {"shot", folder / "latin.tif", "--size", "64x48", "--json", "-q", "--out", folder / picture});
        ASSERT_EQ(shot.exit_code, 0) << picture << shot.err;
        EXPECT_EQ(json::parse(shot.out)["attribution"], shown);
    }
    const Outcome bake = run_orograph({"bake", folder / "latin.tif", "--out", folder / "latin.oro", "-q"});
    EXPECT_EQ(bake.exit_code, 0) << bake.err;
    const Outcome info = run_orograph({"info", folder / "latin.oro", "--json"});
    ASSERT_EQ(info.exit_code, 0) << info.err;
    EXPECT_EQ(json::parse(info.out)["sources"][0]["attribution"], shown);
}

}  // namespace
