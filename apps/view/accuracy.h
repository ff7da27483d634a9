// How accurate a picture is to be: bundles of options, what a view's effects add up to, and the choice of a
// bundle by a tolerance.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/view/truth.h"
#include "apps/view/view.h"
#include "core/effects/effects.h"
#include "core/frame/region_pages.h"

namespace oro {

enum class Bundle { draft, balanced, survey };

// What --accuracy stands for.
struct AccuracyBundle {
    Bundle kind;
    const char* name;
    double tau_px;
    HeightStorage heights;
    Air air;
    std::string options{};  // the same, as one would write them out
};
// draft, balanced, survey: the cheapest first.
const std::vector<AccuracyBundle>& accuracy_bundles();
const char* bundle_name(Bundle kind);
// Their names, as --accuracy lists them.
std::vector<std::string> accuracy_words();
// Usage errors: no such bundle.
Result<AccuracyBundle> accuracy_bundle(const std::string& name);
void apply_bundle(const AccuracyBundle& bundle, View& view);
// Whether a view is drawn as the bundle says.
bool is_drawn_as(const AccuracyBundle& bundle, const View& view);
// Takes the bundle's name out of a view that has become another than what the name stands for.
void forget_other_bundle(View& view);

// "1px", "0.5 px" or "1": pixels, 0.001 to 1000. Usage errors for anything else.
Result<double> parse_tolerance(const std::string& text);

// What holds of one effect in a view.
struct BudgetLine {
    EffectKind kind;
    std::optional<EffectSize> size;  // nothing where the source says nothing
    bool in_picture;                 // it is an error of this picture
    bool modelled;                   // group model: the picture has the part that it would be without
    bool within_tolerance;           // true where there is no size
    // Without this part of the model no picture of this view is within the tolerance.
    [[nodiscard]] bool needed() const {
        return facts_of(kind).group == EffectGroup::model && !within_tolerance;
    }
};

// All effects of a view. total: of those in the picture, but for those of the data.
struct Budget {
    double tolerance_px{};
    std::vector<BudgetLine> lines;
    EffectSize total;
    // Of the data, measured when the region was opened; nothing where none were resampled.
    std::optional<EffectSize> resampling;
    // What a picture without the view's canopy would be off by; nothing where it has none.
    std::optional<EffectSize> vegetation;
    // What the ground that --detail invents moves on the picture; nothing where it has none.
    std::optional<EffectSize> invented;
    std::optional<EffectKind> dominant;  // the largest in the picture, in pixels
    bool empty{};                        // nothing is in view
    Air air;                             // of the true world
    double eye_h_m{};                    // where its eye truly is
    double nearest_m{};
    double median_distance_m{};
    std::size_t sight_lines{};  // that estimates are made of
};

// The true world of a view, of all grids of its region: the air is the view's own, or standard air where
// light goes straight in it.
Result<EarthParameters> earth_parameters(const View& view, const Region& region,
                                         const RegionPagesList& pages);
DrawingModel drawing_model(const View& view, const EarthParameters& world);

// Errors: pages that cannot be read.
Result<Budget> plan_view(const View& view, const Region& region, const TrueGround& truth,
                         const RegionPagesList& pages, double tolerance_px);

// What single options fix, whatever a bundle says.
struct FixedAccuracy {
    std::optional<double> tau_px;
    std::optional<HeightStorage> heights;
    std::optional<Air> air;
};

// The cheapest bundle whose whole predicted error stays within a tolerance.
struct AccuracyChoice {
    AccuracyBundle bundle;  // with what is fixed
    double tolerance_px{};
    double predicted_px{};  // of the chosen one
    bool holds{};           // false: not even survey does, and it was taken
    // What the view leaves out whatever its bundle, and is beyond the tolerance by itself.
    std::vector<EffectKind> left_out{};
};
Result<AccuracyChoice> choose_accuracy(const View& view, const Region& region, const TrueGround& truth,
                                       const RegionPagesList& pages, double tolerance_px,
                                       const FixedAccuracy& fixed = {});

}  // namespace oro
