// What a picture says of itself, and that its view draws it again.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::names_in;
using oro::test::one_object;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::Words;

json exif_of(const fs::path& picture) {
    const Outcome reported = oro::test::run_program({"exiftool", "-n", "-j", picture});
    EXPECT_EQ(reported.exit_code, 0) << reported.err;
    EXPECT_EQ(reported.err, "");
    const json list = json::parse(reported.out, nullptr, false);
    EXPECT_TRUE(list.is_array() && list.size() == 1) << reported.out;
    return list.is_array() && list.size() == 1 ? list[0] : json::object();
}

double turn_deg(double a_deg, double b_deg) {
    return std::abs(std::remainder(a_deg - b_deg, 360.0));
}

class Shot : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();

    // Takes a small picture; gives what --json says of it.
    json shoot(const fs::path& out, Words more, const std::string& data = bundled()) const {
        Words words{"shot", data, "--out", out, "--json", "-q"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run_orograph(words);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "") << "in spite of -q";
        return one_object(outcome.out);
    }
    void expect_tags(const fs::path& picture, const json& said) const {
        const json tags = exif_of(picture);
        const json& eye = said.at("eye");
        ASSERT_TRUE(tags.contains("GPSLatitude") && tags.contains("GPSAltitude")) << tags.dump(1);
        // Tolerances as the project promises them: 1e-7 degree, 0.01 m, 0.01 degree.
        EXPECT_NEAR(tags["GPSLatitude"].get<double>(), eye["lat_deg"].get<double>(), 1e-7);
        EXPECT_NEAR(tags["GPSLongitude"].get<double>(), eye["lon_deg"].get<double>(), 1e-7);
        EXPECT_NEAR(tags["GPSAltitude"].get<double>(), eye["H_m"].get<double>(), 0.01);
        EXPECT_EQ(tags["GPSAltitudeRef"].get<int>(), eye["H_m"].get<double>() < 0 ? 1 : 0);
        EXPECT_LE(turn_deg(tags["GPSImgDirection"].get<double>(), said["heading_deg"].get<double>()), 0.01);
        EXPECT_EQ(tags["GPSImgDirectionRef"], "T");
        EXPECT_EQ(tags["GPSVersionID"], "2 3 0 0");
        EXPECT_EQ(tags["GPSMapDatum"], "WGS-84");
        EXPECT_EQ(tags["ImageWidth"], said["size_px"][0]);
        EXPECT_EQ(tags["ImageHeight"], said["size_px"][1]);
        EXPECT_GT(tags["FocalLengthIn35mmFormat"].get<double>(), 0);
        EXPECT_TRUE(tags.contains("GPSDateStamp") && tags.contains("GPSTimeStamp"));
        if (!said["destination"].is_null()) {
            const json& destination = said["destination"];
            EXPECT_NEAR(tags["GPSDestLatitude"].get<double>(), destination["lat_deg"].get<double>(), 1e-7);
            EXPECT_NEAR(tags["GPSDestLongitude"].get<double>(), destination["lon_deg"].get<double>(), 1e-7);
            EXPECT_LE(
                turn_deg(tags["GPSDestBearing"].get<double>(), destination["bearing_deg"].get<double>()),
                0.01);
        }
    }
};

const Words plain_eye{"--at",  "36.6,-84.2", "--above", "300",    "--heading",
                      "200.5", "--pitch",    "-5",      "--size", "160x120"};

