#include "core/made/made_rule.h"

#include <algorithm>

#include "core/base/lowbias32.h"

namespace oro {
namespace {

// Fixed point with 60 bits behind the point; numbers are below 8.
using Fixed60 = std::int64_t;
constexpr Fixed60 one60 = std::int64_t{1} << 60;
constexpr Fixed60 degree60 = 20122276272436452;               // pi / 180
constexpr Fixed60 eccentricity_squared60 = 7718094650643697;  // of WGS84: f (2 - f), f = 1 / 298.257223563
constexpr std::int64_t equator_units = 408200768;             // 6378137 m in 2^-6 m

// The upper part of a product of two numbers that are not negative: a b / 2^60, rounded down.
std::uint64_t product60(std::uint64_t a, std::uint64_t b) {
    const std::uint64_t a1 = a >> 32, a0 = a & 0xffffffffU, b1 = b >> 32, b0 = b & 0xffffffffU;
    const std::uint64_t middle = a1 * b0 + ((a0 * b0) >> 32);
    const std::uint64_t middle2 = a0 * b1 + (middle & 0xffffffffU);
    const std::uint64_t high = a1 * b1 + (middle >> 32) + (middle2 >> 32);
    const std::uint64_t low = (middle2 << 32) | ((a0 * b0) & 0xffffffffU);
    return (high << 4) | (low >> 60);
}
Fixed60 times(Fixed60 a, Fixed60 b) {
    const bool negative = (a < 0) != (b < 0);
    const auto size = static_cast<Fixed60>(
        product60(static_cast<std::uint64_t>(a < 0 ? -a : a), static_cast<std::uint64_t>(b < 0 ? -b : b)));
    return negative ? -size : size;
}

struct Turned60 {
    Fixed60 cosine, sine;
};

// Cosine and sine of post / posts_per_deg degrees, 0 to 45, by Taylor's series.
Turned60 small_angle(std::int64_t post, std::int64_t posts_per_deg) {
    const std::int64_t whole = post / posts_per_deg, rest = post % posts_per_deg;
    const Fixed60 angle = whole * degree60 + (degree60 / posts_per_deg) * rest +
                          (degree60 % posts_per_deg) * rest / posts_per_deg;
    const Fixed60 square = times(angle, angle);
    Fixed60 sine = one60, cosine = one60;
    for (int n = 18; n > 0; n -= 2) {
        sine = one60 - times(square, sine) / (n * (n + 1));
        cosine = one60 - times(square, cosine) / (n * (n - 1));
    }
    return {cosine, times(angle, sine)};
}

// Of any angle.
Turned60 turned(std::int64_t post, std::int64_t posts_per_deg) {
    const std::int64_t turn = 360 * posts_per_deg, quarter = 90 * posts_per_deg;
    const std::int64_t in_turn = ((post % turn) + turn) % turn;
    const std::int64_t quadrant = in_turn / quarter, left = in_turn % quarter;
    Turned60 part{};
    if (2 * left <= quarter) {
        part = small_angle(left, posts_per_deg);
    } else {
        const Turned60 other = small_angle(quarter - left, posts_per_deg);
        part = {other.sine, other.cosine};
    }
    if (quadrant == 0) return part;
    if (quadrant == 1) return {-part.sine, part.cosine};
    if (quadrant == 2) return {-part.cosine, -part.sine};
    return {part.sine, -part.cosine};
}

std::int32_t rounded(Fixed60 value, int bits) {
    return static_cast<std::int32_t>((value + (std::int64_t{1} << (bits - 1))) >> bits);
}

void set_octaves(const MadeTerrain& terrain, gpu::MadeRule& rule) {
    rule.octaves = std::min(terrain.octaves, gpu::made_octaves_most);
    // The sum of an endless row of octaves is 1: more octaves add to what fewer have made.
    const std::uint64_t half = static_cast<std::uint64_t>(terrain.high - terrain.low) / 2;
    const std::uint64_t bound = (half << 6U) * 100 / made_noise_percent;       // 2^-17 m
    std::uint64_t share = (std::uint64_t{1000 - terrain.gain} << 24U) / 1000;  // 2^-24
    for (std::uint32_t i = 0; i < rule.octaves; ++i) {
        gpu::MadeOctave& octave = rule.octave[i];
        octave = made_octave(terrain.seed, i, terrain.cell_shift - i);
        octave.amplitude = static_cast<std::int32_t>((bound * share) >> 24U);
        share = share * terrain.gain / 1000;
    }
}

// The direction of an azimuth at the box's centre, times num / den: what each 2^-6 m along it adds.
void set_direction(const MadeTerrain& terrain, std::uint64_t num, std::uint64_t den, gpu::MadeRule& rule) {
    const Turned60 lat = turned(terrain.south + terrain.north, 2 * terrain.posts_per_deg);
    const Turned60 lon = turned(terrain.west + terrain.east, 2 * terrain.posts_per_deg);
    const Turned60 azimuth = turned(terrain.azimuth_deg, 1);
    // North (-sin lat cos lon, -sin lat sin lon, cos lat), east (-sin lon, cos lon, 0).
    const Fixed60 along_north = azimuth.cosine, along_east = azimuth.sine;
    const std::array<Fixed60, 3> along{
        -times(along_north, times(lat.sine, lon.cosine)) - times(along_east, lon.sine),
        -times(along_north, times(lat.sine, lon.sine)) + times(along_east, lon.cosine),
        times(along_north, lat.cosine)};
    std::uint32_t shift = 0;
    while (shift < 31 && (num << 1U) <= (std::uint64_t{1} << 62U) && (num << 1U) / den < (1U << 30U)) {
        num <<= 1U;
        ++shift;
    }
    const auto factor = static_cast<std::int64_t>(num / den);  // below 2^30
    const auto scaled = [&](Fixed60 part) {
        const std::int64_t size = ((part >> 29) * factor + (std::int64_t{1} << 30)) >> 31;
        return static_cast<std::int32_t>(size);
    };
    rule.along_x = scaled(along[0]);
    rule.along_y = scaled(along[1]);
    rule.along_z = scaled(along[2]);
    rule.along_shift = shift;
}

}  // namespace

MadeRow made_row(std::int64_t post, std::int64_t posts_per_deg) {
    const Turned60 lat = turned(post, posts_per_deg);
    const Fixed60 squeezed = one60 - times(eccentricity_squared60, times(lat.sine, lat.sine));
    // One over its root, by Newton's rule from 1: the error's square root falls fourfold and more each time.
    Fixed60 inverse = one60;
    for (int i = 0; i < 5; ++i)
        inverse = times(inverse, 3 * one60 - times(squeezed, times(inverse, inverse))) / 2;
    const Fixed60 scale = equator_units << 30;  // 2^-30 of 2^-6 m
    return {rounded(times(scale, times(inverse, lat.cosine)), 30),
            rounded(times(scale, times(inverse, times(one60 - eccentricity_squared60, lat.sine))), 30)};
}

MadeColumn made_column(std::int64_t post, std::int64_t posts_per_deg) {
    const Turned60 lon = turned(post, posts_per_deg);
    return {rounded(lon.cosine, 30), rounded(lon.sine, 30)};
}

gpu::MadeOctave made_octave(std::uint32_t seed, std::uint32_t number, std::uint32_t shift) {
    gpu::MadeOctave octave{};
    octave.shift = shift;
    const std::uint32_t own = lowbias32(seed * 0x9e3779b1U + lowbias32(number + 1));
    octave.seed = own;
    octave.off_x = lowbias32(own + 1) >> 3U;
    octave.off_y = lowbias32(own + 2) >> 3U;
    octave.off_z = lowbias32(own + 3) >> 3U;
    octave.flip_x = number % 4 == 1 ? -1 : 1;
    octave.flip_y = number % 4 == 2 ? -1 : 1;
    octave.flip_z = number % 4 == 3 ? -1 : 1;
    return octave;
}

gpu::MadeRule made_rule(const MadeTerrain& terrain) {
    gpu::MadeRule rule{};
    rule.kind = static_cast<std::uint32_t>(terrain.kind);
    rule.low = terrain.low;
    rule.high = terrain.high;
    const MadeRow row = made_row(terrain.south + terrain.north, 2 * terrain.posts_per_deg);
    const MadeColumn column = made_column(terrain.west + terrain.east, 2 * terrain.posts_per_deg);
    const auto placed = [](std::int32_t from_axis, std::int32_t part) {
        return static_cast<std::int32_t>((static_cast<std::int64_t>(from_axis) * part) >> 30);
    };
    rule.centre_x = placed(row.from_axis, column.cosine);
    rule.centre_y = placed(row.from_axis, column.sine);
    rule.centre_z = row.north;
    rule.radius = terrain.radius_m * 64;
    const auto range = static_cast<std::uint64_t>(terrain.high - terrain.low);
    switch (terrain.kind) {
        case MadeKind::fbm:
        case MadeKind::ridged:
            set_octaves(terrain, rule);
            break;
        case MadeKind::plane:
            set_direction(terrain, range, std::uint64_t{terrain.length_m} * 64, rule);
            break;
        case MadeKind::sine:
            set_direction(terrain, std::uint64_t{1} << 32U, std::uint64_t{terrain.length_m} * 64, rule);
            break;
        case MadeKind::step:
            set_direction(terrain, 1, 1, rule);
            break;
        case MadeKind::cone: {
            // Range over radius, both in 2^-11 m.
            std::uint64_t num = range;
            const std::uint64_t den = std::uint64_t{terrain.radius_m} * 2048;
            while (rule.slope_shift < 31 && (num << 1U) / den < (std::uint64_t{1} << 31U)) {
                num <<= 1U;
                ++rule.slope_shift;
            }
            rule.slope = static_cast<std::uint32_t>(num / den);
            break;
        }
        case MadeKind::sphere:
        case MadeKind::checker:
            break;
    }
    return rule;
}

}  // namespace oro
