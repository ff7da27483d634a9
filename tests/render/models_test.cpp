// What is drawn under each model of the world: where posts and pixels are, no gaps, and culling that changes
// nothing.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <random>

#include "core/terrain/ground.h"
#include "render/frame/frame_renderer.h"
#include "render/scene/scene.h"
#include "tests/support/drawn/made_renderer.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr int side_px = 96;
constexpr Tile whole{0, 0, side_px, side_px, {0.5, 0.5}};

struct NamedModel {
    const char* name;
    WorldModel model;
};
constexpr NamedModel models[] = {
    {"ellipsoid", {}},
    {"sphere", {Earth::sphere, {}, Precision::relative}},
    {"flat", {Earth::flat, {}, Precision::relative}},
    {"refraction 0.13", {Earth::ellipsoid, {0.13}, Precision::relative}},
    {"refraction 0.9", {Earth::ellipsoid, {0.9}, Precision::relative}},
    {"refraction -1", {Earth::ellipsoid, {-1.0}, Precision::relative}},
    {"flat, refraction 0.5", {Earth::flat, {0.5}, Precision::relative}},
    {"naive", {Earth::ellipsoid, {}, Precision::naive}},
    {"rounded posts", {Earth::ellipsoid, {}, Precision::rounded_posts}},
    {"naive sphere, refraction 0.13", {Earth::sphere, {0.13}, Precision::naive}},
};

// Pages that nothing can hide.
class UnhiddenPages : public RegionPages {
  public:
    explicit UnhiddenPages(std::unique_ptr<RegionPages> pages)
        : RegionPages(pages->facts()), pages_(std::move(pages)) {}
    [[nodiscard]] Result<PageRecord> record(const PageIndex& page) const override {
        ORO_TRY(PageRecord record, pages_->record(page));
        record.reach_m = 1e12;
        record.horizon.angle_rad = std::numbers::pi;
        return record;
    }
    Result<void> load(const PageIndex& page, gpu::PageBlock& block) const override {
        return pages_->load(page, block);
    }

  private:
    std::unique_ptr<RegionPages> pages_;
};

Scene scene_of(const Gpu& gpu, std::unique_ptr<RegionPages> pages,
               HeightStorage heights = HeightStorage::f32) {
    auto scene = Scene::create(gpu, std::move(pages), {std::uint64_t{64} << 20U, 0}, heights);
    EXPECT_TRUE(scene.ok()) << scene.error().line();
    return std::move(scene).value();
}

FramePlan plan_of(Scene& scene, const Camera& camera, double tau_px, const WorldModel& model) {
    auto plan = scene.settled_plan({camera, whole, tau_px, model});
    EXPECT_TRUE(plan.ok()) << plan.error().line();
    EXPECT_TRUE(plan->grids[0].missing.empty());
    return std::move(plan).value();
}

class Models : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {
  protected:
    [[nodiscard]] FrameRenderer renderer_of(RasterPath path, bool record_view = false) const {
        FrameRendererOptions options;
        options.extent = {side_px, side_px};
        options.path = path;
        options.keep_depths = true;
        options.record_positions = options.record_view = record_view;
        return test::made_renderer(*gpu_, options);
    }

    static std::vector<float> depths_of(FrameRenderer& renderer, FramePlan plan) {
        auto drawn = renderer.draw(std::move(plan), {});
        EXPECT_TRUE(drawn.ok()) << drawn.error().line();
        auto depths = renderer.read_depths(side_px, side_px);
        EXPECT_TRUE(depths.ok()) << depths.error().line();
        return std::move(depths).value();
    }

