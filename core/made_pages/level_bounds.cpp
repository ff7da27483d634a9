#include "core/made_pages/level_bounds.h"

#include <algorithm>
#include <cmath>

#include "core/earth/ellipsoid.h"
#include "core/made/made_rule.h"
#include "core/terrain/level_grid.h"

namespace oro {
namespace {

// Smallest and largest radii of curvature of WGS84, the latter with the highest heights on it.
constexpr double least_radius_m = 6'335'000.0, most_radius_m = 6'412'000.0;
// Whole numbers in place of real ones: places are right to 2^-5 m.
constexpr double place_m = 0.03125;

// What the term of an octave is at most, per metre of its amplitude and in cells of its lattice.
struct OctaveBounds {
    double reach;   // of itself, up or down
    double spread;  // between two of its values
    double slope;
    bool bends;  // it is smooth: how far it is from linear falls as the square of a triangle's size
    double rounding_m;
};
// ridged: the term is w (s - 0.66), where s = (1 - |noise|)^2 is 0 to 1 and no steeper than twice the noise,
// and w = 0.35 + 0.65 s of the octave before, whose cells are twice as wide. At crests s is not smooth. Each
// octave is rounded down to 2^-9 m.
OctaveBounds octave_bounds(const MadeTerrain& terrain) {
    constexpr double rounding_m = 0.01, ridged_step_m = 0.0025;
    if (terrain.kind == MadeKind::fbm)
        return {noise_most, 2.0 * noise_most, noise_slope_most, true, rounding_m};
    return {ridged_reach_most, ridged_spread_most, ridged_slope_most, false,
            rounding_m + ridged_step_m * terrain.octaves};
}

// A triangle's edges in quads of its level, along the longer and the shorter of its two ways.
struct TriangleShape {
    double longer;
    double shorter;
};
constexpr TriangleShape plain_shape{1.0, 1.0}, stitched_shape{2.0, 1.0};

// How much N changes at most from a node of its field to the next, along either axis, and over all.
struct UndulationSteps {
    double lat_m{};
    double lon_m{};
    double lat_nodes_per_deg{};
    double lon_nodes_per_deg{};
    double range_m{};
};
UndulationSteps steps_of(const UndulationField& field) {
    UndulationSteps steps;
    if (field.N_m.empty()) return steps;
    const auto columns = static_cast<std::size_t>(field.lon.count);
    for (std::size_t node = 0; node < field.N_m.size(); ++node) {
        const auto apart = [&](std::size_t other) {
            return std::abs(static_cast<double>(field.N_m[node]) - static_cast<double>(field.N_m[other]));
        };
        if (node % columns > 0) steps.lon_m = std::max(steps.lon_m, apart(node - 1));
        if (node >= columns) steps.lat_m = std::max(steps.lat_m, apart(node - columns));
    }
    steps.lat_nodes_per_deg = field.lat.posts_per_deg;
    steps.lon_nodes_per_deg = field.lon.posts_per_deg;
    const auto [lowest, highest] = std::ranges::minmax(field.N_m);
    steps.range_m = static_cast<double>(highest) - static_cast<double>(lowest);
    return steps;
}

class Bounds {
  public:
    Bounds(const MadeTerrain& terrain, const UndulationField& undulation)
        : rule_(made_rule(terrain)),
          octave_(octave_bounds(terrain)),
          spacing_deg_(1.0 / static_cast<double>(terrain.posts_per_deg)),
          range_m_(made_step_m * (terrain.high - terrain.low)),
          undulation_(steps_of(undulation)) {
        for (std::uint32_t i = 0; i < rule_.octaves; ++i)
            steepest_ += amplitude_m(i) * octave_.slope / cell_m(i);
    }

    // Ground no nearer to the equator than so many degrees from now on.
    void set_latitude(double from_equator_deg) {
        narrowing_ = std::cos(radians_from_deg(from_equator_deg).rad);
    }

