// orograph panorama as people and programs use it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/found_texts.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::no_data;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::Pixels;
using oro::test::pixels_of;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::usage;
using oro::test::view_in;
using oro::test::Words;
using oro::test::write_bytes;

std::string feature(const std::string& name, double lon_deg, double lat_deg) {
    return json{{"type", "Feature"},
                {"properties", {{"name", name}}},
                {"geometry", {{"type", "Point"}, {"coordinates", {lon_deg, lat_deg}}}}}
        .dump();
}

// The bundled region, and points on it, seen from high above its middle.
class Panorama : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const std::string land = (folder / "land.tif").string(), points = (folder / "points.geojson").string();

    Panorama() {
        fs::copy_file(oro::test::bundled_data() / "jacksboro.tif", land);
        write_bytes(points, R"({"type":"FeatureCollection","features":[)" +
                                feature("Żółta <Góra> & \"Söhne\"", -84.20, 36.62) + "," +
                                feature("جبل", -84.30, 36.55) + "," +
                                feature("Cross Mountain", -84.14, 36.45) + "," +
                                feature("Elsewhere", 8.0, 46.0) + "]}");
    }
    [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }
    [[nodiscard]] Words words(const std::string& out, const Words& more = {}) const {
        Words all{"panorama", land,     "--at",        "36.53,-84.23", "--above", "900",
                  "--width",  "800",    "--elevation", "-30,5",        "--time",  "2026-01-01T00:00:00Z",
                  "--out",    path(out)};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    [[nodiscard]] Outcome draw(const std::string& out, const Words& more = {}) const {
        return run_orograph(words(out, more));
    }
    [[nodiscard]] json reported(const std::string& out, const Words& more) const {
        Words all = words(out, more);
        all.insert(all.end(), {"--json", "-q"});
        return object_said_by(all);
    }
};

// Elements of an SVG by a regular expression, each with what its brackets hold.
std::vector<std::vector<std::string>> found(const std::string& svg, const std::string& expression) {
    std::vector<std::vector<std::string>> all = oro::test::found_texts(svg, expression);
    for (std::vector<std::string>& parts : all) parts.erase(parts.begin());
    return all;
}

// Everything but the picture itself, which expressions take long to pass over.
std::string without_image(std::string svg) {
    const std::size_t begin = svg.find("<image"), end = svg.find("/>", begin);
    return svg.erase(begin, end + 2 - begin);
}

int darkness(const Pixels& pixels, double x, double y) {
    const std::size_t at = 3 * (static_cast<std::size_t>(y) * pixels.width + static_cast<std::size_t>(x));
    return 765 - pixels.rgb[at] - pixels.rgb[at + 1] - pixels.rgb[at + 2];
}

