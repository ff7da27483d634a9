// Surfaces that are hard to tell apart, hard to see, or hardly sampled.
#include <cmath>
#include <cstdio>
#include <string>

#include "core/truth/oracle.h"
#include "tests/core/truth/world_field.h"
#include "tests/extremes/accuracy_table.h"
#include "tests/extremes/stage.h"

namespace oro::test {
namespace {

constexpr const char* surfaces_group = "Surfaces and spacing";

class ExtremeSurfaces : public Extremes {};

// A cliff of 30 m within one cell of 0.1 m, along a meridian, seen from its own plane.
TEST_F(ExtremeSurfaces, WallEdgeOn) {
    constexpr double per_deg = 1.1e6;
    constexpr std::int64_t north = 51150000, west = 9350000;
    constexpr int rows = 301;
    Stage stage(*gpu_, world_field(per_deg, north, west, rows, 100, [&](double lat_deg, double lon_deg) {
        const auto row = north - std::lround(lat_deg * per_deg);
        return std::lround(lon_deg * per_deg) - west < 50 || row > rows - 10 ? 100.0 : 130.0;
    }));
    const PostGrid& grid = stage.field().grid;
    // Between the wall's two columns of posts, half way up, 5 m before the terrain's southern end.
    const Geodetic eye{grid.south_deg() - 5.0 / 111200.0, grid.lon.at_deg(49) + 0.5 / per_deg, 115.0};
    for (const int width_px : {31, 32}) {  // in the middle of a column of pixels, and between two
        for (const double aside_m : {0.0, 0.01, -0.04}) {
            Camera camera = strip_camera(eye, {0.0, -5.0, 0.0});
            camera.eye.lon_deg += aside_m / 77000.0;
            camera.width_px = width_px;
            for (const RasterPath path : both_paths) {
                const Stage::Drawn drawn = stage.draw(camera, path);
                const auto agreement = stage.agreement(camera, drawn.depths, 23);
                EXPECT_GT(agreement.ground, agreement.pixels / 4);
                measured(surfaces_group, "a wall of 30 m seen edge-on", static_cast<double>(agreement.wrong),
                         agreement.pixels);
            }
        }
    }
}

// Two walls along a parallel, 40 m high and, 1.0 to 1.4 m behind it, 80 m high, seen from 200 km.
TEST_F(ExtremeSurfaces, TwoSurfacesAMetreApart) {
    constexpr double per_deg = 162000.0;  // 0.686 m
    constexpr std::int64_t north = 7533000, west = 1377000;
    constexpr int rows = 24, front = 14, rear = 12;
    Stage stage(*gpu_, world_field(per_deg, north, west, rows, 300, [&](double lat_deg, double) {
        const auto row = static_cast<int>(north - std::lround(lat_deg * per_deg));
        return row == front ? 40.0 : row == rear ? 80.0 : 0.0;
    }));
    const PostGrid& grid = stage.field().grid;
    const Geodetic target{grid.lat.at_deg(front), grid.lon.at_deg(150), 20.0};
    const Geodetic eye{target.lat_deg - 200000.0 / 111150.0, target.lon_deg, 6000.0};
    Camera camera = strip_camera(eye, attitude_towards(eye, target), 0.05);
    camera.height_px = 1080;
    const Oracle oracle(stage.surface(), sight_from(eye));
    for (const RasterPath path : both_paths) {
        const Stage::Drawn drawn = stage.draw(camera, path);
        std::uint64_t wrong = 0, before_rear = 0;
        double worst_m = 0.0;
        const glm::dmat3 view_from_ecef = camera.view_from_ecef();
        for (int at = 0; at < camera.width_px * camera.height_px; ++at) {
            const glm::dvec2 centre(at % camera.width_px + 0.5, at / camera.width_px + 0.5);
            const glm::dvec3 ray = camera.ecef_direction_at(centre);
            const auto hit = oracle.first_hit(ray, 1e6);
            // On the front of the front wall: the rear one is at least 1 m behind.
            if (!hit || hit->row != front || hit->point.h_m > 39.0 || hit->point.h_m < 0.3) continue;
            ++before_rear;
            const float depth = drawn.depths[static_cast<std::size_t>(at)];
            const double drawn_m =
                depth == 0.0F ? 1e9 : near_plane_m / static_cast<double>(depth) / -(view_from_ecef * ray).z;
            wrong += std::abs(drawn_m - hit->distance_m) > 0.5 ? 1U : 0U;
            worst_m = std::max(worst_m, std::abs(drawn_m - hit->distance_m));
        }
        EXPECT_GT(before_rear, 5000U);
        measured(surfaces_group, "a wall 1 m before another, at 200 km", static_cast<double>(wrong), before_rear);
        measured(surfaces_group, "distance to a wall at 200 km", worst_m, before_rear);
    }
}

TEST_F(ExtremeSurfaces, Spacing) {
    struct Grid {
        const char* row;
        double per_deg;
        int side;
        bool on_picture;
    };
    for (const Grid& grid :
         {Grid{"posts 0.1 m apart", 1.1e6, 129, true}, Grid{"posts 1 second apart", 3600.0, 129, false},
          Grid{"posts 3 seconds apart", 1200.0, 129, false}, Grid{"posts 30 seconds apart", 120.0, 65, false},
          Grid{"posts 6 minutes apart", 10.0, 17, true}, Grid{"posts 1 degree apart", 1.0, 9, true}}) {
        const auto half = static_cast<std::int64_t>(grid.side / 2);
        // On the equator, where cells are widest. Slopes of 1 in 10 at most.
        const double spacing_m = 111320.0 / grid.per_deg;
        Stage stage(
            *gpu_, world_field(grid.per_deg, half, half, grid.side, grid.side, [&](double lat, double lon) {
                const double height_m = std::min(0.1 * spacing_m, 2000.0);
                return height_m * std::sin(lat * grid.per_deg * 0.7) * std::cos(lon * grid.per_deg * 0.6);
            }));
        const double width_m = (grid.side - 1) * spacing_m;
        const double middle_deg = static_cast<double>(grid.side / 2 + half) / grid.per_deg;
        const Geodetic eye{0.1 / grid.per_deg, middle_deg, 0.4 * width_m + 0.1 * spacing_m};
        Camera camera = strip_camera(eye, {30.0, -90.0, 0.0}, 80.0);
        const auto error =
            check_view(stage, camera, RasterPath::compute, surfaces_group, "", "", 7, GroundMeasures::both);
        const std::string row = grid.row;
        const auto& metres = error.summary_displacement_m;
        measured(surfaces_group, row, metres.largest, metres.count);
        if (grid.on_picture)
            measured(surfaces_group, row + ", on the picture", error.summary_displacement_px.largest, metres.count);
        if (grid.per_deg < 1e6)
            measured(surfaces_group, row + ", from the surface", error.summary_surface_m.largest, metres.count);
    }
}

}  // namespace
}  // namespace oro::test