TEST_F(Shot, SaysWhereItWasTakenFrom) {
    const json said = shoot(folder / "p.png", plain_eye);
    EXPECT_NEAR(said["eye"]["lat_deg"].get<double>(), 36.6, 1e-12);
    EXPECT_NEAR(said["eye"]["lon_deg"].get<double>(), -84.2, 1e-12);
    EXPECT_NEAR(said["eye"]["h_m"].get<double>(),
                said["eye"]["H_m"].get<double>() + said["eye"]["N_m"].get<double>(), 1e-6);
    // N of EGM96 at 36.6 N 84.2 W lies near -31 m; a flipped sign or another place would be far from it.
    EXPECT_NEAR(said["eye"]["N_m"].get<double>(), -31.0, 3.0);
    EXPECT_EQ(said["heading_deg"].get<double>(), 200.5);
    EXPECT_EQ(said["pitch_deg"].get<double>(), -5.0);
    EXPECT_EQ(said["size_px"], json({160, 120}));
    EXPECT_GT(said["triangles"]["drawn"].get<int>(), 1000);
    EXPECT_GT(said["meshlets"]["drawn"].get<int>(), 10);
    for (const char* key : {"sources", "meshlets", "times_s", "device", "roll_deg", "fov_deg", "destination"})
        EXPECT_TRUE(said.contains(key)) << key;
    ASSERT_EQ(said["sources"].size(), 1U);
    EXPECT_NE(said["sources"][0].dump().find("USGS"), std::string::npos) << said["sources"][0];
    EXPECT_EQ(names_in(folder), Words{"p.png"});
}

TEST_F(Shot, TagsOfEveryFormatAgreeWithTheView) {
    for (const char* name : {"a.png", "b.jpg", "c.tif"}) {
        SCOPED_TRACE(name);
        expect_tags(folder / name, shoot(folder / name, plain_eye));
    }
}

TEST_F(Shot, EyeBelowSeaLevelAndFacingNorth) {
    Words low{"--at", "36.6,-84.2", "--altitude", "-12.25", "--heading",
              "0",    "--pitch",    "-89",        "--size", "64x64"};
    const json said = shoot(folder / "low.png", low);
    EXPECT_NEAR(said["eye"]["H_m"].get<double>(), -12.25, 1e-6);
    expect_tags(folder / "low.png", said);
}

TEST_F(Shot, ViewDrawsTheSameBytes) {
    for (const char* name : {"p.png", "p.jpg", "p.tif"}) {
        SCOPED_TRACE(name);
        const fs::path there = oro::test::scratch_folder();
        const json said = shoot(there / name, plain_eye);
        oro::test::write_bytes(there / "v.json", said.at("view").dump());
        for (const fs::path& view : {there / name, there / "v.json"}) {
            const fs::path again = oro::test::scratch_folder() / name;
            const Outcome outcome = run_orograph({"shot", "--view", view, "--out", again, "-q"});
            ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
            EXPECT_TRUE(bytes_of(again) == bytes_of(there / name)) << "other bytes from " << view;
        }
    }
}

TEST_F(Shot, WholeRegionAndSamples) {
    const json said = shoot(folder / "region.png", {"--size", "160x90", "--samples", "4"});
    EXPECT_EQ(said["samples"], 4);
    EXPECT_GT(said["eye"]["H_m"].get<double>(), 1076.0) << "above the region's highest post";
    const fs::path again = folder / "again.png";
    ASSERT_EQ(run_orograph({"shot", "--view", folder / "region.png", "--out", again, "-q"}).exit_code, 0);
    EXPECT_TRUE(bytes_of(again) == bytes_of(folder / "region.png"));
}

TEST_F(Shot, OverwritesOnlyWhenTold) {
    oro::test::write_bytes(folder / "p.png", "mine");
    Words reported = plain_eye;
    reported.push_back("--overwrite");
    shoot(folder / "p.png", reported);
    EXPECT_EQ(bytes_of(folder / "p.png").substr(1, 3), "PNG");
}

