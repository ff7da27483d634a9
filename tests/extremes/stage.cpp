#include "tests/extremes/stage.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/parallel.h"
#include "core/truth/oracle.h"
#include "tests/extremes/accuracy_table.h"
#include "tests/extremes/gpu_scan.h"
#include "tests/support/drawn/plain_style.h"

namespace oro::test {
namespace {

// Distances that the oracle sees through some places of one pixel.
struct Seen {
    double nearest_m{std::numeric_limits<double>::infinity()};
    double farthest_m{0.0};

    void add(const std::optional<SightHit>& hit) {
        const double m = hit ? hit->distance_m : std::numeric_limits<double>::infinity();
        nearest_m = std::min(nearest_m, m);
        farthest_m = std::max(farthest_m, m);
    }
    [[nodiscard]] bool holds(double drawn_m, double slack_m) const {
        return drawn_m >= nearest_m - slack_m && drawn_m <= farthest_m + slack_m;
    }
};

}  // namespace

Camera strip_camera(const Geodetic& eye, const Attitude& attitude, double fov_deg) {
    Camera camera;
    camera.eye = eye;
    camera.attitude = attitude;
    camera.vertical_fov_deg = fov_deg;
    camera.width_px = strip_width_px;
    camera.height_px = strip_height_px;
    return camera;
}

float globe_H_m(double lat_deg, double lon_deg, double waves, double height_m) {
    const SineCosine lat = sine_cosine_deg(lat_deg), lon = sine_cosine_deg(lon_deg);
    const double x = lat.cosine * lon.cosine, y = lat.cosine * lon.sine, z = lat.sine;
    double H = 0.0;
    for (int octave = 0; octave < 4; ++octave) {
        H += height_m * std::sin(waves * x + 0.7 * octave) * std::cos(waves * y - 1.1 * octave) *
             std::cos(waves * z + 0.3 * octave);
        waves *= 2.03;
        height_m *= 0.5;
    }
    return static_cast<float>(H);
}

Stage::Stage(const Gpu& gpu, HeightField field, double exaggeration)
    : gpu_(gpu), field_(std::move(field)), surface_(field_, exaggeration, thread_count()) {
    auto pages = std::make_unique<ScannedPages>(pages_in_memory(field_, exaggeration, thread_count()));
    auto scene = Scene::create(gpu, std::move(pages), {std::uint64_t{512} << 20U, 0});
    EXPECT_TRUE(scene.ok()) << scene.error().line();
    scene_.emplace(std::move(scene).value());
}

FrameRenderer& Stage::renderer(RasterPath path, const Camera& camera) {
    const VkExtent2D extent{static_cast<std::uint32_t>(camera.width_px),
                            static_cast<std::uint32_t>(camera.height_px)};
    const auto found = renderers_.find(path);
    if (found != renderers_.end()) {
        if (found->second.extent().width != extent.width || found->second.extent().height != extent.height) {
            const auto resized = found->second.resize(extent);
            EXPECT_TRUE(resized.ok()) << resized.error().line();
        }
        return found->second;
    }
    FrameRendererOptions options;
    options.extent = extent;
    options.keep_depths = true;
    options.keep_triangles = true;
    options.path = path;
    auto made = FrameRenderer::create(gpu_, options);
    EXPECT_TRUE(made.ok()) << made.error().line();
    return renderers_.emplace(path, std::move(made).value()).first->second;
}

FramePlan Stage::plan(const Camera& camera, const Tile& tile, double tau_px, const WorldModel& model) {
    auto made = scene_->settled_plan({camera, tile, tau_px, model});
    EXPECT_TRUE(made.ok()) << made.error().line();
    EXPECT_TRUE(made->grids[0].missing.empty());
    scan(*made);
    return std::move(made).value();
}

Stage::Drawn Stage::draw(const Camera& camera, RasterPath path, double tau_px, const WorldModel& model) {
    FrameRenderer& draws = renderer(path, camera);
    const gpu::FrameStyle style = plain_style();
    scan(style);
    const Tile tile{0, 0, camera.width_px, camera.height_px, {0.5, 0.5}};
    FramePlan frame = plan(camera, tile, tau_px, model);
    const auto report = draws.draw(std::move(frame), style);
    EXPECT_TRUE(report.ok()) << report.error().line();
    EXPECT_EQ(report->counts.triangles_not_clipped, 0U);
    const auto width = static_cast<std::uint32_t>(camera.width_px);
    const auto height = static_cast<std::uint32_t>(camera.height_px);
    auto depths = draws.read_depths(width, height);
    auto ids = draws.read_ids(width, height);
    auto points = read_points(draws, camera, tile);
    EXPECT_TRUE(depths.ok() && ids.ok() && points.ok());
    Drawn drawn{std::move(depths).value(), std::move(points).value(), std::move(ids).value(), *report};
    const auto odd = std::count_if(drawn.depths.begin(), drawn.depths.end(),
                                   [](float depth) { return !std::isfinite(depth) || depth < 0.0F; });
    EXPECT_EQ(odd, 0) << "depths that are none";
    return drawn;
}

GroundErrors Stage::ground(const Camera& camera, std::span<const DrawnPoint> points,
                           GroundMeasures measures) const {
    return ground_errors(surface_, sight_from(camera.eye), camera, points, thread_count(), measures);
}

Stage::Measured Stage::measure(const Camera& camera, RasterPath path) {
    DepthPictureOptions options;
    options.tau_px = 0.0;
    auto picture =
        painters_.try_emplace(path, gpu_, path).first->second.draw(*scene_, camera, plain_style(), options);
    EXPECT_TRUE(picture.ok()) << picture.error().line();
    const Sight sight = sight_from(camera.eye);
    const TruePicture truth(surface_, sight, camera, thread_count());
    PictureErrors errors = picture_errors(truth, picture->points, picture->skylines(), thread_count());
    return {std::move(picture).value(), std::move(errors)};
}

Stage::Agreement Stage::agreement(const Camera& camera, const std::vector<float>& depths, int every,
                                  double around_px, double slack_m) const {
    const Oracle oracle(surface_, sight_from(camera.eye));
    const double reach_m = sight_reach_m(camera.eye.h_m);
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    const int count = (camera.width_px * camera.height_px + every - 1) / every;
    std::atomic<std::uint64_t> wrong{0}, ground{0};
    const std::array<glm::dvec2, 5> places{glm::dvec2(0.0), glm::dvec2(around_px, 0.0),
                                           glm::dvec2(-around_px, 0.0), glm::dvec2(0.0, around_px),
                                           glm::dvec2(0.0, -around_px)};
    in_parallel(count, thread_count(), [&](int number) {
        const int at = number * every;
        const glm::dvec2 centre(at % camera.width_px + 0.5, at / camera.width_px + 0.5);
        Seen seen;
        for (const glm::dvec2& place : places) {
            const auto hit = oracle.first_hit(camera.ecef_direction_at(centre + place), reach_m);
            if (place == glm::dvec2(0.0) && hit) ++ground;
            seen.add(hit);
        }
        const float depth = depths[static_cast<std::size_t>(at)];
        const double along = -(view_from_ecef * camera.ecef_direction_at(centre)).z;
        const double drawn_m = depth == 0.0F ? std::numeric_limits<double>::infinity()
                                             : near_plane_m / static_cast<double>(depth) / along;
        const double allowed_m = slack_m + (depth == 0.0F ? 0.0 : 6e-7 * drawn_m);
        if (!seen.holds(drawn_m, allowed_m)) ++wrong;
    });
    return {static_cast<std::uint64_t>(count), wrong, ground};
}

double Stage::ground_h_m(double lat_deg, double lon_deg) const {
    const auto h_m = surface_.h_m(lat_deg, lon_deg);
    EXPECT_TRUE(h_m.has_value()) << lat_deg << "," << lon_deg;
    return h_m.value_or(0.0);
}

void Extremes::SetUp() {
    GpuTest::SetUp();
    if (gpu_) drawn_on(gpu_->report().name + ", " + gpu_->report().driver);
}

GroundErrors Extremes::check_view(Stage& stage, const Camera& camera, RasterPath path, const char* group,
                                  const char* px_row, const char* wrong_row, int every,
                                  GroundMeasures measures) {
    const Stage::Drawn drawn = stage.draw(camera, path);
    GroundErrors errors = stage.ground(camera, drawn.points, measures);
    EXPECT_GT(errors.drawn, 0U) << "nothing to be seen";
    EXPECT_EQ(errors.beyond_data, 0U) << "ground that is drawn and is not there";
    const ErrorSummary& px = errors.summary_displacement_px;
    if (*px_row) measured(group, px_row, px.largest, px.count);
    if (*wrong_row) {
        const auto agreement = stage.agreement(camera, drawn.depths, every);
        measured(group, wrong_row, static_cast<double>(agreement.wrong), agreement.pixels);
    }
    return errors;
}

}  // namespace oro::test
