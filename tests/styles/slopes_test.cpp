// Hillshade, slope and aspect of drawn pictures against gdaldem on the same posts, and on a projected raster.
#include <ogr_srs_api.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "geo/opening/open_region.h"
#include "tests/styles/drawn_style.h"

namespace oro {
namespace {

using test::Band;
using test::gdaldem;
constexpr double to_deg = 180.0 / std::numbers::pi;

// Bytes that tell a value from 0 to 360 to 0.04: green goes up and down in 10, red in 30 (turning between the
// turns of green), blue once in 360.
glm::ivec3 bytes_of_value(double value) {
    const auto wave = [](double at, double ramp) {
        const double turns = at / ramp, part = turns - 2.0 * std::floor(turns / 2.0);
        return static_cast<int>(std::lround(255.0 * (part <= 1.0 ? part : 2.0 - part)));
    };
    return {wave(value + 25.0, 30.0), wave(value, 10.0),
            static_cast<int>(std::lround(255.0 * value / 360.0))};
}
double value_of_bytes(const glm::ivec3& bytes) {
    const auto nearest = [](double about, double ramp, double shift, double part) {
        double best = 1e9;
        const double first = std::floor((about + shift) / ramp);
        for (double k = first - 1.0; k <= first + 1.0; ++k) {
            const bool falls = std::fmod(std::abs(k), 2.0) == 1.0;
            const double value = ramp * (k + (falls ? 1.0 - part : part)) - shift;
            if (std::abs(value - about) < std::abs(best - about)) best = value;
        }
        return best;
    };
    const double coarse = nearest(bytes.z / 255.0 * 360.0, 30.0, 25.0, bytes.x / 255.0);
    return nearest(coarse, 10.0, 0.0, bytes.y / 255.0);
}

// A style whose bytes tell an angle.
std::string telling(const char* colour_by, const char* stop, double per_deg) {
    std::string tints;
    for (int value = 0; value <= 360; value += 5) {
        const glm::ivec3 bytes = bytes_of_value(value);
        std::array<char, 100> text{};
        std::snprintf(text.data(), text.size(), R"(%s{"%s": %g, "colour": "#%02x%02x%02x"})",
                      value > 0 ? "," : "", stop, value / per_deg, static_cast<unsigned>(bytes.x),
                      static_cast<unsigned>(bytes.y), static_cast<unsigned>(bytes.z));
        tints += text.data();
    }
    return R"({"colour_by": ")" + std::string(colour_by) + R"(", "tints": [)" + tints +
           R"(], "light": "none", "background": "#000000")" +
           (std::string(colour_by) == "aspect" ? R"(, "flat": "#ffffff"})" : "}");
}
const std::string hillshade =
    R"({"tints": [{"H_m": 0, "colour": "#ffffff"}], "light": "hillshade", "relief": 1,
        "sun": {"azimuth_deg": 315, "elevation_deg": 45}, "background": "#000000"})";

// Downhill (east, north), metres per metre, at each post, from what gdaldem says of it.
class GdalSlopes {
  public:
    // rows_per_column: gdaldem takes cells for squares when it computes an aspect; so many metres of a row's
    // spacing to one of a column's undo that.
    explicit GdalSlopes(const std::filesystem::path& raster, double rows_per_column = 1.0)
        : rows_per_column_(rows_per_column),
          slope_(gdaldem(raster, "slope").at(0)),
          aspect_(gdaldem(raster, "aspect").at(0)),
          shade_(gdaldem(raster, "hillshade").at(0)) {}

    // Linear between posts; nothing at the rim, where gdaldem says nothing.
    [[nodiscard]] std::optional<glm::dvec2> fall(double row, double column) const {
        const int north = static_cast<int>(std::floor(row)), west = static_cast<int>(std::floor(column));
        if (north < 1 || west < 1 || north > slope_.height - 3 || west > slope_.width - 3)
            return std::nullopt;
        const double south = row - north, east = column - west;
        return (1.0 - south) * ((1.0 - east) * at(north, west) + east * at(north, west + 1)) +
               south * ((1.0 - east) * at(north + 1, west) + east * at(north + 1, west + 1));
    }
    [[nodiscard]] const Band& shade() const { return shade_; }

