// Which effects a drawing has, what they sum to, and that bounds hold all over a picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <glm/geometric.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/effects/effects.h"
#include "core/measure/ground_error.h"
#include "core/truth/view_set.h"
#include "tests/core/effects/effect_scene.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

using test::half_way_down, test::sea_level, test::undulation;
using Scene = test::EffectScene;

// A picture of rough ground, 90 km of it, from above its summits.
Camera over_rough_ground() {
    Camera camera;
    camera.eye = {46.95, 8.05, 4500.0};
    camera.attitude = {140.0, -8.0, 10.0};
    camera.vertical_fov_deg = 40.0;
    camera.width_px = 320;
    camera.height_px = 180;
    return camera;
}

TEST(EffectBounds, DetailGrowsWithTauAndNeverBeyondIt) {
    const Scene scene(test::rough_field(47.0, 8.0, 385, 513), over_rough_ground());
    const EffectSize none = scene.size(EffectKind::detail, 0.0);
    EXPECT_EQ(none.worst_m, 0.0);
    EXPECT_EQ(none.worst_px, 0.0);
    EffectSize last;
    for (const double tau_px : {0.25, 0.5, 1.0, 2.0, 4.0, 16.0}) {
        const EffectSize size = scene.size(EffectKind::detail, tau_px);
        std::printf("tau %.2f px: worst %.3f px %.3f m, typical %.3f px %.3f m\n", tau_px, size.worst_px,
                    size.worst_m, size.typical_px, size.typical_m);
        // And what moves along the surface: here millimetres, the more the higher what is left out.
        EXPECT_LE(size.worst_px, tau_px + 0.001 + 1.0e-4 * tau_px);
        EXPECT_LE(size.typical_px, size.worst_px);
        EXPECT_GE(size.worst_px, last.worst_px);
        EXPECT_GE(size.worst_m, last.worst_m);
        EXPECT_GE(size.typical_m, last.typical_m);
        last = size;
    }
    EXPECT_GT(last.worst_px, 1.0);
}

DrawingModel balanced() {
    DrawingModel drawing;
    drawing.world.air = standard_air;
    return drawing;
}

TEST(EffectBounds, AreInTheDrawingsThatLeaveThingsOut) {
    const EarthParameters world;
    const auto in = [&](const DrawingModel& drawing) {
        std::vector<EffectKind> kinds;
        for (const EffectFacts& effect : effect_table()) {
            if (is_in_picture(effect.kind, drawing, world)) kinds.push_back(effect.kind);
        }
        return kinds;
    };
    using enum EffectKind;
    using Kinds = std::vector<EffectKind>;
    const DrawingModel usual = balanced();
    EXPECT_EQ(in(usual),
              (Kinds{detail, steps_f32, placement, depth, pixel_grid, flat_cells, interpolation, source}));
    DrawingModel drawing = usual;
    drawing.geoid = false;
    drawing.tau_px = 0.0;
    EXPECT_EQ(in(drawing),
              (Kinds{geoid, steps_f32, placement, depth, pixel_grid, flat_cells, interpolation, source}));
    drawing = usual;
    drawing.world = {Earth::sphere, {}, Precision::rounded_posts};
    EXPECT_EQ(in(drawing), (Kinds{sphere, refraction, float32_posts, detail, steps_f32, depth, pixel_grid,
                                  flat_cells, interpolation, source}));
    drawing = usual;
    drawing.world = {Earth::flat, standard_air, Precision::naive};
    drawing.coding = {true, 3, 0};
    EXPECT_EQ(in(drawing), (Kinds{flat, float32_view, steps_i16, detail, depth, pixel_grid, flat_cells,
                                  interpolation, source}));
}

// A flat Earth is no ellipsoid either: the picture has neither, though only the plane's error counts.
TEST(EffectBounds, WhatALargerEffectContainsIsNotModelled) {
    const EarthParameters world;
    const auto not_modelled = [&](const DrawingModel& drawing) {
        std::vector<EffectKind> kinds;
        for (const EffectFacts& effect : effect_table()) {
            if (effect.group == EffectGroup::model && !is_modelled(effect.kind, drawing, world))
                kinds.push_back(effect.kind);
        }
        return kinds;
    };
    using enum EffectKind;
    using Kinds = std::vector<EffectKind>;
    DrawingModel drawing = balanced();
    EXPECT_EQ(not_modelled(drawing), (Kinds{detail}));
    drawing.world = {Earth::sphere, standard_air, Precision::rounded_posts};
    EXPECT_EQ(not_modelled(drawing), (Kinds{sphere, float32_posts, detail}));
    drawing.world = {Earth::flat, {}, Precision::naive};
    drawing.tau_px = 0.0;
    EXPECT_EQ(not_modelled(drawing), (Kinds{sphere, flat, refraction, float32_posts, float32_view}));
}

