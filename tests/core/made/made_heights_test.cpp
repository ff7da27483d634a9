// Made terrain: the same bits everywhere, no seam, no grain, and the shapes that calculus says.
#include "core/made/made_heights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "tests/support/made_posts.h"

namespace oro {
namespace {

using test::heights_of;
using test::made_example;

// Literals of this test were printed by a program of the same rule, compiled by g++ 12 with -O0, -O3 and
// -O3 -mavx2 and by clang++ 14 with -O2: all four gave them.
TEST(MadeHeights, AMillionPostsOfEachKindHaveTheSameBits) {
    struct Known {
        MadeKind kind;
        std::uint32_t sum;
        double lowest_m, highest_m;
    };
    for (const Known& known : {Known{MadeKind::fbm, 0xfc6f2478U, 1030.843, 3756.115},
                               {MadeKind::ridged, 0x0d40bbe4U, 701.588, 3198.006},
                               {MadeKind::plane, 0x3cd79300U, -200.0, 4000.0},
                               {MadeKind::cone, 0x50a49cc5U, -200.0, 3994.739},
                               {MadeKind::sine, 0x5a38a85cU, -200.0, 4000.0},
                               {MadeKind::step, 0x4e034000U, -200.0, 4000.0},
                               {MadeKind::sphere, 0xb5c861d1U, -200.0, 3999.988},
                               {MadeKind::checker, 0xad600000U, -200.0, 4000.0}}) {
        const std::vector<std::int32_t> steps = heights_of(made_example(known.kind));
        ASSERT_EQ(steps.size(), 1000000U);
        EXPECT_EQ(test::sum_of(steps), known.sum) << "kind " << static_cast<int>(known.kind);
        const auto [lowest, highest] = std::ranges::minmax(steps);
        EXPECT_NEAR(lowest * made_step_m, known.lowest_m, 0.0005);
        EXPECT_NEAR(highest * made_step_m, known.highest_m, 0.0005);
    }
}

// All octaves together reach from the middle of the range to its ends by twice its half, whatever an octave's
// share of the one before. Found: of gains below 0.744 a share was cut to 32 bits.
TEST(MadeHeights, OctavesHaveTheirSharesOfTheRange) {
    for (const std::uint32_t gain : {300U, 500U, 536U, 743U, 745U, 900U}) {
        MadeTerrain made = made_example(MadeKind::fbm);
        made.gain = gain;
        made.octaves = 16;
        const gpu::MadeRule rule = made_rule(made);
        double sum = 0.0;
        for (std::uint32_t i = 0; i < rule.octaves; ++i) sum += rule.octave[i].amplitude / 131072.0;
        const double half_m = 0.5 * made_step_m * (made.high - made.low), share = gain / 1000.0;
        EXPECT_NEAR(sum, 2.0 * half_m * (1.0 - std::pow(share, 16.0)), 0.01 * half_m) << "gain " << gain;
        EXPECT_NEAR(rule.octave[0].amplitude / 131072.0, 2.0 * half_m * (1.0 - share), 0.001 * half_m);
    }
}

// Rows and columns multiply to the places that double precision gives. Tolerance 2^-6 m.
TEST(MadeHeights, PlacesAreThoseOfTheEllipsoid) {
    std::mt19937 random(20261128);
    std::uniform_int_distribution<std::int64_t> lat(-90 * 3600, 90 * 3600), lon(-180 * 3600, 360 * 3600);
    for (int i = 0; i < 20000; ++i) {
        const std::int64_t row = i == 0 ? 90 * 3600 : i == 1 ? -90 * 3600 : lat(random), column = lon(random);
        const MadeRow placed = made_row(row, 3600);
        const MadeColumn turned = made_column(column, 3600);
        const glm::dvec3 truth =
            ecef_from_geodetic({static_cast<double>(row) / 3600.0, static_cast<double>(column) / 3600.0, 0.0})
                .m;
        const double from_axis_m = placed.from_axis / 64.0, whole = 1073741824.0;
        EXPECT_NEAR(from_axis_m * turned.cosine / whole, truth.x, 1.0 / 64.0) << row << " " << column;
        EXPECT_NEAR(from_axis_m * turned.sine / whole, truth.y, 1.0 / 64.0) << row << " " << column;
        EXPECT_NEAR(placed.north / 64.0, truth.z, 1.0 / 64.0) << row << " " << column;
    }
    EXPECT_EQ(made_row(90 * 3600, 3600).from_axis, 0);
    EXPECT_EQ(made_row(-90 * 3600, 3600).from_axis, 0);
    EXPECT_EQ(made_column(180 * 3600, 3600).sine, 0);
}

// The same post has one height, from whichever side of 180 degrees it is asked, and all of a pole's are one.
TEST(MadeHeights, HaveNoSeamAt180DegreesAndNoneAtThePoles) {
    for (int kind = 0; kind < 8; ++kind) {
        MadeTerrain west = made_example(static_cast<MadeKind>(kind));
        west.posts_per_deg = 120;
        west.west = 179 * 120;
        west.east = 181 * 120;
        west.south = 88 * 120;
        west.north = 90 * 120;
        const gpu::MadeRule rule = made_rule(west);  // one rule: what is asked is the place alone
        MadeTerrain east = west;
        east.west -= 360 * 120;
        east.east -= 360 * 120;
        const std::vector<std::int32_t> one = heights_of(west, rule), other = heights_of(east, rule);
        EXPECT_EQ(one, other) << "kind " << kind;
        const auto columns = static_cast<std::size_t>(west.columns());
        for (std::size_t i = 1; i < columns; ++i) EXPECT_EQ(one[i], one[0]) << "kind " << kind;
        if (kind == static_cast<int>(MadeKind::step) || kind == static_cast<int>(MadeKind::checker)) continue;
        // Across the meridian no step is larger than the largest beside it. Not in the last rows, where posts
        // lie so close that all steps are of rounding.
        const std::size_t seam = columns / 2;
        for (std::size_t row = 20; row < one.size() / columns; ++row) {
            int beside = 4;
            const auto step = [&](std::size_t i) {
                return std::abs(one[row * columns + i] - one[row * columns + i - 1]);
            };
            for (std::size_t i = 1; i < columns; ++i)
                if (i != seam && i != seam + 1) beside = std::max(beside, step(i));
            EXPECT_LE(std::max(step(seam), step(seam + 1)), 2 * beside) << "kind " << kind << " row " << row;
        }
    }
}

// A full circle has its first meridian once, and the post after the last is the first.
TEST(MadeHeights, AFullCircleClosesItself) {
    MadeTerrain world = made_example(MadeKind::fbm);
    world.posts_per_deg = 2;
    world.west = -360;
    world.east = 360;
    world.south = -180;
    world.north = 180;
    EXPECT_EQ(world.columns(), 720);
    EXPECT_EQ(world.rows(), 361);
    const gpu::MadeRule rule = made_rule(world);
    const MadeColumn first = made_column(world.west, 2), after = made_column(world.west + 720, 2);
    EXPECT_EQ(first.cosine, after.cosine);
    EXPECT_EQ(first.sine, after.sine);
    EXPECT_EQ(made_height_m(world, rule, 10.25, -180.0), made_height_m(world, rule, 10.25, 180.0));
}

// Between posts the same function: at posts it gives what posts have, to the rounding of places to 2^-6 m.
TEST(MadeHeights, BetweenPostsTheTruthIsTheSameFunction) {
    for (const MadeKind kind : {MadeKind::fbm, MadeKind::ridged, MadeKind::plane, MadeKind::cone,
                                MadeKind::sine, MadeKind::sphere}) {
        const MadeTerrain made = made_example(kind);
        const gpu::MadeRule rule = made_rule(made);
        const std::vector<std::int32_t> steps = heights_of(made, rule);
        double worst_m = 0.0;
        for (int row = 0; row < 1000; row += 37)
            for (int column = 0; column < 1000; column += 41)
                worst_m = std::max(
                    worst_m,
                    std::abs(steps[static_cast<std::size_t>(row * 1000 + column)] * made_step_m -
                             made_height_m(made, rule, static_cast<double>(made.north - row) / 3600.0,
                                           static_cast<double>(made.west + column) / 3600.0)));
        // Slopes of these are below 1.5, but on the sphere's rim.
        EXPECT_LE(worst_m, kind == MadeKind::sphere ? 0.1 : 0.03) << "kind " << static_cast<int>(kind);
    }
}

// Cone, sphere, plane and sine against double precision and geometry. Tolerance: the rounding of places,
// 2^-6 m in each axis, times the slope, and a step.
TEST(MadeHeights, ShapesAreThoseOfGeometry) {
    MadeTerrain made = made_example(MadeKind::cone);
    const double lat_deg = static_cast<double>(made.south + made.north) / 7200.0,
                 lon_deg = static_cast<double>(made.west + made.east) / 7200.0;
    const glm::dvec3 centre = ecef_from_geodetic({lat_deg, lon_deg, 0.0}).m;
    const double a = lat_deg * std::numbers::pi / 180.0, b = lon_deg * std::numbers::pi / 180.0;
    const glm::dvec3 east{-std::sin(b), std::cos(b), 0.0},
        north{-std::sin(a) * std::cos(b), -std::sin(a) * std::sin(b), std::cos(a)};
    const double azimuth = 30.0 * std::numbers::pi / 180.0;
    std::mt19937 random(20261129);
    std::uniform_real_distribution<double> off(-0.12, 0.12);
    std::array<double, 4> worst_m{};
    for (int i = 0; i < 5000; ++i) {
        const double lat = lat_deg + off(random), lon = lon_deg + off(random);
        const glm::dvec3 away = ecef_from_geodetic({lat, lon, 0.0}).m - centre;
        const double away_m = glm::length(away);
        const double along_m = glm::dot(away, east * std::sin(azimuth) + north * std::cos(azimuth));
        const double cone_m = std::max(-200.0, 4000.0 - 4200.0 * away_m / 15000.0);
        const double under_root = 15000.0 * 15000.0 - away_m * away_m;
        const double sphere_m =
            under_root > 0.0 ? std::max(-200.0, 4000.0 - (15000.0 - std::sqrt(under_root))) : -200.0;
        const double plane_m = std::clamp(1900.0 + 4200.0 * along_m / 27000.0, -200.0, 4000.0);
        const double sine_m = 1900.0 + 2100.0 * std::sin(2.0 * std::numbers::pi * along_m / 27000.0);
        const auto off_m = [&](MadeKind kind, double truth_m) {
            made.kind = kind;
            return std::abs(made_height_m(made, made_rule(made), lat, lon) - truth_m);
        };
        worst_m[0] = std::max(worst_m[0], off_m(MadeKind::cone, cone_m));
        worst_m[1] = std::max(worst_m[1], off_m(MadeKind::sphere, sphere_m));
        worst_m[2] = std::max(worst_m[2], off_m(MadeKind::plane, plane_m));
        worst_m[3] = std::max(worst_m[3], off_m(MadeKind::sine, sine_m));
    }
    std::printf("cone %.4f, sphere %.4f, plane %.4f, sine %.4f m off at most\n", worst_m[0], worst_m[1],
                worst_m[2], worst_m[3]);
    EXPECT_LE(worst_m[0], 0.02);
    EXPECT_LE(worst_m[1], 0.05);
    EXPECT_LE(worst_m[2], 0.01);
    EXPECT_LE(worst_m[3], 0.02);
}

// More octaves add to what fewer have made, and change it by no more than their amplitudes.
TEST(MadeHeights, OctavesAreNested) {
    MadeTerrain made = made_example(MadeKind::fbm);
    made.octaves = 3;
    const gpu::MadeRule few = made_rule(made);
    made.octaves = 12;
    const gpu::MadeRule many = made_rule(made);
    for (std::uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(few.octave[i].amplitude, many.octave[i].amplitude);
        EXPECT_EQ(few.octave[i].seed, many.octave[i].seed);
    }
    double rest_m = 0.01;
    for (std::uint32_t i = 3; i < 12; ++i) rest_m += 1.04 * many.octave[i].amplitude / 131072.0;
    std::mt19937 random(20261130);
    std::uniform_real_distribution<double> lat(-90.0, 90.0), lon(-180.0, 180.0);
    for (int i = 0; i < 20000; ++i) {
        const double at = lat(random), of = lon(random);
        EXPECT_LE(std::abs(made_height_m(made, few, at, of) - made_height_m(made, many, at, of)), rest_m);
    }
}

using Complex = std::complex<double>;

// A discrete Fourier transform in place, of a power of two. Source: J. Cooley & J. Tukey, 1965.
void transform(std::vector<Complex>& data, std::size_t first, std::size_t stride, std::size_t count) {
    std::vector<Complex> line(count);
    for (std::size_t i = 0; i < count; ++i) {
        std::size_t mirrored = 0;
        for (std::size_t bit = 1, to = count >> 1U; bit < count; bit <<= 1U, to >>= 1U)
            if ((i & bit) != 0) mirrored |= to;
        line[mirrored] = data[first + i * stride];
    }
    for (std::size_t width = 2; width <= count; width <<= 1U) {
        for (std::size_t i = 0; i < width / 2; ++i) {
            const Complex turn = std::polar(
                1.0, -2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(width));
            for (std::size_t at = i; at < count; at += width) {
                const Complex odd = turn * line[at + width / 2];
                line[at + width / 2] = line[at] - odd;
                line[at] += odd;
            }
        }
    }
    for (std::size_t i = 0; i < count; ++i) data[first + i * stride] = line[i];
}

constexpr std::size_t square_side = 256, sectors = 12, bands = 4;
struct Spectrum {
    std::array<double, sectors> by_sector{};  // over the mean of all
    std::array<double, bands> by_band{};      // bands of 4, 8, 16, 32 to twice as many waves a side
};

// A square of heights 30 m apart around a place, without its mean and slope, and faded to its edges.
std::vector<Complex> faded_square(MadeKind kind, double lat_deg, double lon_deg, std::uint32_t seed) {
    MadeTerrain made = made_example(kind);
    made.seed = seed;
    made.octaves = 12;
    made.low = -8000 * 2048;
    made.high = 8000 * 2048;
    const gpu::MadeRule rule = made_rule(made);
    const double a = lat_deg * std::numbers::pi / 180.0;
    const double north_deg = 30.0 / (meridian_radius_m(lat_deg) * std::numbers::pi / 180.0);
    const double east_deg =
        30.0 / (prime_vertical_radius_m(lat_deg) * std::cos(a) * std::numbers::pi / 180.0);
    std::vector<Complex> square(square_side * square_side);
    const double middle = 0.5 * (square_side - 1);
    const auto window = [](std::size_t i) {
        return 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / square_side);
    };
    double mean = 0.0, rise_x = 0.0, rise_y = 0.0, squares = 0.0;
    for (std::size_t row = 0; row < square_side; ++row) {
        for (std::size_t column = 0; column < square_side; ++column) {
            const double y = static_cast<double>(row) - middle, x = static_cast<double>(column) - middle;
            const double H_m = made_height_m(made, rule, lat_deg - y * north_deg, lon_deg + x * east_deg);
            square[row * square_side + column] = H_m;
            mean += H_m;
            rise_x += H_m * x;
            rise_y += H_m * y;
            squares += x * x;
        }
    }
    mean /= square_side * square_side;
    for (std::size_t row = 0; row < square_side; ++row)
        for (std::size_t column = 0; column < square_side; ++column)
            square[row * square_side + column] = (square[row * square_side + column] - mean -
                                                  (rise_x * (static_cast<double>(column) - middle) +
                                                   rise_y * (static_cast<double>(row) - middle)) /
                                                      squares) *
                                                 window(row) * window(column);
    return square;
}

// Adds the power of such a square by direction and by wavelength.
void add_spectrum(std::vector<Complex> square, Spectrum& sum) {
    for (std::size_t i = 0; i < square_side; ++i) transform(square, i * square_side, 1, square_side);
    for (std::size_t i = 0; i < square_side; ++i) transform(square, i, square_side, square_side);
    std::array<std::array<double, sectors>, bands> power{};
    std::array<std::array<double, sectors>, bands> count{};
    for (std::size_t row = 0; row < square_side; ++row) {
        for (std::size_t column = 0; column < square_side; ++column) {
            const double y =
                row < square_side / 2 ? static_cast<double>(row) : static_cast<double>(row) - square_side;
            const double x = column < square_side / 2 ? static_cast<double>(column)
                                                      : static_cast<double>(column) - square_side;
            const double waves = std::hypot(x, y);
            if (waves < 4.0 || waves >= 64.0) continue;
            const auto band = static_cast<std::size_t>(std::log2(waves / 4.0));
            double turn = std::atan2(y, x) / std::numbers::pi;
            if (turn < 0.0) turn += 1.0;
            const std::size_t sector =
                std::min(sectors - 1, static_cast<std::size_t>(turn * static_cast<double>(sectors)));
            power[band][sector] += std::norm(square[row * square_side + column]) * std::pow(waves, 3.8);
            count[band][sector] += 1.0;
            sum.by_band[band] += std::norm(square[row * square_side + column]);
        }
    }
    for (std::size_t band = 0; band < bands; ++band) {
        double all = 0.0;
        for (std::size_t i = 0; i < sectors; ++i) all += power[band][i] / count[band][i] / sectors;
        for (std::size_t i = 0; i < sectors; ++i)
            sum.by_sector[i] += power[band][i] / count[band][i] / all / bands;
    }
}

// Power by direction, in twelve sectors of 15 degrees, is within 0.8 and 1.25 of its mean: no grain along
// rows, columns or the lattices. And its slope by wavelength is that of the gain, 2 log2(0.536) - 2 = -3.80.
TEST(MadeHeights, NoiseHasNoGrainAndTheSpectrumOfItsGain) {
    for (const MadeKind kind : {MadeKind::fbm, MadeKind::ridged}) {
        for (const auto& [lat_deg, lon_deg] :
             {std::pair{46.5, 8.5}, {0.5, 0.5}, {0.3, 90.1}, {-33.0, 151.0}, {67.0, 180.0}}) {
            // Of fewer worlds the figures scatter: of 12 by as much as 0.13.
            constexpr int worlds = 80;
            Spectrum sum;
            for (std::uint32_t seed = 1; seed <= worlds; ++seed)
                add_spectrum(faded_square(kind, lat_deg, lon_deg, seed), sum);
            const auto [least, most] = std::ranges::minmax(sum.by_sector);
            const double slope = std::log2(sum.by_band[3] / sum.by_band[0]) / 3.0 - 2.0;
            std::printf("%s at %g %g: %.3f to %.3f of the mean by direction, slope %.2f\n",
                        kind == MadeKind::fbm ? "fbm" : "ridged", lat_deg, lon_deg, least / worlds,
                        most / worlds, slope);
            EXPECT_GE(least / worlds, 0.8);
            EXPECT_LE(most / worlds, 1.25);
            EXPECT_NEAR(slope, -3.80, 0.25);
        }
    }
}

}  // namespace
}  // namespace oro
