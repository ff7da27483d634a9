// Places that are named: --at Eiger, by a file of --names.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::says;
using oro::test::usage;
using oro::test::Words;

class NamedPlaces : public testing::Test {
  protected:
    fs::path folder = oro::test::scratch_folder();
    std::string names = (folder / "peaks.csv").string();

    void SetUp() override {
        std::ofstream(names)
            << "name,lat,lon,ele\nCross Mountain,36.55,-84.25,1070\nBald Knob,36.52,-84.2,800\n"
               "Bald Knob,36.48,-84.28,700\nLone Póint,36.5,-84.3,\n";
    }
    static json eye(const Words& words) {
        return object_said_by(joined(words, {"--json", "-q"})).at("view").at("eye");
    }
};

TEST_F(NamedPlaces, StandForTheirCoordinatesInEveryCommand) {
    const Words named{"--names", names};
    const Words sun{"sun", "--date", "2026-06-21", "--json", "-q"};
    EXPECT_EQ(
        object_said_by(joined(joined(sun, named), {"--at", "cross mountain"})).at("place").at("lat_deg"),
        36.55);
    EXPECT_EQ(object_said_by(joined(joined(sun, named), {"--at", "Lone Point"})).at("place").at("lon_deg"),
              -84.3);
    const Words sight{"sight", bundled(), "--json", "-q"};
    EXPECT_EQ(object_said_by(joined(joined(sight, named), {"--from", "Cross", "--to", "Lone"})),
              object_said_by(joined(sight, {"--from", "36.55,-84.25", "--to", "36.5,-84.3"})));
    const Words profile{"profile", bundled(), "--json", "-q"};
    EXPECT_EQ(object_said_by(joined(joined(profile, named), {"--along", "Cross; Lone Point"})),
              object_said_by(joined(profile, {"--along", "36.55,-84.25;36.5,-84.3"})));
    const Words shed{"viewshed", bundled(), "--radius", "0.5", "-q", "--overwrite"};
    const auto run = [](const Words& words) {
        const Outcome outcome = run_orograph(words);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    };
    run(joined(joined(shed, named), {"--at", "Cross", "--out", folder / "a.tif"}));
    run(joined(shed, {"--at", "36.55,-84.25", "--out", folder / "b.tif"}));
    EXPECT_EQ(oro::test::bytes_of(folder / "a.tif"), oro::test::bytes_of(folder / "b.tif"));
    // A plan, as a picture, has the place in its view.
    const Words plan{"plan", bundled(), "--above", "300", "--size", "64x36", "--look-at", "36.5,-84.3"};
    EXPECT_EQ(eye(joined(joined(plan, named), {"--at", "Cross"})).at("lat_deg"), 36.55);
}

TEST_F(NamedPlaces, TellWhatWasTakenForABeginning) {
    const Outcome outcome = run_orograph({"sun", "--at", "cross", "--names", names, "--date", "2026-06-21"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(says(outcome.err, "note: --at cross: taken for Cross Mountain, at 36.55000,-84.25000"))
        << outcome.err;
}

TEST_F(NamedPlaces, AreRefusedWhereNoneOrSeveralAre) {
    const auto refused = [&](const Words& more, const std::string& line) {
        expect_refusal(run_orograph(joined({"sun", "--names", names}, more)), usage, {line});
    };
    refused({"--at", "Bald Knob"},
            "--at Bald Knob: is the name of 2 places: Bald Knob, 800 m, at 36.52000,-84.20000; Bald Knob, "
            "700 m, at "
            "36.48000,-84.28000; give the coordinates of one");
    refused({"--at", "Cros Mountain"},
            "--at Cros Mountain: is no name of peaks.csv: did you mean Cross Mountain?");
    expect_refusal(run_orograph({"sun", "--at", "Cross Mountain"}), usage,
                   {"--at Cross Mountain: is no known form of a place", "names need --names FILE"});
    expect_refusal(run_orograph({"sun", "--at", "Cross", "--names", folder / "none.csv"}), oro::test::failed,
                   {"none.csv"});
}

// What reads as a place stays one, and the file is not even looked for.
TEST_F(NamedPlaces, LeavePlacesWhatTheyAre) {
    const json place = object_said_by({"sun", "--at", "N36W085", "--names", folder / "none.csv", "--date",
                                       "2026-06-21", "--json", "-q"})
                           .at("place");
    EXPECT_EQ(place.at("lat_deg"), 36.5);
}

// horizon --at: the angles of the files at the same post. A post of the bundled tile lies at 36.55, -84.25.
TEST_F(NamedPlaces, HorizonAroundAPlaceIsThatOfItsPost) {
    const json around =
        object_said_by({"horizon", bundled(), "--at", "Cross", "--names", names, "--directions", "8",
                        "--radius", "5", "--above", "2", "--json", "-q"});
    ASSERT_EQ(around.at("azimuths").size(), 8U);
    EXPECT_EQ(around.at("eye").at("lat_deg"), 36.55);
    const Words raster{"horizon",
                       bundled(),
                       "--bbox",
                       "-84.2504,36.5496,-84.2496,36.5504",
                       "--radius",
                       "5",
                       "--above",
                       "2",
                       "--directions",
                       "8",
                       "-q",
                       "--out",
                       (folder / "h.tif").string()};
    EXPECT_EQ(run_orograph(raster).exit_code, 0);
    const Outcome shown = oro::test::run_program(
        {"gdallocationinfo", "-valonly", "-wgs84", (folder / "h.horizon.tif").string(), "-84.25", "36.55"});
    if (shown.exit_code == 127) GTEST_SKIP() << "needs gdallocationinfo";
    std::istringstream values(shown.out);
    for (const json& one : around.at("azimuths")) {
        double raster_deg = 0.0;
        ASSERT_TRUE(values >> raster_deg) << shown.out;
        // docs/commands/horizon.md: 0.0012 degree at most; the place is a post to 1e-7 degree.
        EXPECT_NEAR(one.at("elevation_deg").get<double>(), raster_deg, 0.002) << one.at("azimuth_deg");
        EXPECT_GT(one.at("distance_m").get<double>(), 0.0);
        EXPECT_LE(one.at("distance_m").get<double>(), 5001.0);
    }
}

TEST_F(NamedPlaces, HorizonAroundAPlacePrintsAndWritesATable) {
    const Outcome outcome = run_orograph({"horizon", bundled(), "--at", "36.55,-84.25", "--directions", "4",
                                          "--radius", "5", "--out", (folder / "h.csv").string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(says(outcome.out, "Horizon around 36.550000 -84.250000, H ")) << outcome.out;
    EXPECT_TRUE(says(outcome.out, "\nazimuth   elevation     distance          H   place\n     0°"))
        << outcome.out;
    const std::string csv = oro::test::bytes_of(folder / "h.csv");
    EXPECT_EQ(csv.substr(0, csv.find('\n')), "azimuth_deg,elevation_deg,distance_m,lat_deg,lon_deg,H_m");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
    expect_refusal(run_orograph({"horizon", bundled(), "--at", "36.55,-84.25", "--out", "h.tif"}), usage,
                   {"--out h.tif: the file's name must end in .csv with --at"});
    expect_refusal(run_orograph({"horizon", bundled(), "--altitude", "900", "--out", "h.tif"}), usage,
                   {"--altitude: says nothing without --at PLACE"});
}

}  // namespace
