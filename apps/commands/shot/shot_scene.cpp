#include "apps/commands/shot/shot_scene.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/drawing/drape.h"
#include "apps/drawing/kept_drawing.h"
#include "apps/drawing/known_pictures.h"
#include "apps/drawing/mesh_choice.h"
#include "apps/drawing/mesh_cut.h"
#include "apps/drawing/region_scene.h"
#include "apps/legend/legend.h"
#include "apps/report/progress_bar.h"
#include "apps/view/accuracy.h"
#include "core/base/elapsed.h"
#include "core/lod/ground_means.h"
#include "core/made_pages/made_pages.h"

namespace oro {
namespace {

// The cheapest bundle that keeps the view within the tolerance; single options of the command line win over
// it.
Result<void> choose_bundle(const ShotOptions& options, const RegionCuts& cuts, const RegionPagesList& pages,
                           ShotResult& shot) {
    ORO_TRY(const double tolerance_px, parse_tolerance(*options.view.tolerance));
    ORO_TRY(const std::unique_ptr<TrueScene> truth, TrueScene::of(shot.view, shot.region, cuts));
    FixedAccuracy fixed;
    if (options.view.tau_px) fixed.tau_px = shot.view.tau_px;
    if (options.view.heights) fixed.heights = shot.view.heights;
    if (options.view.refraction_k || options.view.air) fixed.air = shot.view.model.air;
    ORO_TRY(shot.choice,
            choose_accuracy(shot.view, shot.region, truth->ground(), pages, tolerance_px, fixed));
    apply_bundle(shot.choice->bundle, shot.view);
    forget_other_bundle(shot.view);
    const std::string& chosen = shot.view.accuracy.empty() ? shot.choice->bundle.options : shot.view.accuracy;
    char text[240];
    std::snprintf(text, sizeof text, "accuracy: %s, predicted error %.3g px%s", chosen.c_str(),
                  shot.choice->predicted_px,
                  shot.choice->holds ? "" : ": more than the tolerance, and nothing here comes nearer");
    say(options.quiet, text);
    return {};
}

}  // namespace

Result<ShotGround> ground_of_shot(const ShotResult& shot) {
    ShotGround ground;
    ORO_TRY(ground.cuts, cut_regions(shot.region));
    ORO_TRY(ground.grids, RegionGround::of(shot.region, ground.cuts, shot.view.exaggeration));
    return ground;
}

void choose_legend(const ShotOptions& options, View& view) {
    if (options.no_legend) view.legend = false;
    if (options.no_legend || options.view.legend || !options.view.show) return;
    view.legend = has_own_legend(view);
    if (!view.legend)
        say(options.quiet, "note: a picture less than " + std::to_string(least_legend_px) +
                               " px wide has no room for the legend of --show");
}

// Whether a scene is left to other pictures: not one of made terrain whose pages are made for one alone.
static bool leaves_scene(const Region& region) {
    return keeps_drawing() && std::ranges::none_of(region.grids, [](const RegionGrid& grid) {
               return made_posts_of(grid.field) != nullptr;
           });
}

// What a scene's pages are for: nothing that is known, where bundles are tried or other pictures may follow.
static KnownPictures only_picture(const ShotOptions& options, const Style& style, const View& view,
                                  const Region& region) {
    if (options.view.tolerance || leaves_scene(region)) return {};
    return known_pictures(view, style, std::span(&view.camera, 1));
}

Result<ShotScene> scene_of_shot(const ShotOptions& options, double ceiling_m, const Gpu& gpu,
                                const Style& style, const ShotGround& ground, const Progress& progress,
                                ShotResult& shot) {
    const auto start = Clock::now();
    GridPages pages;
    const bool asks = options.view.tolerance.has_value();
    const auto make_pages = [&]() -> Result<void> {
        ORO_TRY(pages, make_grid_pages(
                           shot.region, ground.cuts, shot.view.exaggeration,
                           [&](double share) {
                               if (progress) progress(share, "measuring levels");
                           },
                           {}, only_picture(options, style, shot.view, shot.region)));
        return {};
    };
    if (asks) {
        ORO_CHECK(make_pages());
        ORO_CHECK(choose_bundle(options, ground.cuts, pointers_to(pages), shot));
    }
    if (!shot.view.map) {
        ORO_TRY(shot.unseen, unseen_in(shot.view, shot.region, ceiling_m));
    }
    ORO_TRY(shot.meshes, drawn_meshes(shot.region, shot.view, memory_of_pages(shot.view, options.memory)));
    bool clusters = false;
    if (shot.meshes)
        say(options.quiet, words_of(*shot.meshes));
    else {
        ORO_TRY(clusters, draws_clusters(shot.region, shot.view));
    }
    const bool means = asks_for_means(style.frame);
    std::string key;
    std::optional<RegionScene> whole;
    if (leaves_scene(shot.region) && !asks && !shot.meshes) {
        key = scene_key(shot.view, options.memory, means, clusters);
        whole = take_kept_scene(key);
    }
    const bool is_kept = whole.has_value();
    if (!is_kept) {
        if (!asks) ORO_CHECK(make_pages());
        ORO_TRY(whole, scene_of_region(gpu, shot.region, ground.cuts, std::move(pages),
                                       {shot.view.exaggeration, memory_of_pages(shot.view, options.memory),
                                        shot.view.heights, means, clusters, shot.view.mesh_level,
                                        shot.meshes ? shot.meshes->cut.meshes : nullptr}));
    }
    Scene& scene = whole->scene;
    const std::string note = note_of_missing_footprints(style.frame, scene.pages());
    if (!note.empty()) say(options.quiet, note);
    shot.has_means = means && note.empty();
    if (!is_kept) ORO_CHECK(lay_images(shot.view, options.memory, gpu, scene, options.quiet));
    for (const GridScene& grid : scene.grids())
        if (grid.pages().has_posts()) shot.pages += grid.pages().layout(0).count();
    shot.triangles_at_full_resolution = whole->triangles;
    if (shot.meshes)
        shot.triangles_at_full_resolution += shot.meshes->cut.of_triangles - shot.meshes->cut.triangles;
    shot.times.pages_s = seconds_since(start);
    return ShotScene{std::move(*whole), std::move(key)};
}

Result<void> check_in_view(const ShotResult& shot, const std::string& view_file, Scene& scene) {
    if (shot.view.map) return {};
    const Camera& camera = shot.view.camera;
    ORO_TRY(const FramePlan first, scene.plan({camera,
                                               {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}},
                                               shot.view.tau_px,
                                               shot.view.model}));
    if (first.wants_pages()) return {};
    const auto nothing = nothing_in_view(shot.view, shot.region, view_file);
    return nothing.ok() ? Result<void>() : nothing.error();
}

}  // namespace oro
