// What once went wrong without a word, or with a wrong one.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bundled;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::says;
using oro::test::Words;
using oro::test::write_bytes;

// A house outside the box was in the model, far from all ground.
TEST(Untold, AMeshOutsideTheBoxIsLeftOut) {
    const fs::path folder = oro::test::scratch_folder(), house = folder / "house.obj";
    write_bytes(house,
                "v -84.35 36.55 420\nv -84.3495 36.55 420\nv -84.3495 36.5505 420\nv -84.35 36.5505 440\n"
                "f 1 2 3\nf 1 3 4\n");
    const auto exported = [&](const std::string& box, const std::string& name) {
        return run_orograph({"export", bundled(), "--to", "gltf", "--bbox=" + box, "--mesh-file", house,
                             "--mesh-crs", "EPSG:4326", "--out", folder / name});
    };
    const Outcome beside = exported("-84.3,36.5,-84.29,36.51", "beside.glb");
    ASSERT_EQ(beside.exit_code, 0) << beside.err;
    EXPECT_TRUE(says(beside.err, "note: " + house.string() +
                                     ": lies wholly outside the box -84.3,36.5,-84.29,36.51 and is left out"))
        << beside.err;
    const Outcome around = exported("-84.351,36.549,-84.349,36.551", "around.glb");
    ASSERT_EQ(around.exit_code, 0) << around.err;
    EXPECT_FALSE(says(around.err, "is left out")) << around.err;
    const std::string model = oro::test::bytes_of(folder / "beside.glb");
    EXPECT_FALSE(says(model, "house.obj"));
    EXPECT_TRUE(says(oro::test::bytes_of(folder / "around.glb"), "house.obj"));
}

// Coordinates in the wrong order put all points into the Antarctic.
TEST(Untold, FeaturesThatLieElsewhereAreTold) {
    const fs::path folder = oro::test::scratch_folder();
    const auto notes = [&](const Words& more) {
        const Outcome drawn = run_orograph(joined({"shot", bundled(), "--at", "36.6,-84.2", "--size", "64x48",
                                                   "--overwrite", "--out", folder / "a.png"},
                                                  more));
        EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
        return drawn.err;
    };
    const std::string where =
        " where the elevation data do (-84.4133,36.4467,-84.0783,36.7325: "
        "west,south,east,north)";
    write_bytes(folder / "swapped.csv", "name,lat,lon\nA,-84.2,36.5\nB,-84.21,36.55\nC,46,8\n");
    const std::string swapped = (folder / "swapped.csv").string(), text = notes({"--names", swapped});
    EXPECT_TRUE(
        says(text, "note: " + swapped + ": none of its 3 features lies" + where +
                       "; 2 would with latitude and longitude swapped: is their order right in the file?"))
        << text;
    write_bytes(folder / "line.geojson",
                R"({"type": "LineString", "coordinates": [[8.0, 46.5], [8.1, 46.6]]})");
    const std::string line = (folder / "line.geojson").string(), other = notes({"--overlay", line});
    EXPECT_TRUE(says(other, "note: " + line + ": its feature does not lie" + where + "\n")) << other;
    // One that crosses the region without a place in it lies there.
    write_bytes(folder / "line.geojson",
                R"({"type": "LineString", "coordinates": [[-85.0, 36.55], [-83.0, 36.56]]})");
    EXPECT_FALSE(says(notes({"--overlay", line}), "elevation data do"));
    write_bytes(folder / "swapped.csv", "name,lat,lon\nA,36.5,-84.2\nB,46,8\nC,46,8\n");
    EXPECT_FALSE(says(notes({"--names", swapped}), "elevation data do"));
}

// Feet of .hgt files were a note below others, and metres were taken.
TEST(Untold, AUnitOfHeightsIsNotForHgtFiles) {
    const fs::path folder = oro::test::scratch_folder();
    std::string posts;
    for (int i = 0; i < 1201 * 1201; ++i) posts += "\x03\xe8";
    write_bytes(folder / "N46E008.hgt", posts);
    const std::string tile = (folder / "N46E008.hgt").string();
    expect_refusal(run_orograph({"info", tile, "--height-unit", "ft"}), oro::test::usage,
                   {"--height-unit ft: is not for .hgt files, whose format says metres"});
    EXPECT_EQ(run_orograph({"info", tile, "--height-unit", "m"}).exit_code, 0);
}

// With a limit of memory just above what the libraries take to be loaded PROJ fails in one way or the other:
// the geoid was then "damaged", and files had "no coordinate reference system".
TEST(Untold, WantOfMemoryIsNotSaidToBeDamage) {
    const auto info = [&](int limit_kib) {
        return run_program({"sh", "-c",
                            "ulimit -v " + std::to_string(limit_kib) +
                                "; \"$0\" info \"$1\"; code=$?; [ $code = 127 ] && code=99; exit $code",
                            OROGRAPH_PROGRAM, bundled()});
    };
    constexpr int not_loaded = 99;
    int low_kib = 20'000, high_kib = 4'000'000;
    if (info(high_kib).exit_code != 0) GTEST_SKIP() << "libraries take more than 4 GB of addresses";
    while (high_kib - low_kib > 1000) {
        const int middle_kib = (low_kib + high_kib) / 2;
        (info(middle_kib).exit_code == not_loaded ? low_kib : high_kib) = middle_kib;
    }
    int refusals = 0;
    for (int limit_kib = high_kib; limit_kib < high_kib + 40'000; limit_kib += 2000) {
        const Outcome outcome = info(limit_kib);
        if (outcome.exit_code == 0) break;
        ++refusals;
        EXPECT_TRUE(says(outcome.err, "memory")) << limit_kib << " KiB: " << outcome.err;
    }
    EXPECT_GT(refusals, 0);
}

}  // namespace
