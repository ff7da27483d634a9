// The lowest and highest ground and eyes.
#include <cmath>

#include "tests/extremes/accuracy_table.h"
#include "tests/extremes/stage.h"
#include "tests/support/made_terrain.h"
#include "tests/support/rough_terrain.h"

namespace oro::test {
namespace {

constexpr const char* heights_group = "Heights and distances";

class ExtremeHeights : public Extremes {};

// From the deepest trench to the highest mountain within 11 km.
float trench_to_summit_m(double lat_deg, double lon_deg) {
    const double across = std::cos((lon_deg - 142.0) * 180.0 / 0.1 * 0.0174532925199433);
    return static_cast<float>(-1075.5 + 9924.5 * across +
                              3.0 * std::sin(9000.0 * lat_deg) * (1.0 - across * across));
}

TEST_F(ExtremeHeights, TrenchAndSummit) {
    Stage stage(*gpu_, made_field(11.5, 141.85, 1200.0, 301, 361, trench_to_summit_m));
    const HeightRange range = height_range(stage.field());
    EXPECT_NEAR(range.lowest_m, -11000.0F, 1.0F);
    EXPECT_NEAR(range.highest_m, 8849.0F, 1.0F);
    const Geodetic bottom{11.4, 141.9, stage.ground_h_m(11.4, 141.9) + 2.0};
    const Geodetic summit{11.4, 142.0, stage.ground_h_m(11.4, 142.0) + 2.0};
    for (const Attitude& attitude :
         {Attitude{90.0, 20.0, 0.0}, Attitude{180.0, 0.0, 0.0}, Attitude{0.0, -80.0, 0.0}}) {
        const auto error = check_view(stage, strip_camera(bottom, attitude, 80.0), RasterPath::compute, heights_group,
                                      "at -11,000 m", "at -11,000 m, what is seen", 29);
        measured(heights_group, "at -11,000 m, in metres", error.summary_displacement_m.largest,
                 error.summary_displacement_m.count);
    }
    for (const Attitude& attitude :
         {Attitude{90.0, -50.0, 0.0}, Attitude{180.0, -5.0, 0.0}, Attitude{0.0, -80.0, 0.0}}) {
        const auto error = check_view(stage, strip_camera(summit, attitude, 80.0), RasterPath::compute, heights_group,
                                      "at 8,849 m", "at 8,849 m, what is seen", 29);
        measured(heights_group, "at 8,849 m, in metres", error.summary_displacement_m.largest,
                 error.summary_displacement_m.count);
    }
}

TEST_F(ExtremeHeights, CloseAboveAPost) {
    Stage stage(*gpu_, rough_field(46.9, 8.1, 129, 129));
    const PostGrid& grid = stage.field().grid;
    for (const int post : {40, 64, 77}) {
        const Geodetic eye{grid.lat.at_deg(post), grid.lon.at_deg(post),
                           stage.field().h_at_post_m(post, post) + 0.05};
        const auto error = check_view(stage, strip_camera(eye, {0.0, -90.0, 0.0}), RasterPath::compute, heights_group,
                                      "0.05 m above a post, straight down", "");
        measured(heights_group, "0.05 m above a post, in metres", 1000.0 * error.summary_displacement_m.largest,
                 error.summary_displacement_m.count);
        for (const double heading_deg : {0.0, 120.0, 240.0}) {
            const Stage::Drawn drawn =
                stage.draw(strip_camera(eye, {heading_deg, -15.0, 0.0}), RasterPath::compute);
            // What half a step of height may change at 0.05 m is no fault of what is seen.
            const auto agreement =
                stage.agreement(strip_camera(eye, {heading_deg, -15.0, 0.0}), drawn.depths, 29, 8.0);
            measured(heights_group, "0.05 m above a post, what is seen", static_cast<double>(agreement.wrong),
                     agreement.pixels);
        }
    }
}

TEST_F(ExtremeHeights, PitBelowSeaLevel) {
    // 400 m below the ground around it, which lies 30 m below the ellipsoid itself.
    Stage stage(*gpu_, made_field(31.6, 35.4, 3600.0, 257, 257, [](double lat, double lon) {
        const double north_m = (lat - 31.565) * 110900.0, east_m = (lon - 35.435) * 94900.0;
        const double out = std::hypot(north_m, east_m) / 700.0;
        return static_cast<float>(-30.0 - 400.0 / (1.0 + out * out * out * out));
    }));
    const Geodetic eye{31.565, 35.435, stage.ground_h_m(31.565, 35.435) + 1.7};
    EXPECT_LT(eye.h_m, -420.0);
    for (const double heading_deg : {0.0, 77.0, 200.0}) {
        for (const double pitch_deg : {-20.0, 10.0})
            check_view(stage, strip_camera(eye, {heading_deg, pitch_deg, 0.0}), RasterPath::compute, heights_group,
                       "in a pit 430 m below the ellipsoid",
                       "in a pit 430 m below the ellipsoid, what is seen");
    }
}

TEST_F(ExtremeHeights, FromSpace) {
    Stage stage(*gpu_, made_field(48.0, 8.0, 240.0, 500, 700, [](double lat, double lon) {
        return globe_H_m(lat, lon, 1500.0, 1500.0);
    }));
    struct Look {
        const char* row;
        double h_m, fov_deg;
    };
    for (const Look& look :
         {Look{"from 36,000 km", 3.6e7, 0.3}, Look{"from the Moon's distance", 3.844e8, 0.05}}) {
        for (const double off_deg : {0.0, 30.0}) {
            const Geodetic eye{47.0 - off_deg, 9.5 + off_deg, look.h_m};
            Camera camera = strip_camera(eye, {}, look.fov_deg);
            camera.attitude = attitude_towards(eye, {47.0, 9.5, 0.0});
            const std::string seen = std::string(look.row) + ", what is seen";
            const std::string metres = std::string(look.row) + ", along the ray";
            const auto error = check_view(stage, camera, RasterPath::compute, heights_group, look.row, "");
            const Stage::Drawn drawn = stage.draw(camera, RasterPath::compute);
            // The ray's own length is known to a float only.
            const auto agreement = stage.agreement(camera, drawn.depths, 7, 0.1, 1e-7 * look.h_m);
            measured(heights_group, seen, static_cast<double>(agreement.wrong), agreement.pixels);
            if (off_deg == 0.0)
                measured(heights_group, metres, error.summary_displacement_m.largest,
                         error.summary_displacement_m.count);
        }
    }
}

}  // namespace
}  // namespace oro::test
