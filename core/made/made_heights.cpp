#include "core/made/made_heights.h"

#include <algorithm>
#include <cmath>

#include "core/base/wide.h"
#include "core/earth/ellipsoid.h"
#include "core/made/fbm_octaves.h"

namespace oro::gpu {
namespace {

inline std::int32_t made_high(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>((static_cast<std::int64_t>(a) * b) >> 32);
}
inline std::uint32_t made_high(std::uint32_t a, std::uint32_t b) {
    return static_cast<std::uint32_t>((static_cast<std::uint64_t>(a) * b) >> 32U);
}

#define ORO_FUNCTION [[maybe_unused]] inline __attribute__((always_inline))
#define ORO_MADE_CONST inline constexpr
#define ORO_INOUT(type) type&
#define ORO_RULE const MadeRule &rule,
#define ORO_PASS rule,
#include "shaders/made/made_heights.glsl"
#undef ORO_PASS
#undef ORO_RULE
#undef ORO_INOUT
#undef ORO_MADE_CONST
#undef ORO_FUNCTION

}  // namespace
}  // namespace oro::gpu

namespace oro {
namespace {

// Places and sums of a run of posts: as many as stay near the processor.
constexpr std::size_t run_posts = 256;
struct MadeRun {
    std::array<std::int32_t, run_posts> x, y, z, sum, weight;
};

void place_run(const MadeRow& row, std::span<const MadeColumn> columns, MadeRun& run) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
        run.x[i] = gpu::made_place(row.from_axis, columns[i].cosine);
        run.y[i] = gpu::made_place(row.from_axis, columns[i].sine);
        run.z[i] = row.north;
    }
}

// count: a multiple of 16.
void add_fbm(const gpu::MadeOctave& octave, MadeRun& run, std::size_t count) {
    static const AddOctave lanes =
        octaves_by_sixteen() != nullptr ? octaves_by_sixteen() : octaves_by_eight();
    if (lanes != nullptr)
        return lanes(octave, run.x.data(), run.y.data(), run.z.data(), run.sum.data(), count);
    for (std::size_t i = 0; i < count; ++i)
        run.sum[i] += gpu::made_fbm_octave(octave, run.x[i], run.y[i], run.z[i]);
}
void add_ridged(const gpu::MadeOctave& octave, MadeRun& run, std::size_t count) {
    static const AddRidgedOctave lanes =
        ridged_octaves_by_sixteen() != nullptr ? ridged_octaves_by_sixteen() : ridged_octaves_by_eight();
    if (lanes != nullptr)
        return lanes(octave, run.x.data(), run.y.data(), run.z.data(), run.sum.data(), run.weight.data(),
                     count);
    for (std::size_t i = 0; i < count; ++i)
        run.sum[i] += gpu::made_ridged_octave(octave, run.x[i], run.y[i], run.z[i], run.weight[i]);
}

void begin_sums(MadeRun& run) {
    run.sum.fill(0);
    run.weight.fill(1 << 28);
}
// Of a rule that has octaves. count: a multiple of 16.
void add_octave(const gpu::MadeRule& rule, std::uint32_t number, MadeRun& run, std::size_t count) {
    if (rule.kind == gpu::made_fbm)
        add_fbm(rule.octave[number], run, count);
    else
        add_ridged(rule.octave[number], run, count);
}

ORO_WIDE void add_noise_run(const gpu::MadeOctave& octave, float factor, const std::int32_t* x,
                            const std::int32_t* y, const std::int32_t* z, float* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        values[i] += factor * static_cast<float>(gpu::made_octave_noise(octave, x[i], y[i], z[i]));
}

bool has_octaves(const gpu::MadeRule& rule) {
    return rule.kind == gpu::made_fbm || rule.kind == gpu::made_ridged;
}

std::uint32_t parity_of(const MadeTerrain& terrain, std::int64_t lat_post, std::int64_t lon_post) {
    // A pole is one place, whatever its column.
    if (lat_post == 90 * terrain.posts_per_deg || lat_post == -90 * terrain.posts_per_deg) return 0;
    return static_cast<std::uint32_t>((lat_post + lon_post) & 1);
}

}  // namespace

std::vector<MadeColumn> made_columns(const MadeTerrain& terrain, int first, int count) {
    std::vector<MadeColumn> columns;
    columns.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        columns.push_back(made_column(terrain.west + first + i, terrain.posts_per_deg));
    return columns;
}

