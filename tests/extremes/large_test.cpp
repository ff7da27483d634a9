// 100 million posts; a quarter of them unless OROGRAPH_EXTREMES=full.
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "core/base/parallel.h"
#include "tests/extremes/accuracy_table.h"
#include "tests/extremes/stage.h"

namespace oro::test {
namespace {

constexpr const char* large_group = "Large data";

// Hills of 100 km down to 200 m on side x side posts of 3 seconds, up to 3,000 m.
HeightField large_field(int side) {
    HeightField field;
    field.grid.lat = {1200.0, 0.0, 1200 * 50, -1, side};
    field.grid.lon = {1200.0, 0.0, 1200 * 5, +1, side};
    constexpr int octaves = 8;
    const auto terms = [&](const GridAxis& axis, double phase) {
        std::vector<std::array<float, octaves>> all(static_cast<std::size_t>(side));
        for (int i = 0; i < side; ++i) {
            double scale = 6.0, height = 45.0;
            for (std::size_t k = 0; k < octaves; ++k) {
                all[static_cast<std::size_t>(i)][k] = static_cast<float>(
                    height * std::sin(scale * axis.at_deg(i) + phase * static_cast<double>(k)));
                scale *= 2.03;
                height *= 0.72;
            }
        }
        return all;
    };
    const auto rows = terms(field.grid.lat, 1.3), columns = terms(field.grid.lon, 0.7);
    field.H_m.resize(field.grid.post_count());
    in_parallel(side, thread_count(), [&](int row) {
        float* const to = field.H_m.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(side);
        for (int column = 0; column < side; ++column) {
            float H = 0.0F;
            for (std::size_t k = 0; k < octaves; ++k)
                H += rows[static_cast<std::size_t>(row)][k] * columns[static_cast<std::size_t>(column)][k];
            to[column] = H;
        }
    });
    return field;
}

class ExtremeSize : public Extremes {};

TEST_F(ExtremeSize, HundredMillionPosts) {
    const char* const wanted = std::getenv("OROGRAPH_EXTREMES");
    const bool full = wanted && std::strcmp(wanted, "full") == 0;
    const int side = full ? 10000 : 5000;
    Stage stage(*gpu_, large_field(side));
    const PostGrid& grid = stage.field().grid;
    const auto eye_at = [&](int row, int column, double above_m) {
        const double lat_deg = grid.lat.at_deg(row), lon_deg = grid.lon.at_deg(column);
        return Geodetic{lat_deg, lon_deg, stage.ground_h_m(lat_deg, lon_deg) + above_m};
    };
    const std::pair<Geodetic, Attitude> views[] = {
        {eye_at(side - 40, side - 50, 100.0), {315.0, -10.0, 0.0}},
        {eye_at(side / 2, side / 2, 2000.0), {20.0, -25.0, 0.0}},
        {eye_at(side / 2, side / 3, 400000.0), {70.0, -70.0, 0.0}}};
    for (const auto& [eye, attitude] : views) {
        const Camera camera = strip_camera(eye, attitude);
        const Stage::Drawn drawn = stage.draw(camera, RasterPath::compute, 1.0);
        const auto error = stage.ground(camera, drawn.points);
        EXPECT_GT(error.drawn, 10000U);
        measured(large_group, "100 million posts, --tau 1", error.summary_displacement_px.largest,
                 error.summary_displacement_px.count);
        const Stage::Drawn whole_detail = stage.draw(camera, RasterPath::compute, 0.02);
        const auto agreement = stage.agreement(camera, whole_detail.depths, 29);
        measured(large_group, "100 million posts, what is seen", static_cast<double>(agreement.wrong),
                 agreement.pixels);
    }
}

}  // namespace
}  // namespace oro::test
