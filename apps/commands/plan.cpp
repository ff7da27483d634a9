// orograph plan: how large each effect is in a view, before anything is drawn.
#include <cstdio>

#include "apps/accuracy/mesh_forecast.h"
#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/commands/drawn_meshes_json.h"
#include "apps/commands/plan_text.h"
#include "apps/cover/canopy_words.h"
#include "apps/drawing/mesh_choice.h"
#include "apps/drawing/mesh_cut.h"
#include "apps/drawing/region_scene.h"
#include "apps/eye/standpoint.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/report/resampling_words.h"
#include "apps/report/summit_words.h"
#include "apps/view/accuracy.h"
#include "apps/view/model_names.h"
#include "apps/view/view_changes.h"
#include "core/base/parallel.h"
#include "core/terrain/ground.h"
#include "geo/canopy/raised_region.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

const char* key_of(EffectGroup group) {
    switch (group) {
        case EffectGroup::model:
            return "model";
        case EffectGroup::drawing:
            return "drawing";
        case EffectGroup::data:
            return "data";
    }
    return "";
}

const char* key_of(EffectMeasure measure) {
    switch (measure) {
        case EffectMeasure::picture:
            return "picture";
        case EffectMeasure::full_detail:
            return "full_detail";
        case EffectMeasure::thinned:
            return "thinned";
        case EffectMeasure::made:
            return "made";
        case EffectMeasure::stated:
            return "stated";
    }
    return "";
}

const char* key_of(EffectBound bound) {
    switch (bound) {
        case EffectBound::derived:
            return "derived";
        case EffectBound::estimated:
            return "estimated";
        case EffectBound::stated:
            return "stated";
    }
    return "";
}

ordered_json size_json(const EffectSize& size) {
    return json_object("worst_m", size.worst_m, "typical_m", size.typical_m, "worst_px", size.worst_px,
                       "typical_px", size.typical_px);
}

ordered_json effect_json(const BudgetLine& line) {
    const EffectFacts& facts = facts_of(line.kind);
    ordered_json effect =
        json_object("effect", error_name(line.kind), "kind", facts.key, "group", key_of(facts.group));
    effect["meaning"] = facts.meaning;
    effect["measured_by"] = key_of(facts.measured_by);
    effect["bound"] = key_of(facts.bound);
    effect["size"] = nullptr;
    if (line.size) effect["size"] = size_json(*line.size);
    // Of estimates alone.
    effect["spread_px"] = nullptr;
    if (line.size && facts.bound == EffectBound::estimated)
        effect["spread_px"] = json_object("typical", line.size->typical_px, "p99", line.size->p99_px,
                                          "largest", line.size->largest_px);
    effect["in_picture"] = line.in_picture;
    effect["limit_of_the_data"] = facts.group == EffectGroup::data;
    effect["below_tolerance"] = line.within_tolerance;
    // Of parts of the model alone.
    effect["modelled"] = nullptr;
    effect["needed"] = nullptr;
    if (facts.group == EffectGroup::model) {
        effect["modelled"] = line.modelled;
        effect["needed"] = line.needed();
    }
    return effect;
}

ordered_json forecast_json(const MeshForecast& mesh) {
    return json_object("triangles", mesh.triangles, "worst_m", mesh.worst_m, "worst_px", mesh.worst_px);
}

ordered_json plan_json(const Budget& budget, const View& view, const AccuracyChoice& choice,
                       const UnseenGround& unseen, const std::optional<MeshForecasts>& meshes) {
    ordered_json json = ordered_json::object();
    json["tolerance_px"] = budget.tolerance_px;
    json["in_view"] = !budget.empty;
    json["nearest_m"] = budget.nearest_m;
    json["median_distance_m"] = budget.median_distance_m;
    json["sight_lines"] = budget.sight_lines;
    json["light"] = light_json(budget.air, budget.eye_h_m);
    json["effects"] = ordered_json::array();
    for (const BudgetLine& line : budget.lines) json["effects"].push_back(effect_json(line));
    json["total"] = size_json(budget.total);
    json["unseen"] = unseen_json(unseen);
    // None where the region's posts are its sources' own.
    if (budget.resampling) json["resampling"] = size_json(*budget.resampling);
    // Of views with a canopy alone.
    if (budget.vegetation) json["vegetation"] = size_json(*budget.vegetation);
    if (budget.invented) json["invented"] = size_json(*budget.invented);
    json["meshes"] = nullptr;
    if (meshes)
        json["meshes"] =
            json_object("blocks", forecast_json(meshes->blocks), "clusters", forecast_json(meshes->clusters));
    json["dominates"] = nullptr;
    json["dominates_kind"] = nullptr;
    if (budget.dominant) {
        json["dominates"] = error_name(*budget.dominant);
        json["dominates_kind"] = facts_of(*budget.dominant).key;
    }
    ordered_json left_out = ordered_json::array();
    for (const EffectKind kind : choice.left_out) left_out.push_back(facts_of(kind).key);
    json["cheapest"] =
        json_object("accuracy", choice.bundle.name, "options", choice.bundle.options, "predicted_px",
                    choice.predicted_px, "holds", choice.holds, "left_out", std::move(left_out));
    json["view"] = ordered_json::parse(view_to_json(view, false));
    return json;
}