// One table: every effect has a name of its own, a key of its own and a sentence.
TEST(EffectTable, SaysAllOfEveryEffect) {
    std::set<std::string> keys, names;
    for (const EffectFacts& effect : effect_table()) {
        SCOPED_TRACE(effect.key);
        EXPECT_EQ(&facts_of(effect.kind), &effect);
        EXPECT_TRUE(keys.insert(effect.key).second);
        EXPECT_TRUE(names.insert(effect.name).second);
        EXPECT_TRUE(std::string(effect.meaning).ends_with("."));
        EXPECT_EQ(error_name(effect.kind).starts_with("no "), effect.group == EffectGroup::model);
        EXPECT_TRUE(*effect.left_out_by == '\0' || effect.group == EffectGroup::model);
        EXPECT_TRUE(!effect.contained_in || facts_of(*effect.contained_in).group == EffectGroup::model);
    }
    EXPECT_EQ(keys.size(), effect_kinds);
}

// The sum of what is in, but for what no drawing can help.
TEST(EffectBounds, TotalIsTheSum) {
    EarthParameters world;
    world.grids.front().source_le90_m = 16.0;
    world.grids.front().sixteen = sixteen_bits(height_steps(-1000.0), height_steps(5000.0));
    HeightField field = test::rough_field(0.3, 0.2, 241, 241);
    field.undulation = undulation(10.0, 40.0);
    Camera camera = over_rough_ground();
    camera.eye = {0.25, 0.25, 4500.0};
    camera.width_px = 64;
    camera.height_px = 36;
    const Scene scene(std::move(field), camera, world);
    DrawingModel drawing = balanced();
    drawing.tau_px = 2.0;
    for (int i = 0; i < 8; ++i) {
        drawing.geoid = (i & 1) == 0;
        drawing.world.earth = (i & 2) == 0 ? Earth::ellipsoid : Earth::sphere;
        drawing.coding = (i & 4) == 0 ? HeightQuantization{} : world.grids.front().sixteen;
        EffectSize sum;
        for (const EffectFacts& effect : effect_table()) {
            const EffectKind kind = effect.kind;
            if (kind == EffectKind::interpolation || kind == EffectKind::source ||
                !is_in_picture(kind, drawing, world))
                continue;
            const EffectSize one = scene.size(kind, 2.0);
            EXPECT_GT(one.worst_m, 0.0) << facts_of(kind).name;
            EXPECT_GE(one.worst_m, one.typical_m) << facts_of(kind).name;
            EXPECT_GE(one.worst_px, one.typical_px) << facts_of(kind).name;
            sum.worst_m += one.worst_m;
            sum.typical_m += one.typical_m;
            sum.worst_px += one.worst_px;
            sum.typical_px += one.typical_px;
        }
        const auto total = scene.prediction.total(drawing);
        ASSERT_TRUE(total.ok());
        EXPECT_NEAR(total.value().worst_m, sum.worst_m, 1e-9 * sum.worst_m);
        EXPECT_NEAR(total.value().typical_m, sum.typical_m, 1e-9 * sum.typical_m);
        EXPECT_NEAR(total.value().worst_px, sum.worst_px, 1e-9 * sum.worst_px);
        EXPECT_NEAR(total.value().typical_px, sum.typical_px, 1e-9 * sum.typical_px);
    }
}