    // An eye over a field, above_m over its ground.
    static Camera random_camera(std::mt19937& random, const HeightField& field, double lowest_m,
                                double highest_m, double pitch_low_deg, double pitch_high_deg) {
        const auto between = [&](double a, double b) {
            return std::uniform_real_distribution<double>(a, b)(random);
        };
        const PostGrid& grid = field.grid;
        Camera camera;
        camera.eye.lat_deg = between(0.7 * grid.south_deg() + 0.3 * grid.north_deg(),
                                     0.3 * grid.south_deg() + 0.7 * grid.north_deg());
        camera.eye.lon_deg = between(0.7 * grid.west_deg() + 0.3 * grid.east_deg(),
                                     0.3 * grid.west_deg() + 0.7 * grid.east_deg());
        camera.eye.h_m = *ground_h_m(field, camera.eye.lat_deg, camera.eye.lon_deg) +
                         std::exp(between(std::log(lowest_m), std::log(highest_m)));
        camera.attitude = {between(0, 360), between(pitch_low_deg, pitch_high_deg), between(-180, 180)};
        camera.vertical_fov_deg = 40.0;
        camera.width_px = camera.height_px = side_px;
        return camera;
    }
};

struct Errors {
    double worst_m{};
    double worst_share{};  // of 1 mm and 6e-7 of the distance: placement, and the rotation into the view
    std::size_t posts{};
};

// Recorded view positions of the posts that are drawn against where the model puts them.
Errors errors_of(const std::vector<gpu::vec3>& recorded, const FramePlan& plan, const HeightField& field,
                 const Camera& camera, const WorldModel& model) {
    Errors errors;
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    for (std::size_t n = 0; n < plan.grids[0].pages.size(); ++n) {
        if (plan.grids[0].page_indices[n].level != 0) continue;
        for (int i = 0; i < 129 * 129; ++i) {
            const int row = plan.grids[0].page_indices[n].row * 128 + i / 129;
            const int column = plan.grids[0].page_indices[n].column * 128 + i % 129;
            if (row >= field.grid.rows() || column >= field.grid.columns()) continue;
            const Geodetic post{row_lat_deg(field.grid, row), field.grid.lon.at_deg(column),
                                drawn_h_m(field, row, column, 1.0)};
            const glm::dvec3 expected = view_from_ecef * model_offset_m(model, camera.eye, post);
            const double error_m =
                glm::length(glm::dvec3(recorded[n * 129U * 129U + static_cast<std::size_t>(i)]) - expected);
            errors.worst_m = std::max(errors.worst_m, error_m);
            errors.worst_share =
                std::max(errors.worst_share, error_m / (0.001 + 6.0e-7 * glm::length(expected)));
            ++errors.posts;
        }
    }
    return errors;
}

using ModelPlacement = Models;

TEST_F(ModelPlacement, PostsAreWhereTheModelPutsThem) {
    constexpr unsigned seed = 81;
    std::mt19937 random(seed);
    std::printf("seed %u\n", seed);
    FrameRenderer renderer = renderer_of(RasterPath::mesh, true);
    for (const double per_deg : {3600.0, 1200.0, 120.0}) {
        const HeightField field = test::made_field(46.9, 8.1, per_deg, 300, 300, test::rough_H_m);
        Scene scene = scene_of(*gpu_, pages_in_memory(field, 1.0, 2));
        for (const auto& [name, model] : models) {
            Errors errors;
            for (int i = 0; i < 3; ++i) {
                const Camera camera = random_camera(random, field, 2.0, 4000.0, -60.0, 0.0);
                FramePlan plan = plan_of(scene, camera, 0.0, model);
                for (gpu::FramePage& page : plan.grids[0].pages)
                    page.cull = 0;  // every meshlet is to be placed
                ASSERT_TRUE(renderer.draw(plan, {}).ok());
                const Errors now = errors_of(renderer.recorded(), plan, field, camera, model);
                errors = {std::max(errors.worst_m, now.worst_m),
                          std::max(errors.worst_share, now.worst_share), errors.posts + now.posts};
            }
            std::printf("%4.0f posts a degree, %-30s %8zu posts, worst %9.5f m, %6.2f of what is allowed\n",
                        per_deg, name, errors.posts, errors.worst_m, errors.worst_share);
            EXPECT_GT(errors.posts, 10000U);
            if (model.precision == Precision::relative) {
                EXPECT_LE(errors.worst_share, 1.0) << name;
            } else if (model.precision == Precision::naive) {
                EXPECT_GT(errors.worst_m, 0.05) << name;
                EXPECT_LT(errors.worst_m, 6.4) << name;  // what culling allows for
            } else {
                EXPECT_LT(errors.worst_m, 1.0) << name;
                EXPECT_GT(errors.worst_m, 0.05) << name;
            }
        }
    }
}

