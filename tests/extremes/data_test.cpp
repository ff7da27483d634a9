// Data that are hardly any, all alike, or no numbers.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/extremes/accuracy_table.h"
#include "tests/extremes/gpu_scan.h"
#include "tests/extremes/stage.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/made_terrain.h"
#include "tests/support/test_data.h"

namespace oro::test {
namespace {

constexpr const char* group = "No data, odd data";

class ExtremeData : public Extremes {
  protected:
    // Views of a field that has no surface: pixels with ground, of the picture's or of the oracle's.
    void expect_nothing(HeightField field, const char* row) {
        const double lat_deg = field.grid.lat.at_deg(field.grid.rows() / 2);
        const double lon_deg = field.grid.lon.at_deg(field.grid.columns() / 2);
        Stage stage(*gpu_, std::move(field));
        for (const double pitch_deg : {-90.0, -20.0}) {
            const Camera camera = strip_camera({lat_deg, lon_deg, 500.0}, {45.0, pitch_deg, 0.0});
            for (const double tau_px : {0.0, 1.0}) {
                for (const RasterPath path : both_paths) {
                    const Stage::Drawn drawn = stage.draw(camera, path, tau_px);
                    const auto ground = static_cast<std::uint64_t>(std::count_if(
                        drawn.depths.begin(), drawn.depths.end(), [](float d) { return d != 0.0F; }));
                    const auto agreement = stage.agreement(camera, drawn.depths, 61);
                    EXPECT_EQ(agreement.ground, 0U);
                    measured(group, row, static_cast<double>(ground), drawn.depths.size());
                }
            }
        }
    }