// Nothing but sky: sizes of 0, none of them no number.
TEST(EffectBounds, OfTheSkyThereAreNone) {
    EarthParameters world;
    world.grids.front().source_le90_m = 16.0;
    Camera camera = half_way_down();
    camera.attitude.pitch_deg = 60.0;
    camera.width_px = 40;
    camera.height_px = 30;
    HeightField field = sea_level();
    field.undulation = undulation(10.0, 40.0);
    const Scene scene(std::move(field), camera, world);
    EXPECT_TRUE(scene.prediction.empty());
    EXPECT_FALSE(std::isnan(scene.prediction.nearest_m()));
    EXPECT_FALSE(std::isnan(scene.prediction.median_distance_m()));
    for (const EffectFacts& effect : effect_table()) {
        const EffectKind kind = effect.kind;
        const EffectSize size = scene.size(kind);
        // A curved Earth's sky may be the plane's ground; not at 60 degrees. What a source states it states
        // of itself.
        if (kind != EffectKind::source) {
            EXPECT_EQ(size.worst_m, 0.0) << facts_of(kind).name;
            EXPECT_EQ(size.typical_m, 0.0) << facts_of(kind).name;
        }
        EXPECT_EQ(size.worst_px, 0.0) << facts_of(kind).name;
        EXPECT_EQ(size.typical_px, 0.0) << facts_of(kind).name;
    }
    const auto total = scene.prediction.total(balanced());
    ASSERT_TRUE(total.ok());
    EXPECT_EQ(total.value().worst_m, 0.0);
    EXPECT_EQ(total.value().worst_px, 0.0);
}

// Where a picture that leaves one thing out puts a point: offset from the eye, ECEF axes.
glm::dvec3 drawn_m(EffectKind kind, const HeightField& field, const Geodetic& eye, const Geodetic& point) {
    if (kind == EffectKind::refraction) return model_offset_m({}, eye, point);
    if (kind == EffectKind::sphere)
        return model_offset_m({Earth::sphere, standard_air, Precision::relative}, eye, point);
    const auto lowered = [&](const Geodetic& at) {
        return Geodetic{at.lat_deg, at.lon_deg, at.h_m - field.undulation.at_m(at.lat_deg, at.lon_deg)};
    };
    return Refraction(eye, standard_air)
        .apparent_m(model_offset_m(Earth::ellipsoid, lowered(eye), lowered(point)));
}

// How far the farthest of a picture's points is moved.
Distance measured_worst(const TrueSurface& surface, const Camera& camera, EffectKind kind,
                        const std::vector<std::optional<SightHit>>& picture) {
    const Sight sight = sight_from(camera.eye, standard_air);
    const GroundMeter meter(surface, sight, camera);
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    Distance worst;
    for (const auto& hit : picture) {
        if (!hit) continue;
        const glm::dvec3 at = drawn_m(kind, surface.field(), camera.eye, hit->point);
        if ((view_from_ecef * at).z >= -near_plane_m) continue;
        const glm::dvec3 offset_m = ecef_from_geodetic(hit->point).m - sight.eye.m;
        worst.m = std::max(worst.m, glm::length(sight.refraction.true_m(at) - offset_m));
        worst.px = std::max(worst.px, meter.apart_px(at, sight.refraction.apparent_m(offset_m)));
    }
    return worst;
}

// All of a picture's points, and not only those that a prediction looks at: the predicted worst holds them,
// and is at most 10 times what they have. From made cameras.
TEST(EffectBounds, HoldBetweenTheSamples) {
    constexpr std::uint64_t seed = 701;
    HeightField field = test::rough_field(0.6, 0.2, 481, 601);
    field.undulation = undulation(10.0, 40.0);
    const TrueSurface surface(field, 1.0, thread_count());
    const auto pages = pages_in_memory(field, 1.0, thread_count());
    double loosest = 1.0;
    for (const Camera& camera : made_cameras(seed, field, 5, 320, 180)) {
        const EffectPrediction prediction(surface, *pages, camera, {}, thread_count());
        const auto picture =
            Oracle(surface, sight_from(camera.eye, standard_air)).cast_picture(camera, thread_count());
        for (const EffectKind kind : {EffectKind::refraction, EffectKind::sphere, EffectKind::geoid}) {
            const Distance worst = measured_worst(surface, camera, kind, picture);
            const EffectSize size = prediction.size(kind, 1.0).value().value();
            EXPECT_GE(size.worst_m, worst.m) << facts_of(kind).name;
            EXPECT_GE(size.worst_px, worst.px) << facts_of(kind).name;
            // Heights below a micrometre are rounding.
            EXPECT_LE(size.worst_m, 10.0 * worst.m + 1.0e-6) << facts_of(kind).name;
            if (worst.px < 1.0e-6) continue;
            EXPECT_LE(size.worst_px, 10.0 * worst.px) << facts_of(kind).name;
            loosest = std::max(loosest, size.worst_px / worst.px);
        }
    }
    std::printf("seed %llu: bounds at most %.2f times what is measured\n",
                static_cast<unsigned long long>(seed), loosest);
}

}  // namespace
}  // namespace oro
