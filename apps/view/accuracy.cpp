#include "apps/view/accuracy.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "apps/command_line/refusals.h"
#include "apps/view/model_names.h"
#include "core/base/parallel.h"
#include "geo/measures/region_resampling.h"
#include "geo/refined/refined_region.h"
#include "geo/together/cut_regions.h"

namespace oro {
namespace {

// What sources are known to promise: half the interval that holds 90 % of height errors.
std::optional<double> stated_le90_m(const RegionGrid& grid) {
    // Source: T. Farr et al., The Shuttle Radar Topography Mission, Reviews of Geophysics 45, 2007, section
    // 5: absolute height error at most 16 m (90 %).
    constexpr double srtm_le90_m = 16.0;
    for (const SourceReport& source : grid.sources) {
        if (source.format != SourceFormat::raster) return srtm_le90_m;
    }
    return std::nullopt;
}

// By how much resampling moved the heights of each grid; nothing where none of them were resampled.
std::vector<HeightsOff> resampled_of(const Region& region) {
    std::vector<HeightsOff> off;
    bool any = false;
    for (const RegionGrid& grid : region.grids) {
        const auto resampled = region_resampling(grid);
        any |= resampled.has_value();
        off.push_back(resampled ? HeightsOff{resampled->worst_m, resampled->rms_m} : HeightsOff{});
    }
    return any ? off : std::vector<HeightsOff>{};
}

// How much the posts around a sample were raised by a canopy, at most: of what a picture without it is off.
double raised_by_m(const Region& region, const ViewSample& sample) {
    const RegionGrid& grid = region.grids[sample.grid];
    if (!grid.canopy) return 0.0;
    const PostGrid& posts = grid.field.grid;
    float most_m = 0.0F;
    for (int row = sample.row; row <= std::min(sample.row + 1, posts.rows() - 1); ++row)
        for (int column = sample.column; column <= std::min(sample.column + 1, posts.columns() - 1); ++column)
            most_m = std::max(most_m, grid.canopy->added_m[static_cast<std::size_t>(row) *
                                                               static_cast<std::size_t>(posts.columns()) +
                                                           static_cast<std::size_t>(column)]);
    return most_m;
}

// How far the posts around a sample are from the data's surface, at most: what is invented there.
double invented_at_m(const Region& region, const ViewSample& sample) {
    const RegionGrid& grid = region.grids[sample.grid];
    const RegionGrid* const data = data_under_detail(region);
    if (!grid.detail || data == nullptr) return 0.0;
    double most_m = 0.0;
    for (int row = sample.row; row <= std::min(sample.row + 1, grid.field.grid.rows() - 1); ++row)
        for (int column = sample.column; column <= std::min(sample.column + 1, grid.field.grid.columns() - 1);
             ++column)
            most_m = std::max(most_m, std::abs(invented_m(grid, *data, row, column).value_or(0.0)));
    return most_m;
}

// With its options written out.
AccuracyBundle bundle_of(Bundle kind, const char* name, double tau_px, HeightStorage heights,
                         const Air& air) {
    char text[100];
    std::snprintf(text, sizeof text, "--tau %g --heights %s ", tau_px,
                  name_in(height_storage_names, heights));
    return {kind, name, tau_px, heights, air, text + air_option(air)};
}

}  // namespace

const std::vector<AccuracyBundle>& accuracy_bundles() {
    static const std::vector<AccuracyBundle> bundles{
        bundle_of(Bundle::draft, "draft", 4.0, HeightStorage::i16, Air{}),
        bundle_of(Bundle::balanced, "balanced", 0.5, HeightStorage::f32, standard_air),
        bundle_of(Bundle::survey, "survey", 0.0, HeightStorage::f32, standard_air)};
    return bundles;
}

const char* bundle_name(Bundle kind) {
    const auto& bundles = accuracy_bundles();
    return std::find_if(bundles.begin(), bundles.end(),
                        [&](const AccuracyBundle& one) { return one.kind == kind; })
        ->name;
}

std::vector<std::string> accuracy_words() {
    std::vector<std::string> words;
    for (const AccuracyBundle& bundle : accuracy_bundles()) words.emplace_back(bundle.name);
    return words;
}

Result<AccuracyBundle> accuracy_bundle(const std::string& name) {
    for (const AccuracyBundle& bundle : accuracy_bundles()) {
        if (name == bundle.name) return bundle;
    }
    return refused("--accuracy", name, choose_words(accuracy_words()));
}

void apply_bundle(const AccuracyBundle& bundle, View& view) {
    view.tau_px = bundle.tau_px;
    view.heights = bundle.heights;
    view.model.air = bundle.air;
    view.accuracy = bundle.name;
}

bool is_drawn_as(const AccuracyBundle& bundle, const View& view) {
    // Packed heights are those of f32.
    const bool same_heights = (view.heights == HeightStorage::i16) == (bundle.heights == HeightStorage::i16);
    return view.tau_px == bundle.tau_px && same_heights && view.model.air == bundle.air;
}

void forget_other_bundle(View& view) {
    const Result<AccuracyBundle> named = accuracy_bundle(view.accuracy);
    if (!named.ok() || !is_drawn_as(*named, view)) view.accuracy.clear();
}

Result<double> parse_tolerance(const std::string& text) {
    double px = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), px);
    std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
    if (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
    if (error != std::errc() || !(rest.empty() || rest == "px") || !(px >= 0.001 && px <= 1000.0))
        return refused("--tolerance", text, "must be a number of pixels from 0.001 to 1000, e.g. 1px");
    return px;
}