TEST_F(Panorama, SaysTheSameInAllFormats) {
    const json said = reported("p.png", {"--names", points});
    EXPECT_EQ(reported("p.svg", {"--names", points})["names"], said["names"]);
    EXPECT_EQ(reported("p.tif", {"--names", points})["names"], said["names"]);
    const Pixels png = pixels_of(path("p.png"));
    EXPECT_EQ(png.width, 800U);
    EXPECT_EQ(png.height, said["size_px"][1]);
    ASSERT_EQ(said["names"]["named"].size(), 3U) << said["names"].dump(1);
    EXPECT_EQ(said["names"]["beyond_data"], 1);
    const std::string svg = without_image(bytes_of(path("p.svg")));
    const auto lines = found(svg, R"#(<line x1="([\d.]+)" y1="([\d.]+)" x2="([\d.]+)" y2="([\d.]+)")#");
    const auto names = found(svg, R"#(<text class="name" x="([\d.]+)"[^>]*>([^<]*)</text>)#");
    ASSERT_EQ(names.size(), 3U);
    const double top = said["scene"]["top_px"];
    for (std::size_t i = 0; i < 3; ++i) {
        const json& name = said["names"]["named"][i];
        const double x = name["x_px"], azimuth = name["azimuth_deg"], elevation = name["elevation_deg"];
        EXPECT_NEAR(x, azimuth / 360.0 * 800.0, 1e-6);
        EXPECT_NEAR(name["y_px"].get<double>(),
                    said["scene"]["level_y_px"].get<double>() - std::tan(elevation * 0.017453292519943295) *
                                                                    said["scene"]["px_per_rad"].get<double>(),
                    1e-6);
        // The line down to it stands in the drawing ...
        EXPECT_TRUE(std::ranges::any_of(lines, [&](const auto& line) {
            return std::abs(std::stod(line[0]) - x) < 0.01 && std::abs(std::stod(line[2]) - x) < 0.01 &&
                   std::abs(std::stod(line[3]) - top) < 0.01;
        })) << name["name"];
        // ... and in the picture: darker than what is beside it, in the sky.
        EXPECT_GT(darkness(png, x, top + 4), darkness(png, x - 3.0, top + 4) + 60) << name["name"];
        EXPECT_GT(darkness(png, x, top + 4), darkness(png, x + 3.0, top + 4) + 60) << name["name"];
        // The name stands in its own column, its base line half the height of capitals to the right.
        EXPECT_NEAR(std::stod(names[i][0]),
                    name["name_x_px"].get<double>() + 0.5 * 0.729 * said["rulers"]["text_px"].get<double>(),
                    0.01);
    }
    EXPECT_NE(svg.find(">Żółta &lt;Góra&gt; &amp; \"Söhne\"<"), std::string::npos);
    EXPECT_NE(svg.find(">جبل<"), std::string::npos);
    if (run_program({"gdal_translate", "-q", "-of", "PNG", path("p.tif"), path("tif.png")}).exit_code != 0)
        GTEST_SKIP() << "needs gdal_translate for the rest";
    EXPECT_EQ(pixels_of(path("tif.png")).rgb, png.rgb);
}

TEST_F(Panorama, IsTheSameTwiceAndByItsView) {
    ASSERT_EQ(draw("a.png", {"--names", points, "--sector", "300,100"}).exit_code, 0);
    ASSERT_EQ(draw("b.png", {"--names", points, "--sector", "300,100"}).exit_code, 0);
    EXPECT_EQ(bytes_of(path("a.png")), bytes_of(path("b.png")));
    const Outcome again = run_orograph({"panorama", "--view", path("a.png"), "--out", path("c.png")});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(bytes_of(path("a.png")), bytes_of(path("c.png")));
    const json view = json::parse(view_in(path("a.png")));
    EXPECT_EQ(view["panorama"]["from_deg"], 300.0);
    EXPECT_EQ(view["panorama"]["sweep_deg"], 160.0);
    EXPECT_EQ(view["air"], "standard");
    EXPECT_EQ(view["size_px"][0], 800);
    EXPECT_EQ(view["heading_deg"], 20.0);
    // The same as SVG, twice.
    ASSERT_EQ(draw("a.svg").exit_code, 0);
    ASSERT_EQ(draw("b.svg").exit_code, 0);
    EXPECT_EQ(bytes_of(path("a.svg")), bytes_of(path("b.svg")));
}

TEST_F(Panorama, TellsViewersWhatItIs) {
    ASSERT_EQ(draw("p.jpg", {"--sector", "90,180"}).exit_code, 0);
    const std::string bytes = bytes_of(path("p.jpg"));
    const auto has = [&](const std::string& text) { return bytes.find(text) != std::string::npos; };
    EXPECT_TRUE(has("<GPano:ProjectionType>cylindrical</GPano:ProjectionType>"));
    EXPECT_TRUE(has("<GPano:PoseHeadingDegrees>135</GPano:PoseHeadingDegrees>"));
    EXPECT_TRUE(has("<GPano:FullPanoWidthPixels>3200</GPano:FullPanoWidthPixels>"));
    EXPECT_TRUE(has("<GPano:CroppedAreaImageWidthPixels>800</GPano:CroppedAreaImageWidthPixels>"));
    EXPECT_TRUE(has("<GPano:CroppedAreaLeftPixels>1200</GPano:CroppedAreaLeftPixels>"));
    // 3200 / 2 pi = 509.296 px a radian; tan 5 = 0.0874887: level is 44.56 rows down.
    EXPECT_TRUE(has("<GPano:CroppedAreaTopPixels>-45</GPano:CroppedAreaTopPixels>"));
}

