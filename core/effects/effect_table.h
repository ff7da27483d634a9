// The effects that make a picture wrong, and what is known of each before any view: the one table from which
// everything that lists or names them is made.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/earth/world_model.h"
#include "core/frame/height_quantization.h"

namespace oro {

// In the order in which tables have them.
enum class EffectKind {
    geoid,          // H taken for h, the eye's, too
    sphere,         // Earth::sphere
    flat,           // Earth::flat
    refraction,     // light that goes straight
    float32_posts,  // Precision::rounded_posts
    float32_view,   // Precision::naive, its rounded posts included
    steps_i16,      // heights in 16 bits
    detail,         // levels at tau
    steps_f32,      // heights in steps of 2^-11 m
    placement,      // float32 relative to the eye
    depth,          // what a depth in float32 resolves
    pixel_grid,     // corners of triangles on a grid of 1/256 px
    flat_cells,     // triangles of full resolution are flat, the surface is curved
    interpolation,  // between posts nobody has measured
    source,         // what the source says of its own accuracy
};
inline constexpr std::size_t effect_kinds = 15;

enum class EffectGroup {
    model,    // a part of the model that a view may leave out: then the effect is in its picture
    drawing,  // what drawing itself rounds off
    data,     // limits of the data: no way of drawing helps
};

// How anybody knows what an effect really does to a picture.
enum class EffectMeasure {
    picture,      // one that has it, held against the full resolution
    full_detail,  // not by itself: it is in the picture at full detail, with the others that remain there
    thinned,      // every second post is left out, and is known
    made,         // the terrain is made, and its rule is known between posts
    stated,       // nobody: the source says it of itself
};

// How the worst size of an effect is known.
enum class EffectBound {
    derived,    // no ground point is moved farther
    estimated,  // the largest of many sight lines, times a margin
    stated,     // by the source, of itself
};

// How a view is to be drawn.
struct DrawingModel {
    WorldModel world;
    bool geoid{true};           // false: N = 0
    HeightQuantization coding;  // of the heights on the GPU
    double tau_px{1.0};
};

// What is known of the world and of the region, besides its posts.
struct EarthParameters {
    Air air{standard_air};
    struct OfGrid {
        std::optional<double> source_le90_m;  // half the interval that holds 90 % of the source's errors
        HeightQuantization sixteen;           // what i16 would be for it
    };
    std::vector<OfGrid> grids{OfGrid{}};  // numbered as the ground's
};

struct EffectFacts {
    EffectKind kind;
    EffectGroup group;
    EffectMeasure measured_by;
    EffectBound bound;
    const char* key;                         // for programs that read JSON
    const char* name;                        // for people: group model: of the part; else of the error
    const char* left_out_by;                 // the option that leaves the part out; "" where there is none
    const char* meaning;                     // of the error, in one sentence
    std::optional<EffectKind> contained_in;  // the larger effect that does this, too
    bool (*in_picture)(const DrawingModel& drawing, const EarthParameters& world);
};
const std::array<EffectFacts, effect_kinds>& effect_table();
const EffectFacts& facts_of(EffectKind kind);
// The effect's name as an error, made of the table's: "no geoid", "ground between the posts".
std::string error_name(EffectKind kind);

// Whether an effect is in a picture that is drawn so, and counts by itself: not the sphere on a flat Earth.
bool is_in_picture(EffectKind kind, const DrawingModel& drawing, const EarthParameters& world);
// Whether a picture that is drawn so has the part of the model whose absence is the effect. Group model only.
bool is_modelled(EffectKind kind, const DrawingModel& drawing, const EarthParameters& world);

}  // namespace oro
