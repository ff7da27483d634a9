#include "core/effects/effect_table.h"

#include <cassert>

namespace oro {
namespace {

using enum EffectKind;
using Drawing = DrawingModel;
using World = EarthParameters;

constexpr auto in_every_picture = [](const Drawing&, const World&) { return true; };

constexpr std::array<EffectFacts, effect_kinds> table{{
    {geoid, EffectGroup::model, EffectMeasure::picture, EffectBound::estimated, "geoid", "geoid",
     "--geoid none", "Heights above sea level are taken for heights above the ellipsoid.", std::nullopt,
     [](const Drawing& drawn, const World&) { return !drawn.geoid; }},
    {sphere, EffectGroup::model, EffectMeasure::picture, EffectBound::estimated, "sphere", "ellipsoid",
     "--earth sphere", "The Earth is drawn as a sphere instead of the WGS84 ellipsoid.", flat,
     [](const Drawing& drawn, const World&) { return drawn.world.earth == Earth::sphere; }},
    {flat, EffectGroup::model, EffectMeasure::picture, EffectBound::estimated, "flat", "curve of the Earth",
     "--earth flat",
     "The Earth is drawn as a plane: ground at a distance d is drawn some d^2 / 2R too high, and shows where "
     "the curve hides it.",
     std::nullopt, [](const Drawing& drawn, const World&) { return drawn.world.earth == Earth::flat; }},
    {refraction, EffectGroup::model, EffectMeasure::picture, EffectBound::estimated, "refraction",
     "refraction", "--refraction 0", "Light goes straight: far ground is drawn lower than it is seen.",
     std::nullopt, [](const Drawing& drawn, const World& world) { return drawn.world.air != world.air; }},
    {float32_posts, EffectGroup::model, EffectMeasure::picture, EffectBound::derived, "float32_posts",
     "double-precision posts", "",
     "Each post is rounded to float32 from the Earth's centre, in steps of up to half a metre.", float32_view,
     [](const Drawing& drawn, const World&) { return drawn.world.precision == Precision::rounded_posts; }},
    {float32_view, EffectGroup::model, EffectMeasure::picture, EffectBound::derived, "float32_view",
     "double-precision view", "--precision naive",
     "Posts are rounded to float32, and so is their way from the Earth's centre to the eye.", std::nullopt,
     [](const Drawing& drawn, const World&) { return drawn.world.precision == Precision::naive; }},
    {steps_i16, EffectGroup::model, EffectMeasure::picture, EffectBound::derived, "steps_i16",
     "32-bit heights", "--heights i16",
     "Heights are kept on the GPU in half the bytes, and so in coarser steps.", std::nullopt,
     [](const Drawing& drawn, const World&) { return drawn.coding.sixteen; }},
    {detail, EffectGroup::model, EffectMeasure::picture, EffectBound::derived, "detail", "full detail",
     "--tau", "Posts are left out where that moves nothing by more than tau pixels.", std::nullopt,
     [](const Drawing& drawn, const World&) { return drawn.tau_px > 0.0; }},
    {steps_f32, EffectGroup::drawing, EffectMeasure::full_detail, EffectBound::derived, "steps_f32",
     "heights in steps of 0.5 mm", "", "Heights are drawn in steps of half a millimetre.", steps_i16,
     [](const Drawing& drawn, const World&) { return !drawn.coding.sixteen; }},
    {placement, EffectGroup::drawing, EffectMeasure::full_detail, EffectBound::derived, "placement",
     "positions rounded to float32", "",
     "Positions relative to the eye are rounded to float32, to 3.2e-7 of their distance.", float32_view,
     [](const Drawing& drawn, const World&) { return drawn.world.precision == Precision::relative; }},
    {depth, EffectGroup::drawing, EffectMeasure::full_detail, EffectBound::derived, "depth",
     "distances rounded to float32", "",
     "The distance that the GPU keeps for each pixel is rounded to float32.", std::nullopt, in_every_picture},
    {pixel_grid, EffectGroup::drawing, EffectMeasure::full_detail, EffectBound::derived, "pixel_grid",
     "corners in steps of 1/256 px", "", "GPUs put the corners of triangles on a grid of 1/256 pixel.",
     std::nullopt, in_every_picture},
    {flat_cells, EffectGroup::drawing, EffectMeasure::full_detail, EffectBound::derived, "flat_cells",
     "flat triangles between posts", "",
     "Triangles between posts are flat, and lie a little below the curve of the Earth.", std::nullopt,
     in_every_picture},
    {interpolation, EffectGroup::data, EffectMeasure::thinned, EffectBound::estimated, "interpolation",
     "ground between the posts", "",
     "Nobody has measured the ground between the posts: it may be higher or lower than straight lines.",
     std::nullopt, in_every_picture},
    {source, EffectGroup::data, EffectMeasure::stated, EffectBound::stated, "source", "errors of the source",
     "", "Heights may be as far off as the source states of itself.", std::nullopt, in_every_picture},
}};

constexpr bool in_order() {
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (static_cast<std::size_t>(table[i].kind) != i) return false;
    }
    return true;
}
static_assert(in_order());

}  // namespace

const std::array<EffectFacts, effect_kinds>& effect_table() {
    return table;
}

const EffectFacts& facts_of(EffectKind kind) {
    return table[static_cast<std::size_t>(kind)];
}

std::string error_name(EffectKind kind) {
    const EffectFacts& facts = facts_of(kind);
    return (facts.group == EffectGroup::model ? "no " : "") + std::string(facts.name);
}

bool is_in_picture(EffectKind kind, const DrawingModel& drawing, const EarthParameters& world) {
    return facts_of(kind).in_picture(drawing, world);
}

bool is_modelled(EffectKind kind, const DrawingModel& drawing, const EarthParameters& world) {
    const EffectFacts& facts = facts_of(kind);
    assert(facts.group == EffectGroup::model);
    return !is_in_picture(kind, drawing, world) &&
           !(facts.contained_in && is_in_picture(*facts.contained_in, drawing, world));
}

}  // namespace oro