// 800 pixels for a quarter of all around are 800 / (pi / 2) = 509.296 a radian; the file's first row stands
// as high over level, on the cylinder, as it says.
TEST_F(Panorama, HasAnOverlayForGlobes) {
    const Words poses{"--sector", "90,180", "--kml", "--stac"};
    const json said = reported("p.png", poses);
    const std::string kml = bytes_of(path("p.kml"));
    const auto has = [&](const std::string& text) { return kml.find(text) != std::string::npos; };
    EXPECT_TRUE(has("<href>p.png</href>")) << kml;
    EXPECT_TRUE(has("<heading>135.000000000</heading><tilt>90.000000000</tilt>")) << kml;
    EXPECT_TRUE(has("<leftFov>-45.000000000</leftFov><rightFov>45.000000000</rightFov>")) << kml;
    EXPECT_TRUE(has("<shape>cylinder</shape>")) << kml;
    const auto between = [&](const std::string& element) {
        return std::stod(kml.substr(kml.find("<" + element + ">") + element.size() + 2));
    };
    const double level_px = said["scene"]["level_y_px"], height_px = said["size_px"][1];
    constexpr double deg_per_rad = 57.29577951308232, px_per_rad = 509.29581789;
    EXPECT_NEAR(between("topFov"), deg_per_rad * std::atan(level_px / px_per_rad), 1e-6);
    EXPECT_NEAR(between("bottomFov"), -deg_per_rad * std::atan((height_px - level_px) / px_per_rad), 1e-6);
    EXPECT_NEAR(between("altitude"), said["eye"]["H_m"].get<double>(), 1e-6);
    EXPECT_EQ(json::parse(bytes_of(path("p.stac.json")))["assets"]["kml"]["href"], "./p.kml");
    // It is not replaced, and its view writes the same again.
    fs::remove(path("p.png"));
    fs::remove(path("p.stac.json"));
    expect_refusal(draw("p.png", poses), failed, {"p.kml", "is there already"});
    EXPECT_FALSE(fs::exists(path("p.png")));
    ASSERT_EQ(draw("p.png", {"--sector", "90,180", "--kml", "--overwrite"}).exit_code, 0);
    fs::create_directory(folder / "again");
    ASSERT_EQ(
        run_orograph({"panorama", "--view", path("p.png"), "--kml", "--out", path("again/p.png")}).exit_code,
        0);
    EXPECT_EQ(bytes_of(path("again/p.kml")), kml);
    expect_refusal(draw("p.svg", {"--kml"}), usage, {"--kml: shows a picture, not a drawing"});
}

TEST_F(Panorama, IsNoPictureOfAnotherCommand) {
    ASSERT_EQ(draw("p.png").exit_code, 0);
    for (const Words& other : {Words{"shot", "--view", path("p.png")},
                               {"compare", path("p.png")},
                               {"plan", "--view", path("p.png")}})
        expect_refusal(run_orograph(other), usage,
                       {"p.png: is a panorama: orograph panorama --view draws it again"});
    ASSERT_EQ(run_orograph({"shot", land, "--size", "64x64", "--out", path("s.png")}).exit_code, 0);
    expect_refusal(run_orograph({"panorama", "--view", path("s.png"), "--out", path("q.png")}), usage,
                   {"s.png: is no panorama: orograph shot --view draws it again"});
}

