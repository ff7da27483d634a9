// Measures of pictures whose errors are known: the truth itself, moved by so many pixels.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "core/base/parallel.h"
#include "core/measure/picture_errors.h"
#include "core/terrain/ground.h"
#include "core/truth/view_set.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

// Each pixel has what the truth has `by_px` away; with `bare`, the surface without its spires, ground that is
// on it stays where it is, and spires alone are moved.
class MovedTruth {
  public:
    MovedTruth(const TrueSurface& surface, const Sight& sight, const Camera& camera, const glm::dvec2& by_px,
               const TrueSurface* bare)
        : surface_(surface), oracle_(surface, sight), camera_(camera), by_px_(by_px) {
        if (bare) bare_.emplace(*bare, sight);
        for (int y = 0; y < camera.height_px; ++y)
            for (int x = 0; x < camera.width_px; ++x) add(x, y);
        for (int i = 0; i < skyline_samples; ++i)
            samples_.push_back({depths_[static_cast<std::size_t>(i)], {0.5, (i + 0.5) / skyline_samples}});
    }

    std::vector<DrawnPoint> points;
    [[nodiscard]] std::span<const DrawnDepths> samples() const { return samples_; }

  private:
    [[nodiscard]] DrawnPoint at(const glm::dvec2& point_px) const {
        const double reach_m = sight_reach_m(camera_.eye.h_m);
        glm::dvec3 ray = camera_.ecef_direction_at(point_px + by_px_);
        auto hit = oracle_.first_hit(ray, reach_m);
        if (bare_) {
            const auto without = bare_->first_hit(ray, reach_m);
            constexpr double before_m = 1.0;
            const bool spire = hit && (!without || hit->distance_m < without->distance_m - before_m);
            if (!spire) {
                ray = camera_.ecef_direction_at(point_px);
                hit = bare_->first_hit(ray, reach_m);
                // At the foot of a spire there is no bare ground.
                const auto here_m = hit ? surface_.h_m(hit->point.lat_deg, hit->point.lon_deg) : std::nullopt;
                if (here_m && *here_m > hit->point.h_m + 1.0e-3) hit = oracle_.first_hit(ray, reach_m);
            }
        }
        if (!hit) return {};
        const PostGrid& grid = surface_.field().grid;
        return {grid.lat.index_at(hit->point.lat_deg), grid.column_at(hit->point.lon_deg),
                -(camera_.view_from_ecef() * ray).z * hit->distance_m};
    }
    void add(int x, int y) {
        points.push_back(at({x + 0.5, y + 0.5}));
        for (int i = 0; i < skyline_samples; ++i) {
            const double z_m = at({x + 0.5, y + (i + 0.5) / skyline_samples}).z_m;
            depths_[static_cast<std::size_t>(i)].push_back(z_m > 0.0 ? static_cast<float>(near_plane_m / z_m)
                                                                     : 0.0F);
        }
    }

    const TrueSurface& surface_;
    Oracle oracle_;
    std::optional<Oracle> bare_;
    const Camera& camera_;
    glm::dvec2 by_px_;
    std::array<std::vector<float>, skyline_samples> depths_;
    std::vector<DrawnDepths> samples_;
};

// Rough ground with spires two posts wide, and round holes.
HeightField spiny_field() {
    HeightField field = test::rough_field(46.6, 8.2, 400, 500);
    std::mt19937 random(11);
    for (std::size_t i = 0; i < field.H_m.size(); ++i)
        if (random() % 60 == 0) field.H_m[i] += 600.0F;
    for (int row = 0; row < 400; ++row) {
        for (int column = 0; column < 500; ++column) {
            const double away = std::hypot(row % 133 - 66, column % 133 - 66);
            if (away < 40.0) field.H_m[static_cast<std::size_t>(row * 500 + column)] = void_height_m;
        }
    }
    return field;
}

// A plain at 500 m, and spires of one post on it; or none.
HeightField spires(bool bare) {
    std::mt19937 random(12);
    return test::made_field(46.6, 8.2, 1200.0, 400, 500, [&](double, double) {
        const bool spire = random() % 15 == 0;
        return 500.0F + (spire && !bare ? static_cast<float>(random() % 1500) : 0.0F);
    });
}

void expect_no_more_than_moved(const HeightField& field, std::uint64_t seed, int views,
                               const TrueSurface* bare = nullptr) {
    const TrueSurface surface(field, 1.0, thread_count());
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    double most = 0.0;
    for (const Camera& camera : made_cameras(seed, field, views, 48, 36)) {
        // Between spires that are seen from the side the plain's own distances change as much as from a spire
        // to the plain: what has come out beside one is looked for farther away (found: 1.6 times as far).
        if (bare && camera.attitude.pitch_deg > -30.0) continue;
        const Sight sight = sight_from(camera.eye, standard_air);
        const double by_px = 0.02 * std::pow(75.0, unit(random)), turn = 6.2831853 * unit(random);
        const MovedTruth drawn(surface, sight, camera, by_px * glm::dvec2(std::cos(turn), std::sin(turn)),
                               bare);
        const TruePicture truth(surface, sight, camera, thread_count());
        const PictureErrors errors = picture_errors(truth, drawn.points, drawn.samples(), thread_count());
        // Ground in line with the eye and the pixel's ray: to a float's rounding.
        EXPECT_LE(errors.ground.summary_displacement_px.largest, by_px + 1.0e-4);
        if (!bare) {
            EXPECT_GE(errors.ground.summary_displacement_px.largest, by_px - 1.0e-4);
        }
        // Searched for on circles, each 1.1 times the one before.
        EXPECT_LE(errors.seen.summary_px.largest, 1.1 * by_px + seen_resolution_px)
            << "eye " << camera.eye.lat_deg << "," << camera.eye.lon_deg << " h " << camera.eye.h_m;
        EXPECT_LE(errors.skyline.summary_px.largest, 1.1 * by_px + seen_resolution_px)
            << "eye " << camera.eye.lat_deg << "," << camera.eye.lon_deg << " h " << camera.eye.h_m;
        most = std::max(
            {most, errors.seen.summary_px.largest / by_px, errors.skyline.summary_px.largest / by_px});
    }
    std::printf("seed %llu, %d views: errors at most %.2f times what they are\n",
                static_cast<unsigned long long>(seed), views, most);
}