// A tile at 1,000 m with a lake of void posts: a hole to look through, or filled by a method that has a name;
// never a pit, never 0 m.
TEST_F(Shot, VoidsAreHolesOrFilledAndCounted) {
    std::string tile;
    for (int row = 0; row < 1201; ++row) {
        for (int column = 0; column < 1201; ++column)
            tile += std::abs(row - 600) <= 5 && std::abs(column - 600) <= 5 ? std::string("\x80\0", 2)
                                                                            : "\x03\xe8";
    }
    oro::test::write_bytes(folder / "N46E008.hgt", tile);
    const Words down{"--at", "46.5,8.5", "--altitude", "3000", "--pitch", "-90", "--size", "64x64"};
    const json holes = shoot(folder / "holes.png", down, folder / "N46E008.hgt");
    EXPECT_EQ(holes["region"]["voids"], 121);
    EXPECT_EQ(holes["region"]["filled"], 0);
    EXPECT_EQ(holes["region"]["void_method"], "holes");
    EXPECT_EQ(holes["region"]["H_m"]["lowest"], 1000.0);
    EXPECT_TRUE(holes["destination"].is_null()) << "the centre ray meets ground where none is";

    Words filling = down;
    filling.push_back("--fill-voids");
    const json filled = shoot(folder / "filled.png", filling, folder / "N46E008.hgt");
    EXPECT_EQ(filled["region"]["filled"], 121);
    EXPECT_NE(filled["region"]["void_method"].get<std::string>().find("GDALFillNodata"), std::string::npos);
    EXPECT_EQ(filled["region"]["H_m"], json({{"lowest", 1000.0}, {"highest", 1000.0}}));
    EXPECT_FALSE(filled["destination"].is_null());
}

// Straight down from H = 3,000 m on a tile at 1,000 m: 600.6 posts east of its western rim, 599.64 south of
// its northern one. A baked region says the same.
TEST_F(Shot, SaysWhatItsMiddleSees) {
    std::string tile;
    for (int i = 0; i < 1201 * 1201; ++i) tile += "\x03\xe8";
    const std::string data = folder / "N46E008.hgt";
    oro::test::write_bytes(data, tile);
    const Words down{"--at", "46.5003,8.5005", "--altitude", "3000",         "--pitch",
                     "-90",  "--size",         "64x64",      "--refraction", "0.13"};
    const json said = shoot(folder / "down.png", down, data);
    const json& destination = said["destination"];
    ASSERT_TRUE(destination.is_object());
    EXPECT_NEAR(destination["lat_deg"].get<double>(), 46.5003, 1e-9);
    EXPECT_NEAR(destination["lon_deg"].get<double>(), 8.5005, 1e-9);
    EXPECT_NEAR(destination["H_m"].get<double>(), 1000.0, 1e-4);
    EXPECT_NEAR(destination["h_m"].get<double>(), 1000.0 + said["eye"]["N_m"].get<double>(), 1e-4);
    // Along the plumb line; refraction lifts by k s^2 / (2 R) = 4 cm.
    EXPECT_NEAR(destination["seen_distance_m"].get<double>(), 2000.0, 0.05);
    EXPECT_NEAR(destination["distance_m"].get<double>(), 0.0, 1e-3);
    EXPECT_EQ(destination["cell"], json({{"row", 599}, {"column", 600}}));
    EXPECT_EQ(destination["source"], said["sources"][0]["path"]);
    EXPECT_TRUE(destination["source"].get<std::string>().ends_with("N46E008.hgt"));

    const std::string baked = folder / "tile.oro";
    ASSERT_EQ(run_orograph({"bake", data, "--out", baked, "-q"}).exit_code, 0);
    EXPECT_EQ(shoot(folder / "baked.png", down, baked)["destination"], destination);
}

TEST_F(Shot, NamesWithBlanksAndUmlauts) {
    const fs::path data = folder / "Höhen daten.tif";
    fs::copy_file(bundled(), data);
    shoot(folder / "Ein Bild.png", plain_eye, data);
    EXPECT_EQ(names_in(folder), (Words{"Ein Bild.png", "Höhen daten.tif"}));
}