TEST_F(Panorama, RefusesWhatCannotBe) {
    const auto refused = [&](const Words& more, const std::string& line, int code = usage) {
        expect_refusal(draw("x.png", more), code, {line});
        EXPECT_FALSE(fs::exists(path("x.png"))) << line;
    };
    const auto alone = [&](const Words& more, const std::string& line, int code = usage) {
        Words all{"panorama", land, "--out", path("x.png")};
        all.insert(all.end(), more.begin(), more.end());
        expect_refusal(run_orograph(all), code, {line});
    };
    alone({}, "--at: is missing");
    alone({"--at", "36.53,-84.23", "--width", "0"}, "--width 0: must be between 100 and 50000");
    alone({"--at", "36.53,-84.23", "--width", "100000"}, "--width 100000: must be between 100 and 50000");
    alone({"--at", "36.53,-84.23", "--width", "50000", "--elevation", "-60,60"},
          "--width 50000: makes a scene of");
    alone({"--at", "36.53,-84.23", "--elevation", "-85,10"},
          "--elevation -85,10: each of the two must be between -75 and 75");
    alone({"--at", "36.53,-84.23", "--elevation", "10,-10"}, "--elevation 10,-10: is empty");
    alone({"--at", "36.53,-84.23", "--elevation", "nan,10"}, "--elevation nan,10: each of the two must be");
    alone({"--at", "36.53,-84.23", "--elevation", "high"}, "--elevation high: must be LOW,HIGH");
    alone({"--at", "nowhere"}, "--at nowhere");
    alone({"--at", "46.5,8.0"}, "no elevation data", no_data);
    refused({"--sector", "20"}, "--sector 20: must be FROM,TO in degrees");
    refused({"--sector", "20,20"}, "--sector 20,20: is empty");
    refused({"--sector", "20,400"}, "--sector 20,400: each of the two must be between -360 and 360");
    refused({"--heading", "20"}, "--heading: a panorama looks around at level height: give --sector");
    refused({"--look-at", "36.6,-84.3"}, "--look-at: a panorama looks around");
    refused({"--size", "100x100"}, "--size: give --width PX");
    refused({"--labels", "on"}, "--labels: a panorama has none");
    refused({"--tolerance", "1px"}, "--tolerance: is for shot");
    refused({"--ridges", "maybe"}, "--ridges maybe: choose on or off");
    refused({"--names", path("none.geojson")}, "none.geojson", failed);
    refused({"--style", "nothing"}, "no style is called 'nothing'");
    expect_refusal(draw("x.bmp"), usage,
                   {"x.bmp: the file's name must end in .png, .jpg, .jpeg, .tif, .tiff or .svg"});
    ASSERT_EQ(draw("p.png").exit_code, 0);
    expect_refusal(draw("p.png"), failed, {"p.png: is there already (--overwrite replaces it)"});
    expect_refusal(
        run_orograph({"panorama", "--view", path("p.png"), "--out", path("x.png"), "--sector", "1,2"}), usage,
        {"--sector: not together with --view"});
    expect_refusal(run_orograph({"panorama", land, "--at", "36.53,-84.23", "--out", land, "--overwrite"}),
                   usage, {land});
}

// Lines of ridges, of --overlay, and the looks of shot change the scene and nothing around it.
TEST_F(Panorama, HasLinesOverTheGround) {
    write_bytes(path("line.geojson"),
                R"({"type":"LineString","coordinates":[[-84.35,36.50],[-84.15,36.60]]})");
    ASSERT_EQ(draw("plain.png", {"--ridges", "off"}).exit_code, 0);
    ASSERT_EQ(draw("ridges.png").exit_code, 0);
    ASSERT_EQ(draw("lined.png", {"--ridges", "off", "--overlay", path("line.geojson"), "--overlay-colour",
                                 "#ff00ff", "--overlay-width", "3"})
                  .exit_code,
              0);
    const Pixels plain = pixels_of(path("plain.png")), ridges = pixels_of(path("ridges.png")),
                 lined = pixels_of(path("lined.png"));
    ASSERT_EQ(plain.rgb.size(), lined.rgb.size());
    EXPECT_NE(plain.rgb, ridges.rgb);
    int of_colour = 0;
    for (std::size_t i = 0; i < plain.rgb.size(); i += 3)
        of_colour += lined.rgb[i] > 200 && lined.rgb[i + 1] < 60 && lined.rgb[i + 2] > 200 ? 1 : 0;
    EXPECT_GT(of_colour, 200);
}