PlanEye eye_of(const View& view, const Region& region) {
    const Geodetic& eye = view.camera.eye;
    PlanEye place{eye.h_m - region.grids.front().field.undulation.at_m(eye.lat_deg, eye.lon_deg), {}};
    const auto ground = ground_h_m(grid_at(region, eye.lat_deg, eye.lon_deg).field, eye.lat_deg, eye.lon_deg,
                                   view.exaggeration);
    const double canopy_m =
        canopy_over_ground_m(region.grids.front(), eye.lat_deg, eye.lon_deg).value_or(0.0);
    if (ground) place.above_ground_m = eye.h_m - *ground + view.exaggeration * canopy_m;
    return place;
}

// As shot chooses, and refuses. A level of the graph promises nothing that could be told beforehand.
Result<void> choose_mesh(const Region& region, View& view) {
    ORO_TRY(const bool of_meshes, draws_mesh_clusters(region, view));
    if (!of_meshes)
        if (const auto clusters = draws_clusters(region, view); !clusters.ok()) return clusters.error();
    if (view.mesh_level)
        return refused("--mesh-level", std::to_string(*view.mesh_level),
                       "plan tells what --tau promises, and one level of clusters promises nothing (--tau "
                       "takes its place)");
    return {};
}

}  // namespace

Result<void> run_plan(const PlanOptions& options) {
    double tolerance_px = 1.0;
    if (options.view.tolerance) {
        ORO_TRY(tolerance_px, parse_tolerance(*options.view.tolerance));
    }
    ORO_TRY(const double ceiling_m, unseen_ceiling(options.unseen_ceiling_m));
    // Here a tolerance judges what is asked for, and chooses nothing.
    ViewOptions view_options = options.view;
    view_options.tolerance.reset();
    ProgressBar bar(options.quiet);
    View view;
    Region region;
    ORO_CHECK(open_view(options.view_file, view_options, options.region, bar.progress(), view, region));
    ORO_CHECK(choose_mesh(region, view));
    ORO_TRY(const RegionCuts cuts, cut_regions(region));
    ORO_TRY(const GridPages pages, make_grid_pages(region, cuts, view.exaggeration, [&](double share) {
                bar.show(share, "measuring levels");
            }));
    ORO_TRY(const std::unique_ptr<TrueScene> truth, TrueScene::of(view, region, cuts));
    bar.clear();
    say_changes(view, options.quiet);
    say_notes(region, options.quiet);
    say_summit(view.stood.summit, options.quiet);
    for (const RegionGrid& grid : region.grids)
        if (const std::string sentence = resampling_sentence(grid); !sentence.empty())
            say(options.quiet, "note: " + sentence);
    const RegionPagesList of_grids = pointers_to(pages);
    ORO_TRY(const Budget budget, plan_view(view, region, truth->ground(), of_grids, tolerance_px));
    ORO_TRY(const AccuracyChoice choice,
            choose_accuracy(view, region, truth->ground(), of_grids, tolerance_px));
    ORO_TRY(const UnseenGround unseen, unseen_in(view, region, ceiling_m, truth.get()));
    ORO_TRY(const std::optional<MeshForecasts> meshes, mesh_forecasts(view, region, *pages.front()));
    ORO_TRY(const std::optional<DrawnMeshes> standing, drawn_meshes(region, view, {}));
    if (options.json) {
        ordered_json json = plan_json(budget, view, choice, unseen, meshes);
        if (standing) json["meshes_on_ground"] = drawn_meshes_json(*standing);
        if (view.canopy) json["canopy"] = canopy_json(*view.canopy, region);
        json["notes"] = all_notes(region);
        std::printf("%s\n", json_text(json, true).c_str());
        return {};
    }
    const PlanEye eye = eye_of(view, region);
    std::fputs((options.all ? plan_text(budget, view, eye, choice, unseen, meshes)
                            : plan_summary(budget, view, eye, choice, unseen))
                   .c_str(),
               stdout);
    if (standing) std::printf("On the ground, %s.\n", words_of(*standing).c_str());
    if (view.canopy) std::printf("%s.\n", canopy_words(*view.canopy, region).c_str());
    return {};
}

}  // namespace oro
