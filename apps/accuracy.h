// How accurate a picture is to be: bundles of options, what a view's effects add up to, and the choice of a
// bundle by a tolerance.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/truth.h"
#include "apps/view.h"
#include "core/effects.h"
#include "core/region_pages.h"

namespace oro {

// What --accuracy stands for.
struct AccuracyBundle {
    const char* name;
    double tau_px;
    HeightStorage heights;
    double refraction_k;
    std::string options{};  // the same, as one would write them out
};
// draft, balanced, survey: the cheapest first.
const std::vector<AccuracyBundle>& accuracy_bundles();
// Usage errors: no such bundle.
Result<AccuracyBundle> accuracy_bundle(const std::string& name);
void apply_bundle(const AccuracyBundle& bundle, View& view);
// Takes the bundle's name out of a view that has become another than what the name stands for.
void forget_other_bundle(View& view);

// "1px", "0.5 px" or "1": pixels, 0.001 to 1000. Usage errors for anything else.
Result<double> parse_tolerance(const std::string& text);

// What holds of one effect in a view.
struct BudgetLine {
    EffectKind kind;
    std::optional<EffectSize> size;  // nothing where the source says nothing
    bool in_picture;                 // left out, or rounded: else it is modelled, and this is what that saves
    bool can_be_helped;              // by some way of drawing
    bool below_tolerance;
};

// All effects of a view. total: of those in the picture that can be helped.
struct Budget {
    double tolerance_px{};
    std::vector<BudgetLine> lines;
    EffectSize total;
    std::optional<EffectKind> dominant;  // the largest in the picture, in pixels
    bool empty{};                        // nothing is in view
    double nearest_m{};
    double median_distance_m{};
};

// The true world of a view: refraction is the view's own, or the usual one where it has none.
Result<TrueWorld> true_world(const View& view, const Region& region, const RegionPages& pages);
DrawingModel drawing_model(const View& view, const TrueWorld& world);

// Errors: pages that cannot be read.
Result<Budget> plan_view(const View& view, const Region& region, const TrueSurface& truth,
                         const RegionPages& pages, double tolerance_px);

// What single options fix, whatever a bundle says.
struct FixedAccuracy {
    std::optional<double> tau_px;
    std::optional<HeightStorage> heights;
    std::optional<double> refraction_k;
};

// The cheapest bundle whose whole predicted error stays within a tolerance.
struct AccuracyChoice {
    AccuracyBundle bundle;  // with what is fixed
    double tolerance_px{};
    double predicted_px{};  // of the chosen one
    bool holds{};           // false: not even survey does, and it was taken
};
Result<AccuracyChoice> choose_accuracy(const View& view, const Region& region, const TrueSurface& truth,
                                       const RegionPages& pages, double tolerance_px,
                                       const FixedAccuracy& fixed = {});

}  // namespace oro