// Pixels of the scene whose colours are farther apart than a line over them would show.
std::size_t pixels_apart(const Pixels& one, const Pixels& other) {
    std::size_t apart = 0;
    for (std::size_t i = 0; i < one.rgb.size(); i += 3)
        apart += std::abs(one.rgb[i] - other.rgb[i]) + std::abs(one.rgb[i + 1] - other.rgb[i + 1]) +
                             std::abs(one.rgb[i + 2] - other.rgb[i + 2]) >
                         12
                     ? 1
                     : 0;
    return apart;
}

// Over a wooded slope. Lines of ridges change nothing else: neither grass nor trees, which they once left
// out.
TEST_F(Panorama, HasTreesWhereTheyAreAskedFor) {
    const auto seen = [&](const std::string& out, Words more) {
        more.insert(more.end(),
                    {"--style", "natural", "--width", "200", "--sector", "180,90", "--elevation", "-25,5",
                     "--time", "2026-01-01T00:00:00Z", "-q", "--json", "--out", path(out)});
        Words all{"panorama", land, "--at", "36.52,-84.24", "--above", "12"};
        all.insert(all.end(), more.begin(), more.end());
        return object_said_by(all);
    };
    const json usual = seen("usual.png", {"--ridges", "off"}),
               off = seen("off.png", {"--ridges", "off", "--trees", "off"}),
               on = seen("on.png", {"--ridges", "off", "--trees", "on"}),
               lined = seen("lined.png", {"--trees", "on"});
    EXPECT_EQ(usual["growth"]["trees"], "left out (--trees on draws them)");
    EXPECT_EQ(off["growth"]["trees"], "left out (--trees off)");
    EXPECT_EQ(on["growth"]["trees"], "invented, by a rule, where the ground cover is forest");
    EXPECT_EQ(on["growth"]["grass"], "invented, by a rule, within 60 m where the ground cover is meadow");
    const Pixels without = pixels_of(path("usual.png")), with = pixels_of(path("on.png")),
                 with_lines = pixels_of(path("lined.png"));
    EXPECT_EQ(without.rgb, pixels_of(path("off.png")).rgb);
    const std::size_t by_trees = pixels_apart(without, with), by_lines = pixels_apart(with, with_lines);
    std::printf("trees change %zu pixels of %zu, lines %zu\n", by_trees, with.rgb.size() / 3, by_lines);
    EXPECT_GT(by_trees, 2000U);
    EXPECT_LT(by_lines, by_trees / 10);
}

// A panorama from low inside a forest shows little but trees: found with not a word about it. A picture of
// the middle of it says much the same.
TEST_F(Panorama, SaysWhereTreesHideTheView) {
    const auto taken = [&](const Words& more) {
        Words all{"panorama", land,          "--at",     "36.52,-84.24", "--style",     "natural",
                  "--width",  "160",         "--sector", "180,80",       "--elevation", "-20,20",
                  "--json",   "--overwrite", "--out",    path("low.png")};
        all.insert(all.end(), more.begin(), more.end());
        return run_orograph(all);
    };
    const std::string said = "of the picture; --trees off shows the ground, and so does a greater --above";
    const auto low = taken({"--above", "3", "--trees", "on"});
    ASSERT_EQ(low.exit_code, 0) << low.err;
    EXPECT_NE(low.err.find(said), std::string::npos) << low.err;
    const json near_eye = json::parse(low.out).at("growth").value("near_eye", json::object());
    ASSERT_TRUE(near_eye.contains("share")) << low.out;
    EXPECT_EQ(near_eye["within_m"], 100.0);
    EXPECT_NE(near_eye["note"].get<std::string>().find(said), std::string::npos);
    const json shot = object_said_by({"shot", land, "--at", "36.52,-84.24", "--above", "3", "--heading",
                                      "220", "--fov", "40", "--size", "160x80", "--style", "natural", "-q",
                                      "--json", "--out", path("shot.png")});
    EXPECT_NEAR(near_eye["share"].get<double>(), shot["growth"]["near_eye"]["share"].get<double>(), 0.08);
    for (const Words& more : {Words{"--above", "3"}, Words{"--above", "3", "--trees", "off"},
                              Words{"--above", "300", "--trees", "on"}}) {
        const auto run = taken(more);
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(run.err.find(said), std::string::npos) << run.err;
        EXPECT_EQ(run.out.find("near_eye"), std::string::npos);
    }
}

