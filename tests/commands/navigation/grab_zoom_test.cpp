// Dragging and the wheel: what was under the cursor stays under it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "apps/navigation/grab.h"
#include "apps/navigation/zoom.h"
#include "core/earth/world_model.h"
#include "core/truth/oracle.h"
#include "core/truth/true_surface.h"
#include "tests/commands/navigation/smooth_world.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr double most_error_px = 0.5;  // issue: "the place under the cursor moves by at most 0.5 px"

using test::hill_at;
using test::hill_h_m;
using test::RandomEyes;
using test::shown_px;

// A random eye and what its picture has at a random pixel.
GrabStart random_start(RandomEyes& eyes) {
    for (;;) {
        const Camera camera = eyes.camera();
        const glm::dvec2 pressed_px = eyes.pixel(camera);
        const auto place = hill_at(camera, pressed_px);
        if (place) return {camera, pressed_px, place};
    }
}

TEST(GrabZoom, TheGrabbedPlaceStaysUnderTheCursor) {
    constexpr unsigned seed = 49;
    std::printf("seed %u\n", seed);
    RandomEyes eyes(seed);
    double most_px = 0.0;
    int reached = 0, turned = 0;
    for (int i = 0; i < 200; ++i) {
        const GrabStart start = random_start(eyes);
        const glm::dvec2 cursor_px = eyes.pixel(start.camera);
        const Camera there = grabbed(start, cursor_px, hill_h_m);
        ASSERT_TRUE(test::is_sound(there)) << i;
        EXPECT_EQ(there.attitude.roll_deg, 0.0) << i;
        const bool moves = grab_moves_eye(start);
        turned += moves ? 0 : 1;
        // The cursor may be where the place can never be: what it points at is then sky, or seen flatly.
        if (moves && !moved_to_hold(start.camera, *start.place, cursor_px).exact) {
            const auto beyond = hill_at(start.camera, cursor_px);
            const GrabStart flat{start.camera, cursor_px, beyond};
            EXPECT_FALSE(grab_moves_eye(flat)) << i;
            continue;
        }
        ++reached;
        const double error_px = glm::distance(shown_px(there, *start.place), cursor_px);
        EXPECT_LE(error_px, most_error_px)
            << i << " h " << start.camera.eye.h_m << " lat " << start.camera.eye.lat_deg << " pitch "
            << start.camera.attitude.pitch_deg;
        most_px = std::max(most_px, error_px);
    }
    std::printf("grab: at most %.2g px over %d gestures within reach, %d of them by turning alone\n", most_px,
                reached, turned);
    EXPECT_GE(reached, 100);
    EXPECT_LT(most_px, 0.05);
}

TEST(GrabZoom, MovingKeepsHeightAndPitch) {
    RandomEyes eyes(50);
    for (int i = 0; i < 100; ++i) {
        const GrabStart start = random_start(eyes);
        if (!grab_moves_eye(start)) continue;
        const Holding moved = moved_to_hold(start.camera, *start.place, eyes.pixel(start.camera));
        if (!moved.exact) continue;
        EXPECT_EQ(moved.camera.eye.h_m, start.camera.eye.h_m) << i;
        EXPECT_EQ(moved.camera.attitude.pitch_deg, start.camera.attitude.pitch_deg) << i;
    }
}

TEST(GrabZoom, ACursorThatComesBackBringsTheViewBack) {
    RandomEyes eyes(51);
    for (int i = 0; i < 20; ++i) {
        const GrabStart start = random_start(eyes);
        const Camera there = grabbed(start, start.pressed_px, hill_h_m);
        EXPECT_EQ(there.eye.lat_deg, start.camera.eye.lat_deg);
        EXPECT_EQ(there.attitude.heading_deg, start.camera.attitude.heading_deg);
    }
}

