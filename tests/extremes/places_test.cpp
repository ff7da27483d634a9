// The places where longitude and latitude jump: poles, antimeridian, equator and Greenwich.
#include <GeographicLib/Geocentric.hpp>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "tests/extremes/accuracy_table.h"
#include "tests/extremes/stage.h"
#include "tests/support/made_terrain.h"

namespace oro::test {
namespace {

constexpr double waves = 8000.0, height_m = 150.0;  // hills of 5 km

double hills_m(double lat_deg, double lon_deg) {
    return globe_H_m(lat_deg, lon_deg, waves, height_m);
}

// Posts at 90.0 and every 93 m from there, up to 3 km from a pole.
HeightField polar_field(bool north, double columns_per_deg = 4.0) {
    HeightField field;
    constexpr int rows = 33;
    const int columns = static_cast<int>(360.0 * columns_per_deg) + 1;
    field.grid.lat = {1200.0, 0.0, north ? 108000 : -108000 + rows - 1, -1, rows};
    field.grid.lon = {columns_per_deg, 0.0, -columns / 2, +1, columns};
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column)
            field.H_m.push_back(
                static_cast<float>(0.6 * hills_m(field.grid.lat.at_deg(row), field.grid.lon.at_deg(column))));
    }
    return field;
}

HeightField field_from(double north_deg, double west_deg) {
    return made_field(north_deg, west_deg, 1200.0, 201, 201,
                      [](double lat, double lon) { return static_cast<float>(hills_m(lat, lon)); });
}
constexpr double half_field_deg = 100.0 / 1200.0;

class ExtremePlaces : public Extremes {
  protected:
    // As check_view; and how far the ground is from the surface, which along flat triangles it is not moved
    // from.
    static void check_pole(Stage& stage, const Camera& camera, RasterPath path, const char* row,
                           const char* wrong_row, int every) {
        const GroundErrors errors =
            check_view(stage, camera, path, "Places", row, wrong_row, every, GroundMeasures::both);
        measured("Places", std::string(row) + ", from the surface", errors.summary_surface_px.largest,
                 errors.summary_surface_px.count);
    }
};

TEST_F(ExtremePlaces, FlightAcrossThePoles) {
    for (const bool north : {true, false}) {
        Stage stage(*gpu_, polar_field(north));
        const double pole_deg = north ? 90.0 : -90.0;
        const double eye_h_m = stage.ground_h_m(pole_deg, 0.0) + 300.0;
        for (int step = -10; step <= 10; ++step) {
            // 25 m a step, along the meridians of 30 E and 150 W, over the pole itself in the middle.
            const double from_pole_deg = std::abs(step) * 25.0 / 111694.0;
            const Geodetic eye{north ? 90.0 - from_pole_deg : -90.0 + from_pole_deg, step < 0 ? 30.0 : -150.0,
                               eye_h_m};
            const Attitude ahead{(step < 0) == north ? 0.0 : 180.0, -35.0, 0.0};
            const Camera camera = strip_camera(eye, ahead);
            for (const RasterPath path : both_paths)
                check_pole(stage, camera, path, "flying across a pole", "flying across a pole, what is seen",
                           613);
        }
    }
}

TEST_F(ExtremePlaces, DownFromThePoles) {
    for (const bool north : {true, false}) {
        const double pole_deg = north ? 90.0 : -90.0;
        for (const double columns_per_deg : {4.0, 1.0}) {
            Stage stage(*gpu_, polar_field(north, columns_per_deg));
            const bool fine = columns_per_deg == 4.0;
            for (const double lon_deg : {0.0, 123.0}) {
                const Geodetic eye{pole_deg, lon_deg, stage.ground_h_m(pole_deg, 0.0) + 800.0};
                for (const RasterPath path : both_paths)
                    check_pole(stage, strip_camera(eye, {0.0, -90.0, 0.0}, 60.0), path,
                               fine ? "straight down on a pole" : "columns a degree apart at a pole",
                               fine ? "straight down on a pole, what is seen" : "", 409);
            }
        }
    }
}