// A millimetre's step of the eye moves what is seen by a millimetre; naive float32 ECEF by decimetres, or not
// at all. Without record_view, positions are those before the rotation, which no precision changes.
TEST_F(ModelPlacement, RecordedViewsShowWhatPrecisionDoes) {
    const HeightField field = test::rough_field(46.9, 8.1, 129, 129);
    Scene scene = scene_of(*gpu_, pages_in_memory(field, 1.0, 2));
    FrameRenderer in_view = renderer_of(RasterPath::mesh, true);
    FrameRendererOptions options;
    options.extent = {side_px, side_px};
    options.record_positions = true;
    auto from_eye = FrameRenderer::create(*gpu_, options);
    ASSERT_TRUE(from_eye.ok());
    std::mt19937 random(82);
    Camera camera = random_camera(random, field, 300.0, 300.0, -60.0, -50.0);
    const auto drawn = [&](FrameRenderer& renderer, Precision precision) {
        FramePlan plan = plan_of(scene, camera, 0.0, {Earth::ellipsoid, {}, precision});
        for (gpu::FramePage& page : plan.grids[0].pages) page.cull = 0;
        EXPECT_TRUE(renderer.draw(plan, {}).ok());
        return renderer.recorded(std::size_t{gpu::page_posts} * gpu::page_posts);
    };
    const auto relative_before = drawn(in_view, Precision::relative);
    const auto naive_before = drawn(in_view, Precision::naive);
    EXPECT_EQ(drawn(*from_eye, Precision::relative), drawn(*from_eye, Precision::naive));
    EXPECT_NE(drawn(*from_eye, Precision::relative), relative_before);
    camera.eye.h_m += 0.001;
    const auto relative_after = drawn(in_view, Precision::relative);
    const auto naive_after = drawn(in_view, Precision::naive);
    double relative_m = 0.0, naive_m = 0.0;
    for (std::size_t i = 0; i < 129U * 129U; ++i) {
        const auto off_m = [&](const gpu::vec3& from, const gpu::vec3& to) {
            return std::abs(static_cast<double>(glm::length(to - from)) - 0.001);
        };
        relative_m = std::max(relative_m, off_m(relative_before[i], relative_after[i]));
        naive_m = std::max(naive_m, off_m(naive_before[i], naive_after[i]));
    }
    std::printf("off the millimetre by at most %.5f m (relative), %.3f m (naive)\n", relative_m, naive_m);
    EXPECT_LT(relative_m, 0.002);
    EXPECT_GT(naive_m, 0.05);
}

// The place on the model's Earth of a view position that was drawn.
Geodetic place_of(const WorldModel& model, const Camera& camera, const glm::dvec3& view_m) {
    const glm::dvec3 ecef_m =
        Refraction(camera.eye, model.air).true_m(glm::transpose(camera.view_from_ecef()) * view_m);
    const glm::dvec3 at = model_eye_ecef(model.earth, camera.eye).m + ecef_m;
    if (model.earth == Earth::ellipsoid) return geodetic_from_ecef({at});
    constexpr double deg = 180.0 / std::numbers::pi;
    if (model.earth == Earth::sphere)
        return {std::asin(at.z / glm::length(at)) * deg, std::atan2(at.y, at.x) * deg,
                glm::length(at) - mean_radius_m};
    const Geodetic& eye = camera.eye;
    const glm::dvec3 enu = glm::transpose(ecef_from_enu(eye.lat_deg, eye.lon_deg)) * ecef_m;
    return {eye.lat_deg + enu.y / meridian_radius_m(eye.lat_deg) * deg,
            eye.lon_deg +
                enu.x / (prime_vertical_radius_m(eye.lat_deg) * sine_cosine_deg(eye.lat_deg).cosine) * deg,
            eye.h_m + enu.z};
}