    // Between the rule and what is linear over a level's triangles of posts, with N of it, and with heights
    // of rounded places; between these triangles and level 0's where `from_finest`.
    [[nodiscard]] MadeLevelBound::Of heights(int level, const TriangleShape& shape, bool from_finest) const {
        const Triangle triangle = triangle_of(level, shape), finest = triangle_of(0, plain_shape);
        MadeLevelBound::Of of;
        for (std::uint32_t i = 0; i < rule_.octaves; ++i) {
            // Both are between the octave's heights at posts.
            const double cell = cell_m(i), most = octave_.spread;
            const double also = from_finest ? 1.0 : 0.0;
            of.free += amplitude_m(i) * std::min(most, off(triangle, cell) + also * off(finest, cell));
            of.cut += amplitude_m(i) * std::min(most, sloped(triangle, cell) + also * sloped(finest, cell));
        }
        const double rest_m = (from_finest ? 2.0 : 1.0) * (steepest_ * place_m + octave_.rounding_m) +
                              undulation_m(level, shape) + (from_finest ? undulation_m(0, plain_shape) : 0.0);
        of.free += rest_m;
        of.cut = std::min(of.cut, range_m_) + rest_m;
        of.free = std::min(of.free, of.cut);
        return of;
    }

    // Octaves from the first on that curve less over triangles of a level than finer noise reaches.
    [[nodiscard]] std::uint32_t coarse_octaves(int level) const {
        const Triangle triangle = triangle_of(level, plain_shape), finest = triangle_of(0, plain_shape);
        std::uint32_t octave = 0;
        while (octave < rule_.octaves &&
               off(triangle, cell_m(octave)) + off(finest, cell_m(octave)) < octave_.reach)
            ++octave;
        return octave;
    }
    // Between the first octaves over a level's triangles and level 0's triangles of all octaves.
    [[nodiscard]] double coarse_heights(int level, std::uint32_t octaves) const {
        const Triangle triangle = triangle_of(level, plain_shape), finest = triangle_of(0, plain_shape);
        double most_m = 0.0;
        for (std::uint32_t i = 0; i < rule_.octaves; ++i) {
            const double cell = cell_m(i);
            most_m += amplitude_m(i) *
                      (i < octaves ? std::min(octave_.spread, off(triangle, cell) + off(finest, cell))
                                   : octave_.reach);
        }
        return most_m + 2.0 * (steepest_ * place_m + octave_.rounding_m) + undulation_m(level, plain_shape) +
               undulation_m(0, plain_shape);
    }

    // How far a flat triangle is from the one that is linear in latitude, longitude and height
    // (NodeDeviations::sag).
    [[nodiscard]] double sag_m(int level, const TriangleShape& shape) const {
        const double step_rad = std::ldexp(radians_from_deg(spacing_deg_).rad, level);
        const double both = (shape.longer + shape.shorter) * step_rad;
        return 0.125 * (most_radius_m * both * both + 2.0 * (range_m_ + undulation_.range_m) * both);
    }
    // What places of drawn posts are rounded by.
    [[nodiscard]] double placement_m(int level) const {
        return 2.0e-7 * gpu::page_quads * most_radius_m *
               std::ldexp(radians_from_deg(spacing_deg_).rad, level);
    }