TEST_F(Shot, MessagesGoToStandardError) {
    const Outcome outcome =
        run_orograph({"shot", bundled(), "--size", "64x48", "--out", folder / "p.png", "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    one_object(outcome.out);
    EXPECT_NE(outcome.err.find("p.png"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find('\r'), std::string::npos) << "a progress bar where no terminal is";
}

TEST_F(Shot, InfoAndDoctorAreOneObject) {
    const Outcome info = run_orograph({"info", bundled(), "--json"});
    ASSERT_EQ(info.exit_code, 0) << info.err;
    const json source = one_object(info.out).at("sources").at(0);
    EXPECT_EQ(source["posts"], json({{"columns", 403}, {"rows", 344}})) << source;
    EXPECT_EQ(source["H_m"], json({{"lowest", 236.0}, {"highest", 1076.0}}));
    EXPECT_EQ(source["voids"], 0);
    const Outcome doctor = run_orograph({"doctor", "--json"});
    ASSERT_EQ(doctor.exit_code, 0) << doctor.err;
    EXPECT_FALSE(one_object(doctor.out).at("devices").empty());
}

TEST_F(Shot, HelpAndVersion) {
    for (const Words& words : {Words{"--help"}, Words{"shot", "--help"}, Words{"--version"}}) {
        const Outcome outcome = run_orograph(words);
        EXPECT_EQ(outcome.exit_code, 0);
        EXPECT_EQ(outcome.err, "");
        EXPECT_NE(outcome.out, "");
    }
}

// Found: the height of --at geo:LAT,LON,HEIGHT was read and not used. It is above the ellipsoid.
TEST_F(Shot, TakesTheHeightOfAGeoPlace) {
    const json said = shoot(folder / "geo.png", {"--at", "geo:36.6,-84.2,2000", "--size", "64x36"},
                            oro::test::bundled_data() / "jacksboro.tif");
    EXPECT_NEAR(said["eye"]["h_m"].get<double>(), 2000.0, 1e-9);
    EXPECT_NEAR(said["eye"]["H_m"].get<double>() + said["eye"]["N_m"].get<double>(), 2000.0, 1e-9);
}

// Over the antimeridian and over both poles, with Vulkan's validation layer watching.
TEST_F(Shot, AntimeridianAndPoles) {
    const auto geotiff = oro::test::real_data("geotiff");
    if (!geotiff) GTEST_SKIP() << "needs geotiff";
    const std::vector<Words> shots{
        {(*geotiff / "fiji_antimeridian_etopo1_170_190.tif").string(), "--bbox", "175,-20,-175,-15"},
        {(*geotiff / "antarctica_etopo1_EPSG3031_20km.tif").string(), "--bbox", "-180,-90,180,-65"},
        {(*geotiff / "vavilov_EPSG3413_f32.tif").string()}};
    for (const Words& shot : shots) {
        for (const char* pipeline : {"mesh", "compute"}) {
            Words words{"shot"};
            words.insert(words.end(), shot.begin(), shot.end());
            for (const std::string& word :
                 Words{"--out", folder / "far.png", "--overwrite", "--json", "-q", "--size", "320x180",
                       "--samples", "2", "--tau", "0", "--pipeline", pipeline})
                words.push_back(word);
            oro::test::Circumstances validated;
            validated.environment = {"OROGRAPH_VALIDATION=1"};
            const Outcome outcome = run_orograph(words, validated);
            ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
            const json said = one_object(outcome.out);
            EXPECT_GT(said["triangles"]["drawn"].get<double>(),
                      0.2 * said["triangles"]["at_full_resolution"].get<double>());
        }
    }
}

// The view named in the project's first issue: Eiger, Moench and Jungfrau from Grindelwald-First.
TEST_F(Shot, GrindelwaldFirst) {
    const auto alps = oro::test::real_data("alps");
    if (!alps) GTEST_SKIP() << "needs alps";
    const fs::path picture = folder / "e.png";
    const json said = shoot(picture,
                            {"--tile", "N46E008", "--at", "46.67,8.06", "--above", "300", "--heading", "200",
                             "--pitch", "-5", "--size", "480x270"},
                            *alps);
    expect_tags(picture, said);
    const json tags = exif_of(picture);
    EXPECT_NEAR(tags["GPSLatitude"].get<double>(), 46.67, 1e-7);
    EXPECT_NEAR(tags["GPSLongitude"].get<double>(), 8.06, 1e-7);
    EXPECT_NEAR(tags["GPSImgDirection"].get<double>(), 200.0, 0.01);
    ASSERT_EQ(run_orograph({"shot", "--view", picture, "--out", folder / "again.png", "-q"}).exit_code, 0);
    EXPECT_TRUE(bytes_of(folder / "again.png") == bytes_of(picture));
}

}  // namespace
