// Terrain with square cells drawn straight down in a style that a test wrote, and GDAL's programs for terrain
// on the same posts.
#pragma once

#include <cpl_string.h>
#include <gdal.h>
#include <gdal_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "apps/view/style.h"
#include "render/frame/depth_picture.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/drawn/region_scene.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/test_data.h"

namespace oro::test {

// Metres of one post to the next near a place, for WGS84 at a height. Source: radii of curvature of the
// ellipsoid, a = 6378137 m, 1/f = 298.257223563 (NIMA TR8350.2).
struct MetresPerDegree {
    double lat;
    double lon;
};
inline MetresPerDegree metres_per_degree(double lat_deg, double h_m) {
    constexpr double a = 6378137.0, f = 1.0 / 298.257223563, e2 = f * (2.0 - f);
    const double lat = lat_deg * std::numbers::pi / 180.0, w = 1.0 - e2 * std::sin(lat) * std::sin(lat);
    const double meridian = a * (1.0 - e2) / std::pow(w, 1.5), vertical = a / std::sqrt(w);
    return {(meridian + h_m) * std::numbers::pi / 180.0,
            (vertical + h_m) * std::cos(lat) * std::numbers::pi / 180.0};
}

// Posts on a lat/lon grid whose cells are squares of post_m in its middle, at 1,500 m.
inline HeightField square_field(double lat_deg, double lon_deg, double post_m, int posts,
                                const HeightOfPost& H_m) {
    const MetresPerDegree degree = metres_per_degree(lat_deg, 1500.0);
    HeightField field;
    const double rows_per_deg = degree.lat / post_m, columns_per_deg = degree.lon / post_m;
    field.grid.lat = {rows_per_deg, lat_deg + 0.5 * (posts - 1) / rows_per_deg, 0, -1, posts};
    field.grid.lon = {columns_per_deg, lon_deg - 0.5 * (posts - 1) / columns_per_deg, 0, +1, posts};
    for (int row = 0; row < posts; ++row) {
        for (int column = 0; column < posts; ++column)
            field.H_m.push_back(static_cast<float>(H_m(row, column)));
    }
    return field;
}

// Straight down from 100 km, with the middle `posts` posts of a side in the picture.
inline Camera straight_down(const HeightField& field, double post_m, double posts, int side_px) {
    Camera camera;
    constexpr double above_m = 100000.0;
    camera.eye = {0.5 * (field.grid.north_deg() + field.grid.south_deg()),
                  0.5 * (field.grid.west_deg() + field.grid.east_deg()), above_m + 1500.0};
    camera.attitude = {0.0, -90.0, 0.0};
    camera.vertical_fov_deg = 2.0 * std::atan(0.5 * post_m * posts / above_m) * 180.0 / std::numbers::pi;
    camera.width_px = camera.height_px = side_px;
    return camera;
}

// One band, row by row.
struct Band {
    int width{};
    int height{};
    std::vector<float> values;
    [[nodiscard]] float at(int row, int column) const {
        return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(column)];
    }
};

// What gdaldem makes of a raster: `mode` "hillshade", "slope", "aspect" or "color-relief".
inline std::vector<Band> gdaldem(const std::filesystem::path& raster, const char* mode,
                                 const char* colours = nullptr, char** words = nullptr) {
    start_gdal();
    const std::filesystem::path out = scratch_folder() / "out.tif";
    const GDALDatasetH source = GDALOpen(raster.c_str(), GA_ReadOnly);
    EXPECT_NE(source, nullptr) << raster;
    GDALDEMProcessingOptions* const options = GDALDEMProcessingOptionsNew(words, nullptr);
    int fault = 0;
    const GDALDatasetH made = GDALDEMProcessing(out.c_str(), source, mode, colours, options, &fault);
    EXPECT_NE(made, nullptr) << mode;
    std::vector<Band> bands;
    for (int b = 1; made && b <= GDALGetRasterCount(made); ++b) {
        Band band{GDALGetRasterXSize(made), GDALGetRasterYSize(made), {}};
        band.values.resize(static_cast<std::size_t>(band.width) * static_cast<std::size_t>(band.height));
        EXPECT_EQ(GDALRasterIO(GDALGetRasterBand(made, b), GF_Read, 0, 0, band.width, band.height,
                               band.values.data(), band.width, band.height, GDT_Float32, 0, 0),
                  CE_None);
        bands.push_back(std::move(band));
    }
    if (made) GDALClose(made);
    GDALDEMProcessingOptionsFree(options);
    GDALClose(source);
    return bands;
}