  private:
    [[nodiscard]] glm::dvec2 at(int row, int column) const {
        const double slope = std::tan(slope_.at(row, column) / to_deg), aspect = aspect_.at(row, column);
        if (aspect < 0.0) return {0.0, 0.0};  // flat
        return slope * glm::normalize(glm::dvec2(std::sin(aspect / to_deg) * rows_per_column_,
                                                 std::cos(aspect / to_deg)));
    }
    double rows_per_column_;
    Band slope_, aspect_, shade_;
};

// What a picture was held against.
struct Held {
    int pixels{}, at_posts{};
    double worst{}, worst_at_posts{};
    void add(double off, bool at_post) {
        ++pixels;
        worst = std::max(worst, off);
        if (!at_post) return;
        ++at_posts;
        worst_at_posts = std::max(worst_at_posts, off);
    }
};

glm::ivec3 bytes_at(const DepthPicture& picture, std::size_t pixel) {
    return {picture.rgba[4 * pixel], picture.rgba[4 * pixel + 1], picture.rgba[4 * pixel + 2]};
}

// Where a drawn point is among the posts that gdaldem was given.
using RasterPlace = std::function<glm::dvec2(const DrawnPoint&)>;

// `error_of`: from the fall expected at a pixel and its bytes, how far off it is; nothing where it is not
// asked.
Held hold(const DepthPicture& picture, const GdalSlopes& truth, const RasterPlace& place,
          const std::function<std::optional<double>(const glm::dvec2&, const glm::ivec3&)>& error_of) {
    Held held;
    for (std::size_t pixel = 0; pixel < picture.points.size(); ++pixel) {
        if (picture.points[pixel].background()) continue;
        const glm::dvec2 at = place(picture.points[pixel]);
        const auto fall = truth.fall(at.x, at.y);
        if (!fall) continue;
        const auto off = error_of(*fall, bytes_at(picture, pixel));
        const glm::dvec2 from_post = at - glm::round(at);
        if (off) held.add(*off, glm::length(from_post) < 0.03);
    }
    return held;
}

std::optional<double> slope_off(const glm::dvec2& fall, const glm::ivec3& bytes) {
    return std::abs(value_of_bytes(bytes) / 4.0 - to_deg * std::atan(glm::length(fall)));
}
// Away from flat cells.
std::optional<double> aspect_off(const glm::dvec2& fall, const glm::ivec3& bytes) {
    if (glm::length(fall) < 0.02) return std::nullopt;
    const double off = value_of_bytes(bytes) - to_deg * std::atan2(fall.x, fall.y);
    return std::abs(off - 360.0 * std::round(off / 360.0));
}
// gdaldem's own formula on its own slopes.
std::optional<double> shade_off(const glm::dvec2& fall, const glm::ivec3& bytes) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(fall, 1.0));
    const double half = std::sqrt(0.5);
    const double cosine = glm::dot(normal, glm::dvec3(-half * half, half * half, half));
    EXPECT_EQ(bytes.x, bytes.y);
    return std::abs(bytes.x - std::max(1.0 + 254.0 * cosine, 1.0));
}

class Slopes : public test::StyleTest {
  protected:
    // Draws a region in the three styles. Largest differences: degrees of slope and aspect, and greys.
    void look(const char* what, const Region& region, const Camera& camera, const GdalSlopes& truth,
              const RasterPlace& place) {
        const auto picture_in = [&](const std::string& text) {
            const auto style = style_of(text, ".json", camera, region.grids[0].field);
            EXPECT_TRUE(style.ok()) << style.error().line();
            return style.ok() ? drawn(region, camera, *style) : std::nullopt;
        };
        const auto slope = picture_in(telling("slope", "slope_deg", 4.0));
        const auto aspect = picture_in(telling("aspect", "aspect_deg", 1.0));
        const auto shade = picture_in(hillshade);
        ASSERT_TRUE(slope && aspect && shade);
        const Held slopes = hold(*slope, truth, place, slope_off),
                   aspects = hold(*aspect, truth, place, aspect_off),
                   shades = hold(*shade, truth, place, shade_off);
        std::printf(
            "%s: %d pixels, %d of them at posts; slope off by up to %.3f (at posts %.3f) degrees, aspect "
            "%.3f (%.3f) degrees in %d pixels, hillshade %.2f (%.2f) of 255\n",
            what, slopes.pixels, slopes.at_posts, slopes.worst, slopes.worst_at_posts, aspects.worst,
            aspects.worst_at_posts, aspects.pixels, shades.worst, shades.worst_at_posts);
        EXPECT_GT(slopes.at_posts, 100);
        EXPECT_GT(aspects.pixels, slopes.pixels / 2);
        EXPECT_LE(slopes.worst, 0.1) << "degrees";
        EXPECT_LE(aspects.worst, 0.5) << "degrees";
        EXPECT_LE(shades.worst, 1.0) << "of 255";
        at_posts(*shade, truth, place);
    }