// 2 m over a meadow lines of ridges leave the grass as it is.
TEST_F(Panorama, HasGrassNearTheEye) {
    const auto seen = [&](const std::string& out, const std::string& ridges, const std::string& style) {
        object_said_by({"panorama", land,      "--at", "36.65,-84.15", "--above", "2",           "--style",
                        style,      "--width", "120",  "--sector",     "0,60",    "--elevation", "-40,0",
                        "--ridges", ridges,    "-q",   "--json",       "--out",   path(out)});
        return pixels_of(path(out));
    };
    json bare = json::parse(bytes_of(oro::test::bundled_data() / "styles" / "natural.json"));
    bare["growth"]["grass"] = false;
    write_bytes(path("bare.json"), bare.dump());
    const Pixels grown = seen("grown.png", "off", "natural"), lined = seen("lined.png", "on", "natural"),
                 without = seen("bare.png", "off", path("bare.json"));
    const std::size_t by_grass = pixels_apart(without, grown), by_lines = pixels_apart(grown, lined);
    std::printf("grass changes %zu pixels of %zu, lines %zu\n", by_grass, grown.rgb.size() / 3, by_lines);
    EXPECT_GT(by_grass, 5000U);
    EXPECT_LT(by_lines, by_grass / 10);
}

// From a pole and over the antimeridian: all around there is ground, and azimuths count from the eye's
// meridian.
TEST_F(Panorama, GoesRoundPolesAndTheAntimeridian) {
    const auto raster = [&](const std::string& name, const Words& bounds) {
        Words all{"gdal_translate", "-q", "-a_srs", "EPSG:4326", "-a_ullr"};
        all.insert(all.end(), bounds.begin(), bounds.end());
        all.insert(all.end(), {land, path(name)});
        return run_program(all).exit_code == 0;
    };
    if (!raster("meridian.tif", {"179.7", "-16.5", "180.3", "-17.1"})) GTEST_SKIP() << "needs gdal_translate";
    ASSERT_TRUE(raster("pole.tif", {"-180", "90", "180", "89"}));
    write_bytes(path("east.geojson"), R"({"type":"FeatureCollection","features":[)" +
                                          feature("West", 179.9, -16.8) + "," +
                                          feature("East", -179.9, -16.8) + "]}");
    const json across =
        object_said_by({"panorama", path("meridian.tif"), "--at", "-16.8,180", "--above", "2000", "--width",
                        "400", "--names", path("east.geojson"), "-q", "--json", "--out", path("m.png")});
    ASSERT_EQ(across["names"]["named"].size(), 2U);
    for (const json& name : across["names"]["named"])
        EXPECT_NEAR(name["azimuth_deg"].get<double>(), name["name"] == "East" ? 90.0 : 270.0, 0.05);
    write_bytes(path("pole.geojson"),
                R"({"type":"FeatureCollection","features":[)" + feature("Along 30 E", 30.0, 89.9) + "]}");
    const json pole = object_said_by({"panorama", path("pole.tif"), "--at", "90,0", "--altitude", "2500",
                                      "--width", "400", "--elevation", "-40,5", "--names",
                                      path("pole.geojson"), "-q", "--json", "--out", path("pole.png")});
    // At the pole, with longitude 0, north of the local frame points along 180 degrees: 30 E is at 150.
    ASSERT_EQ(pole["names"]["named"].size(), 1U) << pole["names"].dump();
    EXPECT_NEAR(pole["names"]["named"][0]["azimuth_deg"].get<double>(), 150.0, 0.01);
}

}  // namespace
