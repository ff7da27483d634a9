#include "apps/trade/trade_measurement.h"

#include <algorithm>
#include <cmath>

#include "apps/drawing/mesh_choice.h"
#include "core/base/median.h"
#include "core/base/parallel.h"
#include "core/lod/ground_means.h"
#include "geo/pictures/png_bytes.h"
#include "geo/sources/made_truth.h"

namespace oro {
namespace {

// Pictures after the first from the same eye until it is settled: frames of it are the same from then on.
constexpr int settling_pictures = 2;

// What the surface between posts misses of made terrain, where it is seen.
EffectSize off_the_rule(const EffectPrediction& prediction, const TrueGround& ground, double exaggeration,
                        const MadeTruth& truth) {
    return prediction.found_off_by([&](const ViewSample& sample) {
        const Geodetic& at = sample.point;
        return std::abs(at.h_m - ground.N_m(at.lat_deg, at.lon_deg) -
                        exaggeration * truth.H_m(at.lat_deg, at.lon_deg));
    });
}

// Effects that no drawing shows. truth: of the one grid's data, where they are of made terrain.
Result<void> add_data_effects(const EffectPrediction& prediction, const TrueGround& ground,
                              double exaggeration, const std::optional<MadeTruth>& truth,
                              const std::string& view, TradeReport& report) {
    // What every second post would hide: predicted from every second post, and as it is. Of made terrain what
    // all posts hide.
    const EffectSize guess = prediction.interpolation_estimate(truth ? 1 : 2),
                     known = truth ? off_the_rule(prediction, ground, exaggeration, *truth)
                                   : prediction.interpolation(1);
    report.effects.push_back({view,
                              {EffectKind::interpolation, {}, {}},
                              guess.worst_m,
                              guess.worst_px,
                              known.worst_m,
                              known.worst_px,
                              truth ? EffectMeasure::made : EffectMeasure::thinned});
    ORO_TRY(const std::optional<EffectSize> source, prediction.size(EffectKind::source, 0.0));
    if (source)
        report.effects.push_back({view,
                                  {EffectKind::source, {}, {}},
                                  source->worst_m,
                                  source->worst_px,
                                  std::nullopt,
                                  std::nullopt,
                                  EffectMeasure::stated});
    return {};
}

Result<void> add_pictures(const Verification& drawn, const TradeCase& one, const std::string& view,
                          TradeReport& report) {
    const DepthPicture& picture = drawn.picture;
    std::vector<std::uint8_t> rgb;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
        rgb.insert(rgb.end(), {picture.rgba[i], picture.rgba[i + 1], picture.rgba[i + 2]});
    ORO_TRY(std::vector<std::uint8_t> png, png_bytes(rgb, picture.width_px, picture.height_px));
    report.pictures.push_back({view + ": " + name_of(one.key), one.options, std::move(png)});
    ORO_TRY(std::vector<std::uint8_t> errors,
            error_picture_png(drawn, one.tau_px, ErrorPanels::displacement));
    report.pictures.push_back({view + ": errors of " + name_of(one.key),
                               "how far each pixel's ground is drawn from where it is seen",
                               std::move(errors)});
    return {};
}

}  // namespace

Result<void> Trade::prepare() {
    ORO_TRY(const RegionCuts cuts, cut_regions(region_));
    ORO_TRY(truth_, TrueScene::of(view_, region_, cuts));
    ORO_TRY(pages_, make_grid_pages(region_, cuts, view_.exaggeration));
    ORO_TRY(world_, earth_parameters(view_, region_, pages()));
    // Whatever air the view asks for: settings are drawn in standard air, but those that leave it out.
    world_.air = standard_air;
    return {};
}

Camera Trade::camera_of(const Camera& camera, const TradeCase& one) const {
    Camera from = camera;
    if (!one.has_geoid) from.eye.h_m -= ground().N_m(from.eye.lat_deg, from.eye.lon_deg);
    return from;
}

// There are three scenes at a time: as tiles have it, in 16 bits, without a geoid; and one by clusters.
MemoryOptions Trade::share_of_memory() const {
    const int scenes = has_clusters(region_, view_) ? 4 : 3;
    constexpr int least_mb = 16;
    MemoryOptions share = memory_;
    if (share.gpu_memory_mb) share.gpu_memory_mb = std::max(least_mb, *share.gpu_memory_mb / scenes);
    return share;
}

Result<Scene*> Trade::scene_of(const TradeCase& one) {
    const std::tuple key(one.has_geoid, one.heights, one.key.clusters);
    if (const auto found = scenes_.find(key); found != scenes_.end()) return &found->second;
    if (!one.has_geoid && !without_geoid_) {
        without_geoid_ = region_;
        leave_geoid_out(*without_geoid_);
    }
    const Region& region = one.has_geoid ? region_ : *without_geoid_;
    ORO_TRY(const RegionCuts cuts, cut_regions(region));
    ORO_TRY(GridPages pages, make_grid_pages(region, cuts, view_.exaggeration));
    ORO_TRY(RegionScene whole, scene_of_region(gpu_, region, cuts, std::move(pages),
                                               {view_.exaggeration, share_of_memory(), one.heights,
                                                asks_for_means(style_), one.key.clusters}));
    return &scenes_.emplace(key, std::move(whole.scene)).first->second;
}

// What follows is drawn as by a program that has drawn nothing yet.
void Trade::forget_frames(Scene& scene) {
    painter_.forget_frames();
    scene.forget_frames();
}

// After a picture of the same: what a driver makes when it meets a program first is made, and is of no
// setting.
Result<void> Trade::take_costs(Scene& scene, const Camera& from, DepthPictureOptions drawing,
                               TradeShot& shot) {
    drawing.skyline = false;
    std::vector<double> first_s, settled_s;
    for (int i = 0; i < repeats_; ++i) {
        forget_frames(scene);
        ORO_TRY(const DepthPicture first, painter_.draw(scene, from, style_, drawing));
        first_s.push_back(first.report.gpu_s());
        shot.first.triangles = first.report.counts.triangles_drawn;
        shot.bytes = first.page_bytes;
        if (shot.setting.clusters)
            shot.bytes += first.report.counts.meshlets_drawn * sizeof(gpu::ClusterBlock);
    }
    for (int i = -settling_pictures; i < repeats_; ++i) {
        ORO_TRY(const DepthPicture again, painter_.draw(scene, from, style_, drawing));
        if (i < 0) continue;
        settled_s.push_back(again.report.gpu_s());
        shot.settled.triangles = again.report.counts.triangles_drawn;
    }
    shot.first.gpu_ms = 1000.0 * median_of(std::move(first_s));
    shot.settled.gpu_ms = 1000.0 * median_of(std::move(settled_s));
    return {};
}

Result<TradeShot> Trade::shoot(const TradeCase& one, const Camera& camera, const TruePicture& truth,
                               Verification& drawn) {
    ORO_TRY(Scene* const scene, scene_of(one));
    const Camera from = camera_of(camera, one);
    DepthPictureOptions drawing;
    drawing.tau_px = one.tau_px;
    drawing.model = one.world;
    forget_frames(*scene);
    ORO_TRY(drawn.picture, painter_.draw(*scene, from, style_, drawing));
    if (!gpu_.validation_messages().empty())
        return Error{ErrorKind::failed, "Vulkan validation", gpu_.validation_messages().front()};
    if (!drawn.picture.settled)
        return Error{ErrorKind::failed, "--gpu-memory",
                     "the GPU cannot hold the terrain of a view at full detail"};
    oro::measure(drawn, truth);
    TradeShot shot;
    shot.setting = one.key;
    ORO_CHECK(take_costs(*scene, from, drawing, shot));
    shot.displacement_m = drawn.errors.ground.summary_displacement_m;
    shot.displacement_px = drawn.errors.ground.summary_displacement_px;
    shot.surface_px = drawn.errors.ground.summary_surface_px;
    shot.seen_px = drawn.errors.seen.summary_px;
    shot.skyline_px = drawn.errors.skyline.summary_px;
    shot.skyline_in_one_only = drawn.errors.skyline.in_one_only;
    if (one.keeps_tau) shot.limit_px = one.tau_px + drawn.slack_px;
    return shot;
}

Result<TradeEffect> Trade::predicted(const TradeCase& one, const EffectPrediction& prediction) const {
    TradeEffect effect;
    effect.key = one.key;
    if (!is_predicted(one.key)) return effect;
    DrawingModel drawing{one.world, one.has_geoid, {}, one.tau_px};
    if (one.heights == HeightStorage::i16) drawing.coding = world_.grids.front().sixteen;
    ORO_TRY(const EffectSize size, prediction.total(drawing));
    effect.predicted_m = size.worst_m;
    effect.predicted_px = size.worst_px;
    return effect;
}

Result<void> Trade::measure(const Camera& camera, const std::string& name, bool pictures,
                            TradeReport& report) {
    const Sight sight = sight_from(camera.eye, world_.air);
    const EffectPrediction prediction(ground(), pages(), camera, world_, thread_count());
    Verification drawn;
    const TruePicture truth(ground(), sight, camera, thread_count());
    for (const TradeCase& one : cases_) {
        ORO_TRY(TradeShot shot, shoot(one, camera, truth, drawn));
        shot.view = name;
        report.shots.push_back(shot);
        if (pictures && (one.key.bundle == Bundle::draft || one.key.bundle == Bundle::balanced))
            ORO_CHECK(add_pictures(drawn, one, name, report));
        ORO_TRY(TradeEffect effect, predicted(one, prediction));
        effect.view = name;
        effect.measured_m = shot.displacement_m.largest;
        effect.measured_px = std::min(shot.largest_px(), std::hypot(camera.width_px, camera.height_px));
        report.effects.push_back(effect);
    }
    const std::optional<MadeTruth> made =
        region_.grids.size() == 1 ? MadeTruth::of(region_.grids.front().sources) : std::nullopt;
    return add_data_effects(prediction, ground(), view_.exaggeration, made, name, report);
}

}  // namespace oro