// From the ground up into the sky, pixel by pixel: no step moves the eye by more than the tenth of its
// distance to the place that a pixel of a line of sight of 1 degree is (1 px is 0.075 degree here), and none
// turns it over.
TEST(GrabZoom, ACursorInTheSkyStopsThePictureSmoothly) {
    Camera camera;
    camera.eye = {46.5, 8.0, 3000.0};
    camera.attitude = {30.0, -10.0, 0.0};
    camera.width_px = 960, camera.height_px = 600;
    const glm::dvec2 pressed_px(480.0, 550.5);
    const GrabStart start{camera, pressed_px, hill_at(camera, pressed_px)};
    ASSERT_TRUE(grab_moves_eye(start));
    Camera last = camera;
    for (double y_px = 550.5; y_px > -200.0; y_px -= 1.0) {
        const Camera there = grabbed(start, {480.0, y_px}, hill_h_m);
        const double distance_m = glm::distance(there.eye_ecef().m, start.place->m);
        const double step_m = glm::distance(there.eye_ecef().m, last.eye_ecef().m);
        EXPECT_LT(step_m, 0.1 * distance_m) << y_px;
        EXPECT_LT(std::abs(std::remainder(there.attitude.heading_deg - 30.0, 360.0)), 10.0) << y_px;
        last = there;
    }
    const Camera higher = grabbed(start, {480.0, -400.0}, hill_h_m);
    EXPECT_NEAR(glm::distance(higher.eye_ecef().m, last.eye_ecef().m), 0.0, 0.01);
    // h 3,000 m over a place at some 500 m that is seen at 1 degree: 2500 / sin 1 = 143 km, less for the
    // curvature.
    const double reach_m = glm::distance(last.eye_ecef().m, start.place->m);
    EXPECT_GT(reach_m, 7e4);
    EXPECT_LT(reach_m, 1.5e5);
}

TEST(GrabZoom, TheZoomedPlaceStaysUnderTheCursor) {
    constexpr unsigned seed = 52;
    std::printf("seed %u\n", seed);
    RandomEyes eyes(seed);
    double most_px = 0.0;
    int moved = 0;
    for (int i = 0; i < 200; ++i) {
        const GrabStart start = random_start(eyes);
        const double factor = std::exp(eyes.between(std::log(0.2), std::log(5.0)));
        const Camera there = zoomed(start.camera, *start.place, factor, hill_h_m);
        ASSERT_TRUE(test::is_sound(there)) << i;
        EXPECT_EQ(there.attitude.roll_deg, 0.0) << i;
        const double error_px = glm::distance(shown_px(there, *start.place), start.pressed_px);
        EXPECT_LE(error_px, most_error_px) << i << " factor " << factor << " h " << start.camera.eye.h_m
                                           << " pitch " << start.camera.attitude.pitch_deg;
        most_px = std::max(most_px, error_px);
        const double was_m = glm::distance(start.camera.eye_ecef().m, start.place->m);
        const double is_m = glm::distance(there.eye_ecef().m, start.place->m);
        moved += std::abs(is_m / was_m / factor - 1.0) < 0.01 ? 1 : 0;
        EXPECT_GE(is_m, std::min(was_m, least_zoom_m) - 1e-6) << i;
        EXPECT_LE(is_m, std::max(was_m, most_zoom_m) * 1.001) << i;
    }
    std::printf("zoom: at most %.2g px over 200 gestures, %d of them as far as asked\n", most_px, moved);
    EXPECT_LT(most_px, 0.05);
    EXPECT_GE(moved, 170);
}