    // gdaldem's own bytes, in pixels at posts: from one post to the next a grey may change by 200.
    static void at_posts(const DepthPicture& shade, const GdalSlopes& truth, const RasterPlace& place) {
        int compared = 0;
        double worst = 0.0;
        for (std::size_t pixel = 0; pixel < shade.points.size(); ++pixel) {
            if (shade.points[pixel].background()) continue;
            const glm::dvec2 at = place(shade.points[pixel]), post = glm::round(at);
            if (!truth.fall(at.x, at.y) || glm::length(at - post) > 0.004) continue;
            ++compared;
            worst = std::max(worst,
                             std::abs(static_cast<double>(bytes_at(shade, pixel).x) -
                                      truth.shade().at(static_cast<int>(post.x), static_cast<int>(post.y))));
        }
        std::printf("gdaldem's own bytes: %d compared, off by up to %.0f\n", compared, worst);
        EXPECT_GT(compared, 30);
        EXPECT_LE(worst, 1.0) << "of gdaldem's bytes";
    }
};

// The bytes of a style tell an angle, or the test would see nothing.
TEST(StatedAngles, AreReadBack) {
    double worst = 0.0;
    for (double value = 0.0; value < 359.9; value += 0.01) {
        const double in_stops = value / 5.0, part = in_stops - std::floor(in_stops);
        const glm::dvec3 low(bytes_of_value(5.0 * std::floor(in_stops))),
            high(bytes_of_value(5.0 * std::floor(in_stops) + 5.0));
        worst = std::max(worst,
                         std::abs(value_of_bytes(glm::ivec3(glm::round(low + part * (high - low)))) - value));
    }
    EXPECT_LT(worst, 0.1) << "of 360";
}

// Hills of 20 to 60 posts, slopes to 60 degrees, and a level lake.
double hills_m(int row, int column, double post_m) {
    const double x = column * post_m, y = row * post_m;
    const double hills = 1500.0 +
                         4.0 * post_m * std::sin(2.0 * std::numbers::pi * (x + 0.4 * y) / (31.0 * post_m)) +
                         6.0 * post_m * std::cos(2.0 * std::numbers::pi * (y - 0.3 * x) / (47.0 * post_m)) +
                         0.6 * post_m * std::sin(2.0 * std::numbers::pi * (x * 1.7 + y) / (19.0 * post_m));
    return std::max(hills, 1500.0 - 4.0 * post_m);
}

TEST_F(Slopes, AreThoseOfGdaldemOnTheSamePosts) {
    constexpr double post_m = 30.0;
    constexpr int posts = 200;  // more than a page
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::square_field(
        46.5, 8.0, post_m, posts, [](int row, int column) { return hills_m(row, column, post_m); });
    const Camera camera = test::straight_down(region.grids[0].field, post_m, 190.0, 1100);
    look("the same posts", region, camera,
         GdalSlopes(test::local_raster(region.grids[0].field, post_m, post_m)),
         [](const DrawnPoint& point) { return glm::dvec2(point.row, point.column); });
}

// Real terrain, in whole metres, on its own grid of latitudes and longitudes: a part so low that a column's
// metres change by 0.05 % at most.
TEST_F(Slopes, AreThoseOfGdaldemOnTheBundledRegion) {
    RegionRequest request = test::request_for({(test::bundled_data() / "jacksboro.tif").string()});
    request.box = BoundingBox{-84.36, 36.50, -84.28, 36.58};
    const auto region = open_region(request);
    ASSERT_TRUE(region.ok()) << region.error().line();
    const PostGrid& grid = region->grids[0].field.grid;
    const test::MetresPerDegree degree =
        test::metres_per_degree(0.5 * (grid.north_deg() + grid.south_deg()), 500.0);
    const double column_m = degree.lon * grid.lon.spacing_deg(), row_m = degree.lat * grid.lat.spacing_deg();
    look("the bundled region", *region, test::straight_down(region->grids[0].field, row_m, 90.0, 1200),
         GdalSlopes(test::local_raster(region->grids[0].field, column_m, row_m), row_m / column_m),
         [](const DrawnPoint& point) { return glm::dvec2(point.row, point.column); });
}

