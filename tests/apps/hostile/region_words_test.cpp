// What the program says of data that are not what the user thinks: tags in another alphabet, holes of three
// kinds, places where there are no data.
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::Words;

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

// 1,000 m everywhere.
std::string tile() {
    std::string posts;
    for (int i = 0; i < 1201 * 1201; ++i) posts += "\x03\xe8";
    return posts;
}

TEST(RegionWords, AViewOfAnotherPlaceIsRefusedAndTheSkyIsNoted) {
    const fs::path folder = oro::test::scratch_folder();
    oro::test::write_bytes(folder / "N46E008.hgt", tile());
    const Outcome here = run_orograph({"shot", bundled(), "--at", "36.6,-84.2", "--above", "30", "--size",
                                       "64x48", "--out", folder / "here.png"});
    ASSERT_EQ(here.exit_code, 0) << here.err;
    const Outcome there = run_orograph(
        {"shot", folder / "N46E008.hgt", "--view", folder / "here.png", "--out", folder / "there.png"});
    expect_refusal(there, 3, {"nothing of the region is in view", "8,46,9,47"});
    EXPECT_FALSE(fs::exists(folder / "there.png"));
    const Outcome sky = run_orograph({"shot", bundled(), "--at", "36.6,-84.2", "--above", "30000", "--pitch",
                                      "60", "--fov", "20", "--size", "64x48", "--out", folder / "sky.png"});
    EXPECT_EQ(sky.exit_code, 0) << sky.err;
    EXPECT_NE(sky.err.find("nothing of the region is in view"), std::string::npos) << sky.err;
    EXPECT_EQ(here.err.find("nothing"), std::string::npos) << here.err;
    // Pages near the eye may be in such a view, and no pixel of theirs.
    const Outcome near = run_orograph({"shot", bundled(), "--at", "36.6,-84.2", "--above", "300", "--pitch",
                                       "60", "--fov", "20", "--size", "64x48", "--out", folder / "near.png"});
    EXPECT_NE(near.err.find("nothing of the region is in view"), std::string::npos) << near.err;
    expect_refusal(run_orograph({"compare", folder / "here.png", folder / "N46E008.hgt"}), 3,
                   {"nothing of the region is in view", "8,46,9,47"});
    const Outcome compared = run_orograph({"compare", folder / "near.png"});
    EXPECT_EQ(compared.exit_code, 0) << compared.err;
    EXPECT_NE(compared.err.find("nothing of the region is in view"), std::string::npos) << compared.err;
}

TEST(RegionWords, APlaceWithoutDataHearsOfTheirBoxAndOfSwappedCoordinates) {
    const fs::path folder = oro::test::scratch_folder();
    oro::test::write_bytes(folder / "N46E008.hgt", tile());
    const auto shoot = [&](const Words& more) {
        Words words{"shot", folder / "N46E008.hgt", "--size", "64x48", "--out", folder / "a.png"};
        words.insert(words.end(), more.begin(), more.end());
        return run_orograph(words);
    };
    expect_refusal(shoot({"--at", "8.5,46.5", "--above", "3"}), 3,
                   {"no elevation data there", "8,46,9,47", "46.500000,8.500000 lies inside"});
    const Outcome far = shoot({"--at", "12.5,46.5", "--above", "3"});
    expect_refusal(far, 3, {"no elevation data there", "8,46,9,47"});
    EXPECT_EQ(far.err.find("lies inside"), std::string::npos) << far.err;
    expect_refusal(shoot({"--at", "46.5,8.5", "--look-at", "8.5,46.5"}), 3, {"--look-at", "lies inside"});
}