// A wheel turned 60 notches nearer and 120 away, from each of many eyes.
TEST(GrabZoom, ManyNotchesStayWithinTheLimits) {
    RandomEyes eyes(53);
    for (int i = 0; i < 20; ++i) {
        const GrabStart start = random_start(eyes);
        Camera camera = start.camera;
        for (int notch = 0; notch < 180; ++notch) {
            camera = zoomed(camera, *start.place, notch < 60 ? 0.85 : 1.0 / 0.85, hill_h_m);
            ASSERT_TRUE(test::is_sound(camera)) << i;
            ASSERT_LE(glm::distance(shown_px(camera, *start.place), start.pressed_px), most_error_px)
                << i << " notch " << notch;
            const double distance_m = glm::distance(camera.eye_ecef().m, start.place->m);
            ASSERT_GE(distance_m, 1.6) << i << " notch " << notch;
            ASSERT_LE(distance_m, 1.01 * most_zoom_m);
        }
    }
}

TEST(GrabZoom, HoldsWhatTheAirBends) {
    RandomEyes eyes(54);
    for (int i = 0; i < 100; ++i) {
        const GrabStart start = random_start(eyes);
        if (start.camera.eye.h_m > 1e5) continue;
        const glm::dvec2 held_px = *pixel_of(start.camera, *start.place, standard_air);
        const Camera zoom = zoomed(start.camera, *start.place, 0.7, hill_h_m, standard_air);
        EXPECT_LT(glm::distance(*pixel_of(zoom, *start.place, standard_air), held_px), 0.05) << i;
        const glm::dvec2 cursor_px = held_px + glm::dvec2(20.0, 30.0);
        const Camera grab = grabbed({start.camera, held_px, start.place}, cursor_px, hill_h_m, standard_air);
        if (grab_moves_eye(start) &&
            !moved_to_hold(start.camera, *start.place, cursor_px, standard_air).exact)
            continue;
        EXPECT_LT(glm::distance(*pixel_of(grab, *start.place, standard_air), cursor_px), 0.05) << i;
    }
}

// The oracle of pictures picks the place, and finds it again at the cursor, unless a ridge has come between.
TEST(GrabZoom, TheOracleFindsThePlaceAtTheCursor) {
    const HeightField field = test::rough_field(46.9, 8.1, 300, 300);
    const TrueSurface surface(field, 1.0, 1);
    const auto ground = [&](double lat_deg, double lon_deg) { return surface.h_m(lat_deg, lon_deg); };
    const auto pick = [&](const Camera& camera, glm::dvec2 point_px) {
        return first_hit(surface, sight_from(camera.eye), camera.ecef_direction_at(point_px), 1e6);
    };
    constexpr unsigned seed = 55;
    std::printf("seed %u\n", seed);
    RandomEyes eyes(seed);
    int found = 0, asked = 0;
    for (int i = 0; i < 200; ++i) {
        Camera camera;
        camera.eye = {eyes.between(46.68, 46.88), eyes.between(8.12, 8.32), eyes.between(3600.0, 9000.0)};
        camera.attitude = {eyes.between(0.0, 360.0), eyes.between(-90.0, -15.0), 0.0};
        camera.width_px = 960, camera.height_px = 600;
        const glm::dvec2 from_px = eyes.pixel(camera);
        const auto hit = pick(camera, from_px);
        if (!hit) continue;
        const Ecef place = ecef_from_geodetic(hit->point);
        const glm::dvec2 to_px = i % 2 == 0 ? from_px : from_px + 0.3 * (eyes.pixel(camera) - from_px);
        const Camera there = i % 2 == 0 ? zoomed(camera, place, eyes.between(0.4, 1.5), ground)
                                        : grabbed({camera, from_px, place}, to_px, ground);
        const auto again = pick(there, to_px);
        if (!again) continue;
        ++asked;
        const double apart_px =
            glm::distance(shown_px(there, ecef_from_geodetic(again->point)), shown_px(there, place));
        EXPECT_LE(apart_px, most_error_px) << i;
        found += glm::distance(ecef_from_geodetic(again->point).m, place.m) < 0.01 ? 1 : 0;
    }
    std::printf("oracle: %d of %d found again\n", found, asked);
    EXPECT_GE(asked, 100);
    EXPECT_GE(found, asked * 9 / 10);
}

}  // namespace
}  // namespace oro