// A raster in metres, 200 x 200 posts of waves.
constexpr double projected_m = 40.0;
constexpr int projected_posts = 200;
constexpr const char* projected_crs = "+proj=tmerc +lat_0=46.5 +lon_0=8 +k=1 +datum=WGS84 +units=m +type=crs";
test::Raster projected_raster() {
    constexpr double half_m = 0.5 * projected_posts * projected_m;
    test::Raster raster;
    raster.rows = raster.columns = projected_posts;
    raster.cell_corners = {-half_m, projected_m, 0.0, half_m, 0.0, -projected_m};
    raster.crs = projected_crs;
    return raster;
}
std::filesystem::path projected_file(const test::Raster& raster) {
    const std::filesystem::path file = test::scratch_folder() / "projected.tif";
    EXPECT_NE(test::write_raster(file, raster,
                                 [](int row, int column) {
                                     const double x = column * 2.0 * std::numbers::pi,
                                                  y = row * 2.0 * std::numbers::pi;
                                     return 1500.0 + 350.0 * std::sin((x + 0.4 * y) / 130.0) +
                                            300.0 * std::cos((y - 0.3 * x) / 110.0);
                                 }),
              "");
    return file;
}

// Its posts are the region's.
TEST_F(Slopes, AreThoseOfGdaldemOnARastersOwnPosts) {
    const std::filesystem::path file = projected_file(projected_raster());
    const auto region = open_region(test::request_for({file.string()}));
    ASSERT_TRUE(region.ok()) << region.error().line();
    ASSERT_TRUE(region->grids[0].field.grid.net);
    look("a raster's own posts", *region,
         test::straight_down(region->grids[0].field, projected_m, 180.0, 1000), GdalSlopes(file),
         [](const DrawnPoint& point) { return glm::dvec2(point.row, point.column); });
}

// The same, laid onto a grid of latitudes and longitudes.
TEST_F(Slopes, AreThoseOfGdaldemOnAProjectedRaster) {
    constexpr double post_m = projected_m;
    const std::string crs = projected_crs;
    const test::Raster raster = projected_raster();
    const std::filesystem::path file = projected_file(raster);
    RegionRequest request = test::request_for({file.string()});
    request.resample = true;
    const auto region = open_region(request);
    ASSERT_TRUE(region.ok()) << region.error().line();
    const OGRSpatialReferenceH to = OSRNewSpatialReference(nullptr), from = OSRNewSpatialReference(nullptr);
    OSRSetFromUserInput(to, crs.c_str());
    OSRSetFromUserInput(from, "EPSG:4326");
    OSRSetAxisMappingStrategy(from, OAMS_TRADITIONAL_GIS_ORDER);
    const OGRCoordinateTransformationH transform = OCTNewCoordinateTransformation(from, to);
    const PostGrid& grid = region->grids[0].field.grid;
    const auto place = [&](const DrawnPoint& point) {
        double x = grid.west_deg() + point.column * grid.lon.spacing_deg(),
               y = grid.north_deg() - point.row * grid.lat.spacing_deg();
        OCTTransform(transform, 1, &x, &y, nullptr);
        return glm::dvec2((raster.cell_corners[3] - y) / post_m - 0.5,
                          (x - raster.cell_corners[0]) / post_m - 0.5);
    };
    look("a projected raster", *region, test::straight_down(region->grids[0].field, post_m, 180.0, 1000),
         GdalSlopes(file), place);
    OCTDestroyCoordinateTransformation(transform);
    OSRDestroySpatialReference(from);
    OSRDestroySpatialReference(to);
}

// Level ground has no aspect, although the geoid falls by 1 m in a km below it: the style says what it is
// drawn in.
TEST_F(Slopes, LevelGroundTakesItsOwnColour) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::square_field(46.5, 8.0, 30.0, 60, [](int, int) { return 1500.0; });
    region.grids[0].field.undulation.lat = {1.0, 50.0, 0, -1, 8};
    region.grids[0].field.undulation.lon = {1.0, 5.0, 0, +1, 8};
    for (int row = 0; row < 8; ++row) {
        for (int column = 0; column < 8; ++column)
            region.grids[0].field.undulation.N_m.push_back(static_cast<float>(80.0 * column - 110.0 * row));
    }
    const Camera camera = test::straight_down(region.grids[0].field, 30.0, 40.0, 64);
    const auto style = style_of(telling("aspect", "aspect_deg", 1.0), ".json", camera, region.grids[0].field);
    ASSERT_TRUE(style.ok()) << style.error().line();
    const auto picture = drawn(region, camera, *style);
    ASSERT_TRUE(picture);
    for (std::size_t pixel = 0; pixel < picture->points.size(); ++pixel)
        ASSERT_EQ(bytes_at(*picture, pixel), glm::ivec3(255)) << pixel;
}

}  // namespace
}  // namespace oro