void made_row_coarse_heights(const MadeTerrain& terrain, const gpu::MadeRule& rule, int row,
                             std::span<const MadeColumn> columns, std::uint32_t coarse_octaves,
                             std::span<std::int32_t> steps, std::span<std::int32_t> coarse_steps) {
    const MadeRow placed = made_row(terrain.north - row, terrain.posts_per_deg);
    const std::int32_t middle = rule.low + ((rule.high - rule.low) >> 1);
    MadeRun run{};
    for (std::size_t first = 0; first < steps.size(); first += run_posts) {
        const std::size_t count = std::min(run_posts, steps.size() - first);
        const std::size_t whole = (count + 15) / 16 * 16;
        place_run(placed, columns.subspan(first, count), run);
        begin_sums(run);
        for (std::uint32_t k = 0; k <= rule.octaves; ++k) {
            if (k == coarse_octaves)
                for (std::size_t i = 0; i < count; ++i)
                    coarse_steps[first + i] = middle + ((run.sum[i] + 2) >> 2);
            if (k < rule.octaves) add_octave(rule, k, run, whole);
        }
        for (std::size_t i = 0; i < count; ++i) steps[first + i] = gpu::made_octaves_height(rule, run.sum[i]);
    }
}

void made_row_of_octaves(const MadeTerrain& terrain, const gpu::MadeRule& rule, int row,
                         std::span<const MadeColumn> columns, std::uint32_t octaves,
                         std::span<std::int32_t> steps) {
    const MadeRow placed = made_row(terrain.north - row, terrain.posts_per_deg);
    const std::int32_t middle = rule.low + ((rule.high - rule.low) >> 1);
    MadeRun run{};
    for (std::size_t first = 0; first < steps.size(); first += run_posts) {
        const std::size_t count = std::min(run_posts, steps.size() - first);
        place_run(placed, columns.subspan(first, count), run);
        begin_sums(run);
        for (std::uint32_t k = 0; k < octaves; ++k) add_octave(rule, k, run, (count + 15) / 16 * 16);
        for (std::size_t i = 0; i < count; ++i) steps[first + i] = middle + ((run.sum[i] + 2) >> 2);
    }
}

void made_row_heights(const MadeTerrain& terrain, const gpu::MadeRule& rule, int row, int first_column,
                      std::span<const MadeColumn> columns, std::span<std::int32_t> steps) {
    const std::int64_t lat_post = terrain.north - row;
    const MadeRow placed = made_row(lat_post, terrain.posts_per_deg);
    MadeRun run{};
    for (std::size_t first = 0; first < steps.size(); first += run_posts) {
        const std::size_t count = std::min(run_posts, steps.size() - first);
        const std::int64_t lon_post = terrain.west + first_column + static_cast<std::int64_t>(first);
        place_run(placed, columns.subspan(first, count), run);
        if (!has_octaves(rule)) {
            for (std::size_t i = 0; i < count; ++i)
                steps[first + i] =
                    gpu::made_height(rule, run.x[i], run.y[i], run.z[i],
                                     parity_of(terrain, lat_post, lon_post + static_cast<std::int64_t>(i)));
            continue;
        }
        const std::size_t whole = (count + 15) / 16 * 16;
        begin_sums(run);
        for (std::uint32_t k = 0; k < rule.octaves; ++k) add_octave(rule, k, run, whole);
        for (std::size_t i = 0; i < count; ++i) steps[first + i] = gpu::made_octaves_height(rule, run.sum[i]);
    }
}

void add_made_noise(const gpu::MadeOctave& octave, float factor, std::span<const std::int32_t> x,
                    std::span<const std::int32_t> y, std::span<const std::int32_t> z,
                    std::span<float> values) {
    add_noise_run(octave, factor, x.data(), y.data(), z.data(), values.data(), values.size());
}

double made_height_m(const MadeTerrain& terrain, const gpu::MadeRule& rule, double lat_deg, double lon_deg) {
    const auto post = [&](double deg) {
        return static_cast<std::int64_t>(std::llround(deg * static_cast<double>(terrain.posts_per_deg)));
    };
    const auto units = [](double metres) { return static_cast<std::int32_t>(std::lround(metres * 64.0)); };
    const glm::dvec3 place = ecef_from_geodetic({lat_deg, lon_deg, 0.0}).m;
    const std::uint32_t parity = parity_of(terrain, post(lat_deg), post(lon_deg));
    return made_step_m * gpu::made_height(rule, units(place.x), units(place.y), units(place.z), parity);
}

}  // namespace oro