TEST_P(Models, DrawnDepthsLieOnTheModelsSurface) {
    constexpr unsigned seed = 83;
    // Depth and sag within cells, 5 cm, and the grain on which triangles are drawn, 1/256 px of 96 over 40
    // degrees.
    constexpr double grain = 2.0 * 0.36397 / 96.0 / 256.0;
    FrameRenderer renderer = renderer_of(GetParam());
    const HeightField field = test::made_field(47.0, 8.0, 600.0, 400, 400, test::rough_H_m);
    Scene scene = scene_of(*gpu_, pages_in_memory(field, 1.0, 2));
    for (const auto& [name, model] : models) {
        std::mt19937 random(seed);
        std::size_t compared = 0, outside = 0;
        double worst_m = 0.0, worst_share = 0.0;
        for (int i = 0; i < 8; ++i) {
            const Camera camera = random_camera(random, field, 5.0, 6000.0, -50.0, -5.0);
            const auto depths = depths_of(renderer, plan_of(scene, camera, 0.0, model));
            for (int at = 0; at < side_px * side_px; at += 5) {
                const float depth = depths[static_cast<std::size_t>(at)];
                if (depth == 0.0F) continue;
                const glm::dvec3 ray = camera.view_from_ecef() *
                                       camera.ecef_direction_at({at % side_px + 0.5, at / side_px + 0.5});
                const glm::dvec3 view_m = ray * (near_plane_m / static_cast<double>(depth) / -ray.z);
                const Geodetic place = place_of(model, camera, view_m);
                const auto ground_m = ground_h_m(field, place.lat_deg, place.lon_deg);
                outside += ground_m ? 0U : 1U;
                if (!ground_m) continue;
                const double off_m = std::abs(place.h_m - *ground_m);
                worst_m = std::max(worst_m, off_m);
                worst_share = std::max(worst_share, off_m / (0.05 + grain * glm::length(view_m)));
                ++compared;
            }
        }
        std::printf(
            "seed %u, %-30s %zu pixels, worst %.4f m off the surface, %.2f of what is allowed, %zu beyond "
            "its rim\n",
            seed, name, compared, worst_m, worst_share, outside);
        EXPECT_GT(compared, 8000U) << name;
        EXPECT_LE(outside, compared / 500) << name;
        if (model.precision == Precision::relative)
            EXPECT_LE(worst_share, 1.0) << name;
        else
            EXPECT_LE(worst_m, 6.0) << name;  // float32 ECEF moves posts by metres
    }
}

// How far along the picture a place moves when it is lifted by so many metres.
double moved_px(const Camera& camera, const glm::dvec3& view_m, double lift_m) {
    const glm::dvec3 up = camera.view_from_ecef() * ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg)[2];
    const glm::dvec3 to = view_m + lift_m * up;
    const double px = 0.5 * camera.height_px / camera.half_fov_tangent().y;
    return px * glm::length(glm::dvec2(to) / to.z - glm::dvec2(view_m) / view_m.z);
}

// Levels are chosen where light puts them: what is drawn is within tau of the full resolution, seen as bent.
TEST_P(Models, BentLightKeepsTau) {
    constexpr unsigned seed = 86;
    FrameRenderer renderer = renderer_of(GetParam());
    const HeightField field = test::made_field(48.5, 7.0, 240.0, 600, 600, test::rough_H_m);
    Scene scene = scene_of(*gpu_, pages_in_memory(field, 1.0, 2));
    for (const double k : {0.0, 0.13, 0.9, -1.0}) {
        for (const double tau_px : {1.0, 4.0}) {
            std::mt19937 random(seed);
            std::size_t compared = 0, coarse = 0;
            double worst_px = 0.0;
            for (int i = 0; i < 12; ++i) {
                const Camera camera = random_camera(random, field, 20.0, 20000.0, -30.0, -3.0);
                const WorldModel model{Earth::ellipsoid, {k}, Precision::relative};
                FramePlan plan = plan_of(scene, camera, tau_px, model);
                const auto pages = plan.grids[0].page_indices;
                const auto depths = depths_of(renderer, std::move(plan));
                const auto ids = renderer.read_ids(side_px, side_px);
                ASSERT_TRUE(ids.ok());
                for (int at = 0; at < side_px * side_px; at += 3) {
                    const auto pixel = static_cast<std::size_t>(at);
                    if (depths[pixel] == 0.0F) continue;
                    const glm::dvec3 ray = camera.view_from_ecef() *
                                           camera.ecef_direction_at({at % side_px + 0.5, at / side_px + 0.5});
                    const glm::dvec3 view_m =
                        ray * (near_plane_m / static_cast<double>(depths[pixel]) / -ray.z);
                    const Geodetic place = place_of(model, camera, view_m);
                    const auto ground_m = ground_h_m(field, place.lat_deg, place.lon_deg);
                    if (!ground_m) continue;
                    worst_px = std::max(worst_px, moved_px(camera, view_m, *ground_m - place.h_m));
                    coarse += pages[((*ids)[pixel] - 1U) / (256U * 128U)].level > 0 ? 1U : 0U;
                    ++compared;
                }
            }
            std::printf("seed %u, k %5.2f, tau %.1f: %zu pixels, %zu of coarser levels, worst %.3f px\n",
                        seed, k, tau_px, compared, coarse, worst_px);
            EXPECT_GT(coarse, 1000U);
            EXPECT_LE(worst_px, tau_px + 0.05);
        }
    }
}

