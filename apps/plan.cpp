// orograph plan: how large each effect is in a view, before anything is drawn.
#include <cstdio>

#include "apps/accuracy.h"
#include "apps/commands.h"
#include "apps/json_text.h"
#include "apps/progress_bar.h"
#include "apps/region_scene.h"
#include "core/parallel.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

// "12", "0.031", "<0.001": three digits, nothing finer than a thousandth.
std::string figure(double value) {
    char text[40];
    if (value == 0.0) return "0";
    if (value < 0.001) return "<0.001";
    if (value >= 9999.5) {
        std::snprintf(text, sizeof text, "%.0f", value);
        return text;
    }
    std::snprintf(text, sizeof text, "%.*f",
                  value >= 100.0  ? 0
                  : value >= 10.0 ? 1
                  : value >= 1.0  ? 2
                                  : 3,
                  value);
    return text;
}

// What a line says of its effect, in a few words.
std::string verdict(const BudgetLine& line) {
    if (!line.can_be_helped) return line.size ? "limit of the data" : "not stated by the source";
    if (line.in_picture)
        return line.below_tolerance ? "in the picture, below the tolerance"
                                    : "in the picture, ABOVE the tolerance";
    return line.below_tolerance ? "modelled, can be left out" : "modelled, needed";
}

std::string plan_text(const Budget& budget, const View& view) {
    char text[240];
    std::string out;
    if (budget.empty) return "nothing of the region is in view: there is nothing to predict\n";
    std::snprintf(text, sizeof text,
                  "ground from %s m, half of it beyond %s m; %d x %d px, %g degrees; tolerance %g px\n\n",
                  figure(budget.nearest_m).c_str(), figure(budget.median_distance_m).c_str(),
                  view.camera.width_px, view.camera.height_px, view.camera.vertical_fov_deg,
                  budget.tolerance_px);
    out += text;
    std::snprintf(text, sizeof text, "%-30s %10s %10s %10s %10s\n", "effect", "worst m", "typical m",
                  "worst px", "typical px");
    out += text;
    for (const BudgetLine& line : budget.lines) {
        const EffectSize size = line.size.value_or(EffectSize{});
        const auto shown = [&](double value) { return line.size ? figure(value) : std::string("-"); };
        std::snprintf(text, sizeof text, "%-30s %10s %10s %10s %10s  %s%s\n", name_of(line.kind),
                      shown(size.worst_m).c_str(), shown(size.typical_m).c_str(),
                      shown(size.worst_px).c_str(), shown(size.typical_px).c_str(), verdict(line).c_str(),
                      budget.dominant == line.kind ? "  <- dominates" : "");
        out += text;
    }
    std::snprintf(
        text, sizeof text, "%-30s %10s %10s %10s %10s  %s\n", "this picture, all but the data",
        figure(budget.total.worst_m).c_str(), figure(budget.total.typical_m).c_str(),
        figure(budget.total.worst_px).c_str(), figure(budget.total.typical_px).c_str(),
        budget.total.worst_px <= budget.tolerance_px ? "within the tolerance" : "beyond the tolerance");
    out += text;
    return out;
}

ordered_json size_json(const EffectSize& size) {
    return {{"worst_m", size.worst_m},
            {"typical_m", size.typical_m},
            {"worst_px", size.worst_px},
            {"typical_px", size.typical_px}};
}

ordered_json plan_json(const Budget& budget, const View& view, const AccuracyChoice& choice) {
    ordered_json json;
    json["tolerance_px"] = budget.tolerance_px;
    json["in_view"] = !budget.empty;
    json["nearest_m"] = budget.nearest_m;
    json["median_distance_m"] = budget.median_distance_m;
    json["effects"] = ordered_json::array();
    for (const BudgetLine& line : budget.lines) {
        ordered_json effect{{"effect", name_of(line.kind)}};
        effect["size"] = nullptr;
        if (line.size) effect["size"] = size_json(*line.size);
        effect["in_picture"] = line.in_picture;
        effect["limit_of_the_data"] = !line.can_be_helped;
        effect["below_tolerance"] = line.below_tolerance;
        json["effects"].push_back(effect);
    }
    json["total"] = size_json(budget.total);
    json["dominates"] = nullptr;
    if (budget.dominant) json["dominates"] = name_of(*budget.dominant);
    json["cheapest"] = {{"accuracy", choice.bundle.name},
                        {"options", choice.bundle.options},
                        {"predicted_px", choice.predicted_px},
                        {"holds", choice.holds}};
    json["view"] = ordered_json::parse(view_to_json(view, false));
    return json;
}

}  // namespace

Result<void> run_plan(const PlanOptions& options) {
    double tolerance_px = 1.0;
    if (options.view.tolerance) {
        ORO_TRY(tolerance_px, parse_tolerance(*options.view.tolerance));
    }
    // Here a tolerance judges what is asked for, and chooses nothing.
    ViewOptions view_options = options.view;
    view_options.tolerance.reset();
    ProgressBar bar(options.quiet);
    View view;
    Region region;
    ORO_CHECK(open_view(
        options.view_file, view_options, options.region,
        [&](double share, const std::string& what) { bar.show(share, "reading " + what); }, view, region));
    ORO_TRY(
        const std::unique_ptr<RegionPages> pages,
        region_pages(region, view.exaggeration, [&](double share) { bar.show(share, "measuring levels"); }));
    ORO_TRY(const std::unique_ptr<TrueScene> truth, TrueScene::of(view, region));
    bar.clear();
    for (const std::string& note : region.notes) say(options.quiet, "note: " + note);
    ORO_TRY(const Budget budget, plan_view(view, region, truth->surface(), *pages, tolerance_px));
    ORO_TRY(const AccuracyChoice choice,
            choose_accuracy(view, region, truth->surface(), *pages, tolerance_px));
    if (options.json) {
        std::printf("%s\n", json_text(plan_json(budget, view, choice), true).c_str());
        return {};
    }
    std::fputs(plan_text(budget, view).c_str(), stdout);
    if (!budget.empty)
        std::printf("\ncheapest that %s %g px: --accuracy %s (%s), predicted %s px\n",
                    choice.holds ? "holds" : "comes near", tolerance_px, choice.bundle.name,
                    choice.bundle.options.c_str(), figure(choice.predicted_px).c_str());
    return {};
}

}  // namespace oro