Result<EarthParameters> earth_parameters(const View& view, const Region& region,
                                         const RegionPagesList& pages) {
    EarthParameters world;
    if (view.model.air.k != 0.0) world.air = view.model.air;
    world.grids.clear();
    for (const RegionGrid& grid : region.grids) {
        ORO_TRY(const HeightQuantization sixteen,
                height_quantization(pages[world.grids.size()], HeightStorage::i16));
        world.grids.push_back({stated_le90_m(grid), sixteen});
    }
    return world;
}

DrawingModel drawing_model(const View& view, const EarthParameters& world) {
    return {view.model, view.has_geoid,
            view.heights == HeightStorage::i16 ? world.grids.front().sixteen : HeightQuantization{},
            view.tau_px};
}

Result<Budget> plan_view(const View& view, const Region& region, const TrueGround& truth,
                         const RegionPagesList& pages, double tolerance_px) {
    ORO_TRY(const EarthParameters world, earth_parameters(view, region, pages));
    const DrawingModel drawing = drawing_model(view, world);
    const Camera camera = true_camera(view, region);
    const EffectPrediction prediction(truth, pages, camera, world, thread_count());
    Budget budget;
    budget.tolerance_px = tolerance_px;
    budget.air = world.air;
    budget.eye_h_m = camera.eye.h_m;
    budget.empty = prediction.empty();
    if (!budget.empty) {
        budget.nearest_m = prediction.nearest_m();
        budget.median_distance_m = prediction.median_distance_m();
        budget.sight_lines = prediction.sight_lines();
    }
    // A part by itself is judged to a thousandth of a pixel, as it is shown: tau 1 is within 1 px, whatever
    // micrometres coarse triangles move ground along the surface. The sum is judged as it is.
    constexpr double judged_to_px = 0.001;
    double largest_px = 0.0;
    for (const EffectFacts& effect : effect_table()) {
        // At full resolution, what the default would leave out.
        const double tau_px = view.tau_px > 0.0 ? view.tau_px : 1.0;
        ORO_TRY(const std::optional<EffectSize> size, prediction.size(effect.kind, tau_px));
        const bool in_picture = effect.in_picture(drawing, world);
        const bool modelled = effect.group == EffectGroup::model && is_modelled(effect.kind, drawing, world);
        budget.lines.push_back({effect.kind, size, in_picture, modelled,
                                !size || size->worst_px <= tolerance_px + judged_to_px});
        if (!in_picture || !size || size->worst_px <= largest_px) continue;
        largest_px = size->worst_px;
        budget.dominant = effect.kind;
    }
    if (const std::vector<HeightsOff> resampled = resampled_of(region); !resampled.empty() && !budget.empty)
        budget.resampling = prediction.heights_off(resampled);
    if (region.grids.front().canopy && !budget.empty)
        budget.vegetation = prediction.heights_off_by(
            [&](const ViewSample& sample) { return view.exaggeration * raised_by_m(region, sample); });
    if (detail_of(region) != nullptr && !budget.empty)
        budget.invented = prediction.heights_off_by(
            [&](const ViewSample& sample) { return view.exaggeration * invented_at_m(region, sample); });
    ORO_TRY(budget.total, prediction.total(drawing));
    return budget;
}

Result<AccuracyChoice> choose_accuracy(const View& view, const Region& region, const TrueGround& truth,
                                       const RegionPagesList& pages, double tolerance_px,
                                       const FixedAccuracy& fixed) {
    const auto with_fixed = [&](const AccuracyBundle& bundle) {
        return bundle_of(bundle.kind, bundle.name, fixed.tau_px.value_or(bundle.tau_px),
                         fixed.heights.value_or(bundle.heights), fixed.air.value_or(bundle.air));
    };
    View with = view;
    apply_bundle(with_fixed(accuracy_bundles().back()), with);
    ORO_TRY(const EarthParameters world, earth_parameters(with, region, pages));
    const EffectPrediction prediction(truth, pages, true_camera(view, region), world, thread_count());
    AccuracyChoice choice;
    choice.tolerance_px = tolerance_px;
    for (const AccuracyBundle& each : accuracy_bundles()) {
        const AccuracyBundle bundle = with_fixed(each);
        apply_bundle(bundle, with);
        ORO_TRY(const EffectSize total, prediction.total(drawing_model(with, world)));
        choice.bundle = bundle;
        choice.predicted_px = total.worst_px;
        choice.holds = total.worst_px <= tolerance_px;
        if (choice.holds) break;
    }
    for (const EffectFacts& effect : effect_table()) {
        if (effect.group != EffectGroup::model || !effect.in_picture(drawing_model(with, world), world))
            continue;
        ORO_TRY(const std::optional<EffectSize> size, prediction.size(effect.kind, with.tau_px));
        if (size && size->worst_px > tolerance_px) choice.left_out.push_back(effect.kind);
    }
    return choice;
}

}  // namespace oro