TEST_P(Models, CullingChangesNoPixel) {
    constexpr unsigned seed = 84;
    std::printf("seed %u\n", seed);
    FrameRenderer renderer = renderer_of(GetParam());
    // 33 km, and 370 km, where the horizon hides pages.
    for (const double per_deg : {900.0, 90.0}) {
        const HeightField field = test::made_field(47.9, 7.1, per_deg, 300, 300, [](double lat, double lon) {
            return test::rough_H_m(lat, lon) * 0.3F;
        });
        Scene scene = scene_of(*gpu_, pages_in_memory(field, 1.0, 2));
        Scene all = scene_of(*gpu_, std::make_unique<UnhiddenPages>(pages_in_memory(field, 1.0, 2)));
        for (const auto& [name, model] : models) {
            std::mt19937 random(seed);
            std::size_t culled_pages = 0;
            for (int i = 0; i < 12; ++i) {
                const Camera camera =
                    random_camera(random, field, 2.0, 50000.0, i % 2 ? -90.0 : -10.0, i % 2 ? 20.0 : 2.0);
                FramePlan culled = plan_of(scene, camera, 0.0, model);
                culled_pages += culled.grids[0].pages_beyond_frustum + culled.grids[0].pages_beyond_horizon;
                FramePlan everything = plan_of(all, camera, 0.0, model);
                ASSERT_EQ(everything.grids[0].pages.size(), 9U + 4U + 1U);
                for (gpu::FramePage& page : everything.grids[0].pages) page.cull = 0;
                ASSERT_EQ(depths_of(renderer, std::move(culled)), depths_of(renderer, std::move(everything)))
                    << name << ", " << per_deg << " posts a degree, camera " << i;
            }
            EXPECT_GT(culled_pages, 10U) << name;
        }
    }
}

TEST_P(Models, LookingDownShowsNoGap) {
    constexpr unsigned seed = 85;
    std::printf("seed %u\n", seed);
    FrameRenderer renderer = renderer_of(GetParam());
    const HeightField field = test::rough_field(46.9, 8.1, 600, 600);
    Scene whole_heights = scene_of(*gpu_, pages_in_memory(field, 1.0, 2));
    Scene half_heights = scene_of(*gpu_, pages_in_memory(field, 1.0, 2), HeightStorage::i16);
    for (Scene* scene : {&whole_heights, &half_heights}) {
        for (const auto& [name, model] : models) {
            std::mt19937 random(seed);
            for (int i = 0; i < 12; ++i) {
                const Camera camera = random_camera(random, field, 30.0, 6000.0, -90.0, -75.0);
                const auto depths =
                    depths_of(renderer, plan_of(*scene, camera, i % 3 == 0 ? 4.0 : 1.0, model));
                ASSERT_EQ(std::count(depths.begin(), depths.end(), 0.0F), 0) << name << ", camera " << i;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Paths, Models, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) {
                             return path.param == RasterPath::mesh ? "mesh" : "compute";
                         });

}  // namespace
}  // namespace oro