    // The middle of a field from `above_m`, steeply: the displacement is recorded in metres.
    void expect_surface(HeightField field, double above_m, const char* row, const char* wrong_row,
                        const char* px_row = "") {
        const PostGrid& grid = field.grid;
        const double lat_deg = 0.5 * (grid.north_deg() + grid.south_deg());
        const double lon_deg = 0.5 * (grid.west_deg() + grid.east_deg());
        Stage stage(*gpu_, std::move(field));
        const double h_m = stage.surface().h_m(lat_deg, lon_deg).value_or(0.0) + above_m;
        for (const double pitch_deg : {-90.0, -50.0}) {
            const Camera camera = strip_camera({lat_deg, lon_deg, h_m}, {45.0, pitch_deg, 0.0});
            for (const RasterPath path : both_paths) {
                const auto error = check_view(stage, camera, path, group, "", wrong_row, 17);
                if (*row)
                    measured(group, row, error.summary_displacement_m.largest,
                             error.summary_displacement_m.count);
                if (*px_row)
                    measured(group, px_row, error.summary_displacement_px.largest,
                             error.summary_displacement_px.count);
            }
        }
    }
};

TEST_F(ExtremeData, HardlyAny) {
    const auto slope = [](double lat, double lon) {
        return static_cast<float>(100.0 + 3000.0 * (lat - lon));
    };
    expect_nothing(made_field(10.0, 10.0, 1200.0, 1, 50, slope), "one row of posts, one column, one post");
    expect_nothing(made_field(10.0, 10.0, 1200.0, 50, 1, slope), "one row of posts, one column, one post");
    expect_nothing(made_field(10.0, 10.0, 1200.0, 1, 1, slope), "one row of posts, one column, one post");
    expect_nothing(made_field(10.0, 10.0, 1200.0, 140, 150, [](double, double) { return void_height_m; }),
                   "all void");
    // Every second post void: no triangle is left.
    int post = 0;
    expect_nothing(made_field(10.0, 10.0, 1200.0, 141, 151,
                              [&](double, double) { return post++ % 2 ? void_height_m : 100.0F; }),
                   "every second post void");
    expect_surface(made_field(10.0, 10.0, 1200.0, 2, 2, slope), 100.0, "two rows of two posts",
                   "two rows of two posts, what is seen");
    expect_surface(made_field(10.0, 10.0, 1200.0, 2, 300, slope), 100.0, "two rows of two posts",
                   "two rows of two posts, what is seen");
}

TEST_F(ExtremeData, AllEqual) {
    expect_surface(made_field(47.0, 10.0, 1200.0, 200, 200, [](double, double) { return 777.25F; }), 1000.0,
                   "all posts equal", "all posts equal, what is seen");
}

// Heights from -32,767 to 32,767 m in a field that no reader would give.
TEST_F(ExtremeData, SixteenBitsOfHeight) {
    HeightField field = made_field(47.0, 10.0, 600.0, 301, 301, [](double lat, double lon) {
        return static_cast<float>(std::round(32767.0 * std::sin(40.0 * lat) * std::cos(30.0 * lon)));
    });
    const auto [low, high] = std::minmax_element(field.H_m.begin(), field.H_m.end());
    *low = -32767.0F;
    *high = 32767.0F;
    expect_surface(std::move(field), 20000.0, "heights of +-32,767 m, in metres",
                   "heights of +-32,767 m, what is seen", "heights of +-32,767 m");
}

// What the readers make of stored values: posts that should be void and are not, or the other way round.
class ReadData : public ExtremeData {
  protected:
    void read(const std::string& file, const std::vector<bool>& good, const char* row, const char* seen_row) {
        for (const bool filled : {false, true}) {
            RegionRequest request = request_for({file});
            request.fill_voids = filled;
            std::string reason;
            const auto region = opened(request, &reason);
            ASSERT_TRUE(region) << reason;
            const std::vector<float>& H_m = region->field.H_m;
            ASSERT_EQ(H_m.size(), good.size());
            std::uint64_t wrong = 0;
            for (std::size_t i = 0; i < good.size(); ++i) {
                const bool fine = std::isfinite(H_m[i]) && H_m[i] > -500.0F && H_m[i] < 2000.0F;
                wrong += (good[i] || filled) ? (fine ? 0U : 1U) : (is_void(H_m[i]) ? 0U : 1U);
            }
            measured(group, row, static_cast<double>(wrong), good.size());
            expect_surface(region->field, 300.0, "", seen_row);
        }
    }
};

TEST_F(ReadData, NotANumberAndInfinity) {
    constexpr int side = 150;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                     inf = std::numeric_limits<double>::infinity();
    std::vector<bool> good;
    const auto height = [&](int r, int c) {
        const int kind = (r * 7 + c * 11) % 97;
        return kind == 0   ? nan
               : kind == 1 ? inf
               : kind == 2 ? -inf
               : kind == 3 ? -nan
               : kind == 4 ? 3.4e38
                           : 500.0 + r;
    };
    for (int i = 0; i < side * side; ++i) good.push_back(std::abs(height(i / side, i % side)) < 1e4);
    Raster raster;
    raster.rows = raster.columns = side;
    raster.cell_corners = posts_from(10.0, 47.0, 1200.0);
    const std::string file = write_raster(scratch_folder() / "nan.tif", raster, height);
    read(file, good, "float32 with NaN and infinities, as read",
         "float32 with NaN and infinities, what is seen");
}

TEST_F(ReadData, SixteenBits) {
    constexpr int side = 150;
    std::vector<bool> good;
    const auto height = [&](int r, int c) {
        const int kind = (r * 7 + c * 11) % 97;
        return kind == 0   ? 32767.0
               : kind == 1 ? -32767.0
               : kind == 2 ? -32768.0
               : kind == 3 ? 9001.0
                           : 500.0 + r;
    };
    for (int i = 0; i < side * side; ++i) good.push_back(std::abs(height(i / side, i % side)) < 1e3);
    Raster raster;
    raster.rows = raster.columns = side;
    raster.type = GDT_Int16;
    raster.cell_corners = posts_from(10.0, 47.0, 1200.0);
    const std::string file = write_raster(scratch_folder() / "int16.tif", raster, height);
    read(file, good, "16 bits with +-32,767 and 9,001 m, as read",
         "16 bits with +-32,767 and 9,001 m, what is seen");
}

}  // namespace
}  // namespace oro::test