// Where the mesh shader puts the posts near the pole, against GeographicLib; and the 361 posts at 90.0
// itself.
TEST_F(ExtremePlaces, PostsAtThePole) {
    for (const bool north : {true, false}) {
        Stage stage(*gpu_, polar_field(north));
        const HeightField& field = stage.field();
        Camera camera;
        camera.eye = {north ? 89.999 : -89.999, 45.0, stage.ground_h_m(north ? 90.0 : -90.0, 0.0) + 100.0};
        camera.attitude.pitch_deg = -90.0;
        camera.vertical_fov_deg = 110.0;
        camera.width_px = camera.height_px = 64;
        FramePlan plan = stage.plan(camera, {0, 0, 64, 64, {0.5, 0.5}}, 0.0);
        for (gpu::FramePage& page : plan.grids[0].pages) page.cull = 0;
        FrameRendererOptions options;
        options.extent = {64, 64};
        options.record_positions = true;
        auto renderer = FrameRenderer::create(*gpu_, options);
        ASSERT_TRUE(renderer.ok()) << renderer.error().line();
        ASSERT_TRUE(renderer->draw(plan, {}).ok());
        const auto recorded = renderer->recorded();
        const SineCosine lon = sine_cosine_deg(camera.eye.lon_deg);
        const glm::dmat3 ecef_from_eye(lon.cosine, lon.sine, 0.0, -lon.sine, lon.cosine, 0.0, 0.0, 0.0, 1.0);
        std::optional<gpu::vec3> at_pole;
        double worst_m = 0.0, apart_m = 0.0;
        std::uint64_t posts = 0, pole_posts = 0;
        for (std::size_t page = 0; page < plan.grids[0].pages.size(); ++page) {
            if (plan.grids[0].page_indices[page].level != 0) continue;
            for (int i = 0; i < 129 * 129; ++i) {
                const int row = plan.grids[0].page_indices[page].row * 128 + i / 129;
                const int column = plan.grids[0].page_indices[page].column * 128 + i % 129;
                if (row >= field.grid.rows() || column >= field.grid.columns()) continue;
                const double lat_deg = field.grid.lat.at_deg(row);
                const double from_pole_m = (90.0 - std::abs(lat_deg)) * 111694.0;
                if (from_pole_m > 2000.0) continue;
                const gpu::vec3 drawn = recorded[page * 129U * 129U + static_cast<std::size_t>(i)];
                glm::dvec3 truth;
                GeographicLib::Geocentric::WGS84().Forward(lat_deg, field.grid.lon.at_deg(column),
                                                           field.h_at_post_m(row, column), truth.x, truth.y,
                                                           truth.z);
                worst_m = std::max(
                    worst_m, glm::length(camera.eye_ecef().m + ecef_from_eye * glm::dvec3(drawn) - truth));
                ++posts;
                if (from_pole_m > 0.0) continue;
                if (!at_pole) at_pole = drawn;
                apart_m = std::max(apart_m, static_cast<double>(glm::length(drawn - *at_pole)));
                ++pole_posts;
            }
        }
        EXPECT_GT(posts, 7000U);
        EXPECT_GE(pole_posts, 1441U);
        measured("Places", "posts within 2 km of a pole", 1000.0 * worst_m, posts);
        measured("Places", "the 1,441 posts at a pole", apart_m, pole_posts);
    }
}

// Two frames of one view: pixels that differ in depth or triangle.
std::uint64_t different(const Stage::Drawn& one, const Stage::Drawn& other) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < one.depths.size(); ++i)
        count += one.depths[i] != other.depths[i] || one.ids[i] != other.ids[i] ? 1U : 0U;
    return count;
}

// The same place named in different ways draws the same picture, to the bit.
void same_by_names(Stage& stage, const std::vector<Geodetic>& names, const char* row) {
    for (const Attitude& attitude : {Attitude{70.0, -30.0, 0.0}, Attitude{0.0, -90.0, 0.0}}) {
        for (const RasterPath path : both_paths) {
            const auto first = stage.draw(strip_camera(names.front(), attitude), path);
            for (std::size_t i = 1; i < names.size(); ++i)
                measured(
                    "Places", row,
                    static_cast<double>(different(first, stage.draw(strip_camera(names[i], attitude), path))),
                    first.depths.size());
        }
    }
}

TEST_F(ExtremePlaces, Antimeridian) {
    // Of a region that crosses the antimeridian, and of one that ends at it on either side.
    for (const double west_deg : {180.0 - half_field_deg, 180.0 - 2.0 * half_field_deg, -180.0}) {
        Stage stage(*gpu_, field_from(-16.4, west_deg));
        const bool crosses = west_deg == 180.0 - half_field_deg;
        const double h_m = stage.ground_h_m(-16.45, west_deg + half_field_deg) + 350.0;
        if (crosses)
            same_by_names(stage, {{-16.45, 180.0, h_m}, {-16.45, -180.0, h_m}, {-16.45, 540.0, h_m}},
                          "the antimeridian as 180, -180 and 540");
        for (int step = -8; step <= 8; ++step) {
            const double at_deg = normalised_lon_deg(180.0 + step * 10.0 / 106700.0);
            const double heading_deg = crosses ? 100.0 : west_deg == -180.0 ? 90.0 : 270.0;
            const Camera camera = strip_camera({-16.45, at_deg, h_m}, {heading_deg, -25.0, 0.0});
            for (const RasterPath path : both_paths)
                check_view(stage, camera, path, "Places", "flying across the antimeridian",
                           "flying across the antimeridian, what is seen", 97);
        }
    }
}

TEST_F(ExtremePlaces, EquatorAndGreenwich) {
    Stage stage(*gpu_, field_from(half_field_deg, -half_field_deg));
    const double h_m = stage.ground_h_m(0.0, 0.0) + 350.0;
    same_by_names(stage,
                  {{0.0, 0.0, h_m}, {-0.0, 0.0, h_m}, {0.0, -0.0, h_m}, {-0.0, -0.0, h_m}, {0.0, 360.0, h_m}},
                  "0 N 0 E with each sign of its zeros");
    for (int step = -10; step <= 10; ++step) {
        const double off_deg = step * 5.0 / 111320.0;
        for (const RasterPath path : both_paths)
            check_view(stage, strip_camera({off_deg, -off_deg, h_m}, {315.0, -30.0, 0.0}), path, "Places",
                       "flying across the equator and Greenwich",
                       "flying across the equator and Greenwich, what is seen", 97);
    }
}

}  // namespace
}  // namespace oro::test