// Tiles with 3 x 3 void posts, and a missing tile between them.
TEST(RegionWords, VoidsAndMissingTilesAreCountedApart) {
    const fs::path folder = oro::test::scratch_folder();
    fs::create_directory(folder / "tiles");
    std::string holed = tile();
    for (int row = 600; row < 603; ++row)
        for (int column = 600; column < 603; ++column)
            holed.replace(2 * static_cast<std::size_t>(row * 1201 + column), 2, std::string("\x80\0", 2));
    oro::test::write_bytes(folder / "tiles" / "N46E008.hgt", holed);
    oro::test::write_bytes(folder / "tiles" / "N46E010.hgt", tile());
    const std::string baked = folder / "a.oro";
    ASSERT_EQ(run_orograph({"bake", folder / "tiles", "--out", baked, "-q"}).exit_code, 0);
    for (const std::string& from : {(folder / "tiles").string(), baked}) {
        const Outcome info = run_orograph({"info", from, "--json", "-q"});
        ASSERT_EQ(info.exit_code, 0) << info.err;
        const json region = json::parse(info.out)["region"];
        EXPECT_EQ(region["voids"], 9);
        EXPECT_EQ(region["outside_sources"], 0);
        EXPECT_EQ(region["in_missing_cells"], 1199 * 1201);
        EXPECT_EQ(region["missing_cells"], json::array({"N46E009"}));
    }
    const Outcome shot = run_orograph({"shot", baked, "--size", "64x48", "--out", folder / "a.png"});
    EXPECT_EQ(shot.exit_code, 0) << shot.err;
    EXPECT_NE(shot.err.find("9 void posts are holes (baking with --fill-voids"), std::string::npos)
        << shot.err;
    EXPECT_NE(shot.err.find("1 tile is missing: 1,439,999 posts have no height there"), std::string::npos)
        << shot.err;
    // Where no post is void, filling is not offered.
    fs::remove(folder / "tiles" / "N46E008.hgt");
    oro::test::write_bytes(folder / "tiles" / "N46E008.hgt", tile());
    const Outcome whole =
        run_orograph({"shot", folder / "tiles", "--size", "64x48", "--out", folder / "b.png"});
    EXPECT_EQ(whole.err.find("--fill-voids"), std::string::npos) << whole.err;
}

// A file of more posts than any machine holds, in a folder with others: all are told by their headers.
TEST(RegionWords, FilesThatMakeNoRegionAreToldOneByOne) {
    const fs::path folder = oro::test::scratch_folder() / "tiles";
    fs::create_directory(folder);
    for (const char* const name : {"N00E000.hgt", "S80W170.hgt"})
        oro::test::write_bytes(folder / name, tile());
    oro::test::write_bytes(folder / "huge.vrt",
                           "<VRTDataset rasterXSize='400000' rasterYSize='400000'><SRS>EPSG:4326</SRS>"
                           "<GeoTransform>-10, 0.00001, 0, 50, 0, -0.00001</GeoTransform>"
                           "<VRTRasterBand dataType='Int16' band='1'><SimpleSource>"
                           "<SourceFilename relativeToVRT='0'>" +
                               oro::test::bundled() +
                               "</SourceFilename><SourceBand>1</SourceBand>"
                               "<SrcRect xOff='0' yOff='0' xSize='300' ySize='300'/>"
                               "<DstRect xOff='0' yOff='0' xSize='400000' ySize='400000'/>"
                               "</SimpleSource></VRTRasterBand></VRTDataset>");
    const Outcome reported = run_orograph({"info", folder});
    EXPECT_EQ(reported.exit_code, 1);
    for (const char* name : {"N00E000.hgt", "huge.vrt", "S80W170.hgt"})
        EXPECT_NE(reported.out.find(name), std::string::npos) << reported.out;
    EXPECT_NE(reported.out.find("H not read"), std::string::npos) << reported.out;
    EXPECT_NE(reported.err.find("region too large: the region would have 400000 x 400000"), std::string::npos)
        << reported.err;
    EXPECT_NE(reported.err.find("Narrow it with --bbox"), std::string::npos) << reported.err;
    EXPECT_EQ(reported.err_lines().size(), 1U) << reported.err;
    // Found: a raster that is too large alone was not named.
    const std::string huge = (folder / "huge.vrt").string();
    EXPECT_NE(reported.err.find("; without " + huge + " the others make a region"), std::string::npos)
        << reported.err;
    EXPECT_NE(reported.out.find("to be left out: 1 file\n" + huge + "  region too large: "),
              std::string::npos)
        << reported.out;
    fs::remove(folder / "N00E000.hgt");
    fs::remove(folder / "S80W170.hgt");
    oro::test::write_bytes(folder / "broken.txt", "no raster");
    const Outcome alone = run_orograph({"info", folder});
    EXPECT_EQ(alone.exit_code, 1);
    EXPECT_EQ(alone.err.find("; without"), std::string::npos) << alone.err;
}

}  // namespace