// A field's posts as a raster of metres, in no place.
inline std::filesystem::path local_raster(const HeightField& field, double column_m, double row_m) {
    Raster raster;
    raster.rows = field.grid.rows();
    raster.columns = field.grid.columns();
    raster.cell_corners = {0.0, column_m, 0.0, 0.0, 0.0, -row_m};
    raster.crs = "";
    const std::filesystem::path file = scratch_folder() / "posts.tif";
    EXPECT_NE(write_raster(file, raster, [&](int row, int column) { return field.H_at_post_m(row, column); }),
              "");
    return file;
}

class StyleTest : public GpuTest {
  protected:
    void TearDown() override {
        for (std::optional<DepthPainter>& painter : painters_) painter.reset();
        GpuTest::TearDown();
    }

    // A style from the text of a file.
    static Result<Style> style_of(const std::string& text, const char* ending, const Camera& camera,
                                  const HeightField& field, const std::optional<SunDirection>& sun = {}) {
        const std::filesystem::path file = scratch_folder() / ("style" + std::string(ending));
        std::ofstream(file) << text;
        View view;
        view.style = file.string();
        view.camera = camera;
        view.sun = sun;
        return load_style(view, field);
    }

    // The same bytes by both ways of drawing, but where a pixel's centre lies on the edge of two triangles
    // and they show it of one and of the other.
    static void hold_alike(const DepthPicture& mesh, const DepthPicture& compute) {
        ASSERT_EQ(mesh.points.size(), compute.points.size());
        std::size_t ties = 0, unlike = 0;
        for (std::size_t i = 0; i < mesh.points.size(); ++i) {
            const DrawnPoint &one = mesh.points[i], &other = compute.points[i];
            const bool same = one.row == other.row && one.column == other.column && one.z_m == other.z_m;
            const bool alike = std::equal(mesh.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i),
                                          mesh.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i + 4),
                                          compute.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i));
            ties += same ? 0U : 1U;
            unlike += same && !alike ? 1U : 0U;
        }
        EXPECT_EQ(unlike, 0U) << "pixels of mesh and compute differ";
        EXPECT_LE(ties, 8 + mesh.points.size() / 5000);
    }

    // By both ways of drawing. means: of the ground, for styles whose footprint is one.
    std::optional<DepthPicture> drawn(const Region& region, const Camera& camera, const Style& style,
                                      bool means = false) {
        std::optional<DepthPicture> first;
        for (const RasterPath path : {RasterPath::mesh, RasterPath::compute}) {
            auto scene = create_scene(*gpu_, region, {.means = means});
            EXPECT_TRUE(scene.ok()) << scene.error().line();
            if (!scene.ok()) return std::nullopt;
            DepthPictureOptions options;
            options.tau_px = 0.0;
            options.skyline = false;
            std::optional<DepthPainter>& painter = painters_[path == RasterPath::mesh ? 0 : 1];
            if (!painter) painter.emplace(*gpu_, path);
            auto picture = painter->draw(*scene, camera, style.frame, options);
            EXPECT_TRUE(picture.ok()) << picture.error().line();
            if (!picture.ok()) return std::nullopt;
            if (first) {
                hold_alike(*first, *picture);
            } else {
                first = std::move(*picture);
            }
        }
        return first;
    }

    // One for each way of drawing and all pictures: what they need is made once.
    std::array<std::optional<DepthPainter>, 2> painters_;
};

}  // namespace oro::test
