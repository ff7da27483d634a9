// What a wrong command line is answered: one line that begins with the option, and exit code 2.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/apps/command_names.h"
#include "tests/apps/program.h"
#include "tests/support/found_texts.h"
#include "tests/support/test_data.h"

namespace {
using oro::test::bundled;
using oro::test::names_in;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::Words;

struct Refused {
    Words words;
    std::string line;
};

void expect_lines(const std::vector<Refused>& all) {
    for (const Refused& one : all) {
        const Outcome outcome = run_orograph(one.words);
        EXPECT_EQ(outcome.exit_code, 2) << one.line;
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(outcome.err, "orograph: " + one.line + "\n");
    }
}

// Found: exit code 0, and the program's help.
TEST(RefusedOptions, NoCommandIsOneForHelpEither) {
    const std::string these = "; these are " + oro::test::list_of_commands();
    expect_lines({{{"nonsense", "--help"}, "there is no command \"nonsense\"" + these},
                  {{"nonsense", "-h"}, "there is no command \"nonsense\"" + these},
                  {{"--help", "nonsense"}, "there is no command \"nonsense\"" + these},
                  {{"nonsense", "--version"}, "there is no command \"nonsense\"" + these},
                  {{"shoot", "--help"}, "there is no command \"shoot\": did you mean shot?"},
                  {{"shot", "--help", "nonsense"}, "--help takes nothing or all, not nonsense"},
                  {{"shot", "--help=nonsense"}, "--help takes nothing or all, not nonsense"}});
    EXPECT_EQ(run_orograph({"--help"}).exit_code, 0);
    const auto version = run_orograph({"--version"});
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_TRUE(version.out.starts_with("orograph 0.1.0\nGDAL 3.")) << version.out;
    EXPECT_NE(version.out.find(", PROJ 9."), std::string::npos) << version.out;
    // Each library that the build asks for, with a number behind it.
    for (const char* const library : {"GDAL",           "PROJ",
                                      "GeographicLib",  "zstd",
                                      "xxHash",         "ERFA",
                                      "FreeType",       "HarfBuzz",
                                      "Vulkan headers", "cURL",
                                      "cpp-httplib",    "OpenSSL",
                                      "GEOS",           "SQLite",
                                      "libpng",         "libjpeg",
                                      "libtiff",        "libexif",
                                      "zlib",           "libdeflate",
                                      "pugixml",        "JSON for Modern C++",
                                      "CLI11",          "GLM",
                                      "GLFW",           "Dear ImGui",
                                      "meshoptimizer",  "utf8cpp"})
        EXPECT_FALSE(
            oro::test::found_texts(version.out,
                                   "(, |\\n)" + oro::test::replaced_texts(library, "\\+", "\\+") + " [0-9]")
                .empty())
            << library << " in " << version.out;
    EXPECT_EQ(run_orograph({"shot", "nonsense", "--help"}).exit_code, 0);
}

TEST(RefusedOptions, Choices) {
    const std::string file = bundled();
    expect_lines(
        {{{"plan", file, "--earth", "round"}, "--earth round: choose ellipsoid, sphere or flat"},
         {{"plan", file, "--precision", "double"}, "--precision double: choose relative or naive"},
         {{"plan", file, "--geoid", "egm2008"}, "--geoid egm2008: choose egm96 or none"},
         {{"plan", file, "--heights", "f64"}, "--heights f64: choose f32, packed or i16"},
         {{"plan", file, "--accuracy", "best"}, "--accuracy best: choose draft, balanced or survey"},
         {{"shot", file, "--drape-values", "bright"},
          "--drape-values bright: choose auto, codes or reflectance"},
         {{"shot", file, "--graticule", "squares"}, "--graticule squares: choose geographic or projected"},
         {{"shot", file, "--pipeline", "cpu"}, "--pipeline cpu: choose auto, mesh or compute"},
         {{"info", file, "--height-unit", "feet"}, "--height-unit feet: choose m, ft, us-ft, cm, dm or mm"},
         {{"info", file, "--source-crs", "EPSG:999999"},
          "--source-crs EPSG:999999: is no coordinate reference system that PROJ knows; e.g. EPSG:2056"},
         {{"info", file, "--source-crs", "EPSG:5728"},
          "--source-crs EPSG:5728: says what heights refer to, not places: --source-vertical takes it"},
         {{"info", file, "--source-vertical", "EPSG:2056"},
          "--source-vertical EPSG:2056: says nothing of heights that PROJ knows; e.g. EPSG:5728 "
          "(Switzerland, "
          "LN02), EPSG:5703 (NAVD88), EPSG:4979 (above the ellipsoid)"}});
}

TEST(RefusedOptions, Numbers) {
    const std::string file = bundled();
    const Words at{"plan", file, "--at", "36.5,-84.3"};
    const auto with = [&](Words words) {
        words.insert(words.begin(), at.begin(), at.end());
        return words;
    };
    expect_lines(
        {{with({"--above", "300m"}), "--above 300m: is not a number"},
         {with({"--heading", "north"}), "--heading north: is not a number"},
         {with({"--samples", "0x10"}), "--samples 0x10: is not a whole number"},
         {with({"--samples", "65"}), "--samples 65: must be between 1 and 64"},
         {with({"--samples", "99999999999"}), "--samples 99999999999: must be between 1 and 64"},
         {with({"--fov", "180"}), "--fov 180: must be between 0.05 and 120"},
         {with({"--above", "1e10"}), "--above 10000000000: must be between -12000 and 1000000000"},
         {with({"--tau", "nan"}), "--tau nan: must be between 0 and 1000"},
         {with({"--tolerance", "0"}),
          "--tolerance 0: must be a number of pixels from 0.001 to 1000, e.g. 1px"},
         {with({"--size", "100"}), "--size 100: must be WIDTHxHEIGHT in pixels, e.g. 1920x1080"},
         {with({"--size", "0x10"}), "--size 0x10: each side must be between 1 and 65500 pixels"},
         {with({"--sun", "315"}), "--sun 315: must be AZIMUTH,ELEVATION in degrees, e.g. 315,45"},
         {with({"--sun", "315,91"}), "--sun 315,91: the elevation must be between -90 and 90"},
         {with({"--time", "now"}),
          "--time now: must be a time like 2026-06-21T05:30+02:00 or 2026-06-21T03:30:00Z"},
         {with({"--time", "2026-02-30T00:00:00Z"}),
          "--time 2026-02-30T00:00:00Z: is no time of the calendar"},
         {with({"--sun-time", "noon"}),
          "--sun-time noon: must be a time like 2026-06-21T05:30+02:00 or 2026-06-21T03:30:00Z"},
         {with({"--sun-time", "2026-06-21T05:30"}),
          "--sun-time 2026-06-21T05:30: must be a time like 2026-06-21T05:30+02:00 or 2026-06-21T03:30:00Z"},
         {with({"--sun-time", "2026-06-21T24:00Z"}),
          "--sun-time 2026-06-21T24:00Z: is no time of the calendar"},
         {{"trade", file, "--views", "0"}, "--views 0: must be between 1 and 1000"},
         {{"shot", file, "--memory", "8"}, "--memory 8: must be between 16 and 1000000"},
         {{"plan", file, "--bbox", "1,2,3"},
          "--bbox 1,2,3: needs four numbers in degrees: west,south,east,north"},
         {{"plan", file, "--tile", "46N8E"},
          "--tile 46N8E: is no tile name such as N46E008, nor a range of them such as N46E006:N47E010"}});
}

TEST(RefusedOptions, MissingValues) {
    const std::string file = bundled();
    expect_lines(
        {{{"plan", file, "--at"}, "--at: a value must follow: --at PLACE"},
         {{"plan", file, "--at", "--above", "3"}, "--at: a value must follow: --at PLACE"},
         {{"plan", file, "--samples", "--json"}, "--samples: a value must follow: --samples N"},
         {{"plan", file, "--tau", ""}, "--tau: its value is empty"},
         {{"trade", file, "--views", ""}, "--views: its value is empty"},
         {{"plan", ""}, "PATH: its value is empty"},
         {{"plan"}, "PATH: is missing: name a file or a folder of elevation data"},
         {{"compare"}, "PICTURE: is missing (orograph compare --help tells what it is)"},
         {{"shot", file}, "--out: is missing: name the picture to write (.png, .jpg or .tif)"},
         {{"bake", file}, "--out: is missing: name the file to write (.oro)"},
         {{"export", file}, "--to: is missing: choose cog, terrain-rgb, 3dtiles, quantized-mesh or gltf"},
         {{"export", file, "--to", "cog"}, "--out: is missing: name the file to write (.tif)"},
         {{"export", file, "--to", "terrain-rgb"}, "--out: is missing: name the folder to write"},
         {{"export", file, "--to", "3dtiles"}, "--out: is missing: name the folder to write"},
         {{"export", file, "--to", "quantized-mesh"}, "--out: is missing: name the folder to write"}});
}

TEST(RefusedOptions, OptionsThatExcludeEachOther) {
    const std::string file = bundled();
    expect_lines({{{"plan", file, "--at", "36.5,-84.3", "--altitude", "3", "--above", "3"},
                   "--above: give either --above or --altitude, not both"},
                  {{"info", file, "--tile", "N36W085", "--bbox", "-85,36,-84,37"},
                   "--bbox: give either --bbox or --tile, not both"},
                  {{"plan", file, "--at", "36.5,-84.3", "--look-at", "36.6,-84.3", "--pitch", "3"},
                   "--look-at: give either --look-at or --heading and --pitch, not both"},
                  {{"shot", file, "--out", "x.png", "--tolerance", "1px", "--accuracy", "draft"},
                   "--tolerance: give either --tolerance or --accuracy, not both"},
                  {{"shot", file, "--out", "x.png", "--sun", "90,20", "--sun-time", "2026-06-21T05:30Z"},
                   "--sun: give either --sun or --sun-time, not both"},
                  {{"plan", file, "--above", "3"}, "--above: says nothing without --at PLACE"},
                  {{"plan", file, "--tau", "1", "--tau", "2"}, "--tau: is given more than once"}});
}

TEST(RefusedOptions, NamesThatThereAreNot) {
    const std::string file = bundled();
    expect_lines(
        {{{"plan", file, "--hieghts", "f32"}, "--hieghts: plan has no such option: did you mean --heights?"},
         {{"info", file, "--nonsense=3"},
          "--nonsense: info has no such option (orograph info --help all lists them)"},
         {{"bake", file, "--look-at", "1,2"},
          "--look-at: bake has no such option (orograph bake --help all lists them)"},
         {{"doctor", "here"},
          "here: doctor takes options only, no files (orograph doctor --help lists them)"},
         {{"--tau", "1", "plan", file}, "--tau: stands before the command: orograph COMMAND --tau"},
         {{"--nonsense"}, "--nonsense: stands before the command: orograph COMMAND --nonsense"},
         {{"info", file, "--json=perhaps"}, "--json: takes no value"},
         {{"sho", file}, "there is no command \"sho\": did you mean shot?"},
         {{"fly"}, "there is no command \"fly\"; these are " + oro::test::list_of_commands()},
         {{"soar"}, "there is no command \"soar\"; these are " + oro::test::list_of_commands()}});
}

// One letter of three may differ, or stand in its neighbour's place.
TEST(RefusedOptions, OnlyNamesThatAreLikeThemAreSuggested) {
    const std::string file = bundled();
    const auto lists = [](const std::string& command, const std::string& option) {
        return option + ": " + command + " has no such option (orograph " + command +
               " --help all lists them)";
    };
    expect_lines({{{"horizon", file, "--observers", "x.csv"}, lists("horizon", "--observers")},
                  {{"shot", file, "--scale", "3"}, lists("shot", "--scale")},
                  {{"shot", file, "--x", "3"}, lists("shot", "--x")},
                  {{"shot", file, "--tua", "3"}, "--tua: shot has no such option: did you mean --tau?"},
                  {{"shot", file, "--styl", "x"}, "--styl: shot has no such option: did you mean --style?"},
                  {{"shot", file, "--obx", "1,2,3,4"}, lists("shot", "--obx")}});
}

// What a user may take for elevation data, for a place or for a CRS.
TEST(RefusedOptions, WhatIsSomethingElse) {
    const auto folder = oro::test::scratch_folder();
    const auto file = [&](const std::string& name) { return (folder / name).string(); };
    for (const char* const name : {"t.gpx", "t.geojson", "t.KML", "t.csv", "t.shp"}) {
        oro::test::write_bytes(folder / name, "name,lat,lon\n");
        oro::test::expect_refusal(
            run_orograph({"plan", file(name)}), 1,
            {std::string(name) + ": holds no elevation raster but tracks, points or areas: "
                                 "--overlay draws them, --names reads"});
    }
    oro::test::write_bytes(folder / "town.gml", "<CityModel/>");
    oro::test::expect_refusal(
        run_orograph({"plan", file("town.gml")}), 1,
        {"town.gml: is GML: CityGML is not read; citygml-tools turns it into CityJSON"});
    oro::test::write_bytes(folder / "town.xml", "<core:CityModel/>");
    oro::test::expect_refusal(run_orograph({"info", file("town.xml")}), 1,
                              {"town.xml: CityGML is not read; citygml-tools turns it into CityJSON"});
    oro::test::write_bytes(folder / "scan.las", "LASF");
    oro::test::expect_refusal(run_orograph({"info", file("scan.las")}), 1,
                              {"scan.las: is a point cloud, and these are not read"});
    oro::test::write_bytes(folder / "town.gpkg",
                           "SQLite format 3" + std::string(1, '\0') + "CREATE TABLE gpkg_geometry_columns");
    oro::test::expect_refusal(run_orograph({"info", file("town.gpkg")}), 1,
                              {"town.gpkg: holds no elevation raster but tracks, points or areas: "});
    std::filesystem::create_directory(folder / "meshes");
    for (const char* const name : {"meshes/a.obj", "meshes/b.ply"})
        oro::test::write_bytes(folder / name, "v 0 0 0\n");
    for (const char* const command : {"info", "plan"})
        oro::test::expect_refusal(run_orograph({command, file("meshes")}), 3,
                                  {"no elevation data under this folder, but 2 meshes: name them one by one, "
                                   "with --mesh-file " +
                                   file("meshes/a.obj")});
    expect_lines({{{"plan", bundled(), "--source-crs", "2056"},
                   "--source-crs 2056: is no coordinate reference system that PROJ knows: did you mean "
                   "EPSG:2056?"}});
    const std::string names = "(names need --names FILE, which holds them";
    for (const char* const place : {"Hoher Riffler", "Mont Blanc, Chamonix", "Grünhorn"})
        oro::test::expect_refusal(run_orograph({"plan", bundled(), "--at", place}), 2,
                                  {place, "is no known form of a place", names});
}

TEST(RefusedOptions, NamesOfFilesToWrite) {
    const std::string file = bundled();
    expect_lines(
        {{{"shot", file, "--out", "p.bmp"},
          "--out p.bmp: a picture's name ends in .png, .jpg, .jpeg, .tif or .tiff"},
         {{"batch", "none.jsonl", "--shard", "0/4"},
          "--shard 0/4: must be NUMBER/COUNT, the number from 1 to the count: 2/4"},
         {{"compare", "p.png", "--out", "e.jpg"}, "--out e.jpg: the picture of errors must be a .png"},
         {{"compare", "p.png", "--out", "e"}, "--out e: the picture of errors must be a .png"},
         {{"bake", file, "--out", "r.tif"}, "--out r.tif: the file's name must end in .oro"},
         {{"export", file, "--to", "cog", "--out", "r.png"},
          "--out r.png: the file's name must end in .tif"}});
}

// Listed nowhere, and refused with a reason.
TEST(RefusedOptions, HiddenOnes) {
    const std::string file = bundled();
    expect_lines({{{"trade", file, "--tau", "1"}, "--tau: trade chooses this itself: leave it out"},
                  {{"view", file, "--tolerance", "1px"},
                   "--tolerance: is for single pictures: give --accuracy or --tau to a window"}});
}

}  // namespace