TEST(MovedTruth, NoMeasureFindsMoreThanItWasMovedBy) {
    expect_no_more_than_moved(spiny_field(), 77, 8);
}

TEST(MovedTruth, NorWhereSpiresAloneMove) {
    const HeightField plain = spires(true);
    const TrueSurface bare(plain, 1.0, thread_count());
    expect_no_more_than_moved(spires(false), 78, 8, &bare);
}

// Drawn 100 m ahead, truly almost beside the eye: 1,000 tangents and more away. 64 x 48 px have a diagonal of
// 80.
TEST(GroundMeter, NothingIsFartherOffThanThePictureIsWide) {
    const HeightField field = test::rough_field(46.6, 8.2, 20, 20);
    const TrueSurface surface(field, 1.0, 1);
    Camera camera;
    camera.eye = {46.6, 8.2, 5000.0};
    camera.width_px = 64, camera.height_px = 48;
    const Sight sight = sight_from(camera.eye);
    const GroundMeter meter(surface, sight, camera);
    const glm::dmat3 ecef_from_view = glm::transpose(camera.view_from_ecef());
    const glm::dvec3 ahead_m = ecef_from_view * glm::dvec3(0.0, 0.0, -100.0);
    EXPECT_EQ(meter.apart_px(ahead_m, ecef_from_view * glm::dvec3(100.0, 0.0, -0.1)), 80.0);
    EXPECT_EQ(meter.apart_px(ahead_m, ecef_from_view * glm::dvec3(1000.0, 0.0, 0.1)), 80.0);
    EXPECT_LT(meter.apart_px(ahead_m, ecef_from_view * glm::dvec3(1.0, 0.0, -100.0)), 1.0);
}

// 90 degrees high: 24 px for each unit of the tangent. Truly 1,000 tangents beside what is drawn ahead:
// 24,000 px, told as it is. Truly behind the picture's plane, where no picture has it: at least the diagonal.
TEST(GroundMeter, TellsHowFarOffWhatIsBesideThePictureIs) {
    const HeightField field = test::rough_field(46.6, 8.2, 20, 20);
    const TrueSurface surface(field, 1.0, 1);
    Camera camera;
    camera.eye = {46.6, 8.2, 5000.0};
    camera.vertical_fov_deg = 90.0;
    camera.width_px = 64, camera.height_px = 48;
    const Sight sight = sight_from(camera.eye);
    const GroundMeter meter(surface, sight, camera);
    const glm::dmat3 ecef_from_view = glm::transpose(camera.view_from_ecef());
    const glm::dvec3 ahead_m = ecef_from_view * glm::dvec3(0.0, 0.0, -100.0);
    const auto outside = meter.apart(ahead_m, ecef_from_view * glm::dvec3(100.0, 0.0, -0.1));
    EXPECT_NEAR(outside.px, 24000.0, 1.0e-3);
    EXPECT_FALSE(outside.at_least);
    const auto behind = meter.apart(ahead_m, ecef_from_view * glm::dvec3(1000.0, 0.0, 0.1));
    EXPECT_EQ(behind.px, 80.0);
    EXPECT_TRUE(behind.at_least);
}

// Half of 2^-11 m, and R hypot((t t + t t cos cos) / 8, sin (t t / 4 + t t cos / 8)) of t = 1 / 1200 degree
// from 46 to 47 degrees: 0.000247 m up and 0.000326 sideways, 0.00041 m. 1,303.7 px for a tangent at 2 m, and
// in the picture's corners 1.3091 of that (1, 0.41421 and 0.73638, root of the squares). Posts a degree
// apart: 485.7 m at the equator, 875.6 with a pole's sine; 0.14 % more at 9,000 m.
TEST(DrawingSlack, HasWhatFlatTrianglesLeaveOut) {
    Camera camera;
    camera.width_px = 1920, camera.height_px = 1080;
    const HeightField tile =
        test::made_field(47.0, 8.0, 1200.0, 1201, 2, [](double, double) { return 0.0F; });
    const double px = 1303.675 * 1.3091;
    EXPECT_NEAR(drawing_slack_px(camera, tile.grid, 2.0), 0.05 + (0.000244 + 0.000415) * px / 2.0, 0.01);
    const HeightField globe =
        test::made_field(90.0, -180.0, 1.0, 181, 2, [](double, double) { return 0.0F; });
    EXPECT_NEAR(drawing_slack_px(camera, globe.grid, 1.0e6), 0.05 + 1.0014 * 875.65 * px / 1.0e6, 0.003);
    EXPECT_EQ(drawing_slack_px(camera, globe.grid, 0.0), 0.05);
    // Ground that rises 20 m a metre: more by R 20 (t t + t t cos cos) / 4, 0.00997 m (cos of 46 degrees).
    EXPECT_NEAR(drawing_slack_px(camera, tile.grid, 2.0, 20.0) - 0.05, 0.0106 * px / 2.0, 0.0002 * px / 2.0);
}

}  // namespace
}  // namespace oro