  private:
    // The longest edge, and how much a way across that is straight in latitude and longitude bends in space.
    struct Triangle {
        double hypotenuse_m;
        double bend_m;
    };
    [[nodiscard]] Triangle triangle_of(int level, const TriangleShape& shape) const {
        const double step_m = std::ldexp(radians_from_deg(spacing_deg_).rad * most_radius_m, level);
        const double both = shape.longer + shape.shorter;
        // The longer way is the worse one from north to south: posts are closest from west to east.
        return {step_m * std::hypot(shape.longer, shape.shorter * narrowing_),
                1.03 * both * both * step_m * step_m / least_radius_m};
    }
    // Of an octave in cells: how far it is from linear over a triangle; where it is smooth; and by its slope
    // alone.
    [[nodiscard]] double off(const Triangle& over, double cell) const {
        return octave_.bends ? curved(over, cell) : sloped(over, cell);
    }
    [[nodiscard]] static double curved(const Triangle& over, double cell) {
        return noise_bend_most * over.hypotenuse_m * over.hypotenuse_m / (8.0 * cell * cell) +
               noise_slope_most * over.bend_m / (8.0 * cell);
    }
    [[nodiscard]] double sloped(const Triangle& over, double cell) const {
        return octave_.slope * 0.5 * (over.hypotenuse_m + over.bend_m) / cell;
    }
    [[nodiscard]] double amplitude_m(std::uint32_t octave) const {
        return std::ldexp(rule_.octave[octave].amplitude, -17);
    }
    [[nodiscard]] double cell_m(std::uint32_t octave) const {
        return std::ldexp(1.0, static_cast<int>(rule_.octave[octave].shift)) / 192.0;
    }
    // N is linear along either axis between nodes; its mean distance to the corners is half a triangle's
    // reach.
    [[nodiscard]] double undulation_m(int level, const TriangleShape& shape) const {
        const double reach_deg = 0.5 * shape.longer * std::ldexp(spacing_deg_, level);
        const double m = reach_deg * (undulation_.lat_m * undulation_.lat_nodes_per_deg +
                                      undulation_.lon_m * undulation_.lon_nodes_per_deg);
        return std::min(m, undulation_.range_m);
    }

    gpu::MadeRule rule_;
    OctaveBounds octave_;
    double spacing_deg_;
    double range_m_;
    double narrowing_{1.0};  // of the distance between meridians
    UndulationSteps undulation_;
    double steepest_{};  // metres a metre
};

void grow(MadeLevelBound::Of& level, const MadeLevelBound::Of& below) {
    constexpr double growth = 1.0002;
    level.free = std::max(level.free, growth * below.free);
    level.cut = std::max(level.cut, growth * below.cut);
}

std::vector<MadeLevelBound> bounds_of_levels(const Bounds& bounds,
                                             const std::vector<std::uint32_t>& coarse_octaves) {
    const double finest_sag_m = bounds.sag_m(0, plain_shape);
    std::vector<MadeLevelBound> levels(coarse_octaves.size());
    for (int k = 0; k < static_cast<int>(levels.size()); ++k) {
        MadeLevelBound& level = levels[static_cast<std::size_t>(k)];
        level.rule = bounds.heights(k, plain_shape, false);
        level.coarse_octaves = coarse_octaves[static_cast<std::size_t>(k)];
        level.coarse = bounds.coarse_heights(k, level.coarse_octaves) + finest_sag_m;
        const double sag_m = bounds.sag_m(k, plain_shape) + finest_sag_m;
        const MadeLevelBound::Of plain = bounds.heights(k, plain_shape, true);
        if (k > 0) level.triangles = {plain.free + sag_m, plain.cut + sag_m};
        const MadeLevelBound::Of drawn = bounds.heights(k, stitched_shape, true);
        const double rest_m = bounds.sag_m(k, stitched_shape) + finest_sag_m + bounds.placement_m(k);
        level.flat = rest_m + finest_sag_m;
        level.drawn = {drawn.free + rest_m, drawn.cut + rest_m};
        if (k == 0) continue;
        level.own = {plain.free + rest_m, plain.cut + rest_m};
        const MadeLevelBound& below = levels[static_cast<std::size_t>(k - 1)];
        grow(level.own, below.own);
        grow(level.drawn, below.drawn);
    }
    return levels;
}

}  // namespace

std::vector<std::vector<MadeLevelBound>> made_level_bounds(const MadeTerrain& terrain, const PostGrid& grid,
                                                           const UndulationField& undulation) {
    Bounds bounds(terrain, undulation);
    std::vector<std::uint32_t> coarse_octaves;
    for (int level = 0; level < level_count(grid); ++level)
        coarse_octaves.push_back(bounds.coarse_octaves(level));
    std::vector<std::vector<MadeLevelBound>> from_deg;
    for (int deg = 0; deg < 90; ++deg) {
        bounds.set_latitude(deg);
        from_deg.push_back(bounds_of_levels(bounds, coarse_octaves));
    }
    return from_deg;
}

}  // namespace oro
