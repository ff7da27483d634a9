#include "tests/core/realised/calibration.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

#include "core/realised/realised_heights.h"
#include "core/truth/true_surface.h"
#include "tests/support/made_posts.h"
#include "tests/support/made_terrain.h"

namespace oro::test {
namespace {

constexpr int side = 161;
constexpr double row_m = 92.6, column_m = 64.3;  // 3 seconds at 46 degrees north
constexpr double radius_m = 4.0e3;

// White noise through a bell exp(-d^2 / (2 width^2)), of deviation 1.
std::vector<double> smoothed_noise(std::mt19937& random, double width_m) {
    std::normal_distribution<double> normal;
    const int reach = static_cast<int>(std::ceil(4.0 * width_m / column_m));
    const int wide = side + 2 * reach;
    std::vector<double> white(static_cast<std::size_t>(wide * wide)), rows(white.size());
    for (double& value : white) value = normal(random);
    const auto weights = [&](double spacing_m) {
        std::vector<double> bell;
        double squares = 0.0;
        for (int i = -reach; i <= reach; ++i) {
            bell.push_back(std::exp(-0.5 * std::pow(i * spacing_m / width_m, 2)));
            squares += bell.back() * bell.back();
        }
        for (double& weight : bell) weight /= std::sqrt(squares);
        return bell;
    };
    const std::vector<double> down = weights(row_m), across = weights(column_m);
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < wide; ++column)
            for (int i = 0; i <= 2 * reach; ++i)
                rows[static_cast<std::size_t>(row * wide + column)] +=
                    down[static_cast<std::size_t>(i)] *
                    white[static_cast<std::size_t>((row + i) * wide + column)];
    std::vector<double> noise(static_cast<std::size_t>(side * side));
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column)
            for (int i = 0; i <= 2 * reach; ++i)
                noise[static_cast<std::size_t>(row * side + column)] +=
                    across[static_cast<std::size_t>(i)] *
                    rows[static_cast<std::size_t>(row * wide + column + i)];
    return noise;
}

// Of each post of the data: 1 where it is seen, 0 where it is hidden, 2 where there is no answer. The field
// has so many posts in place of one.
std::vector<char> seen_in(const HeightField& field, const ErrorWorld& world, int finer) {
    const TrueSurface surface(field, 1.0, 1);
    const Geodetic eye{world.lat_deg, world.lon_deg,
                       surface.h_m(world.lat_deg, world.lon_deg).value() + world.above_m};
    const Viewshed shed = viewshed(surface, 0, {eye, standard_air, 0.0, radius_m, 1, {}, nullptr});
    std::vector<char> seen(static_cast<std::size_t>(side * side), 2);
    for (int row = shed.window.first_row; row < shed.window.first_row + shed.window.rows; ++row)
        for (int column = shed.window.first_column; column < shed.window.first_column + shed.window.columns;
             ++column) {
            const float missed_m = shed.clearance_deficit_m[shed.window.number(row, column)];
            if (missed_m != Viewshed::unknown && row % finer == 0 && column % finer == 0)
                seen[static_cast<std::size_t>(row / finer * side + column / finer)] = missed_m == 0.0F;
        }
    return seen;
}

void print_one(const char* name, const Reliability& reliability) {
    for (std::size_t i = 0; i < reliability.tenths.size(); ++i) {
        const Tenth& tenth = reliability.tenths[i];
        if (tenth.posts > 0.0)
            std::printf("reliability %s %zu: %.0f posts, predicted %.4f, seen %.4f\n", name, i, tenth.posts,
                        tenth.predicted / tenth.posts, tenth.seen / tenth.posts);
    }
    std::printf(
        "score %s: Brier %.5f, predicted %.4f, seen %.4f, worst tenth %.2f points, mean %.2f points\n", name,
        reliability.brier(), reliability.predicted / reliability.posts, reliability.seen / reliability.posts,
        reliability.worst_points(0.0), reliability.mean_points());
}

}  // namespace

ErrorWorld error_world(std::uint32_t seed, double deviation_m, double correlation_m, int finer) {
    std::mt19937 random(seed);
    MadeTerrain made;
    made.kind = MadeKind::fbm;
    made.seed = seed;
    made.octaves = 12;
    // Hills rather than mountains: there errors matter most.
    made.low = 959 * 2048;
    made.high = 2841 * 2048;
    made.posts_per_deg = 1200 * finer;
    made.west = (8 * 1200 + std::uniform_int_distribution<int>(0, 1200)(random)) * finer;
    made.south = 46 * 1200 * finer;
    made.east = made.west + (side - 1) * finer;
    made.north = made.south + (side - 1) * finer;
    ErrorWorld world;
    world.finer = finer;
    const auto per_deg = static_cast<double>(made.posts_per_deg);
    const double north_deg = static_cast<double>(made.north) / per_deg,
                 west_deg = static_cast<double>(made.west) / per_deg;
    const std::vector<std::int32_t> steps = heights_of(made);
    std::size_t post = 0;
    world.truth = made_field(north_deg, west_deg, per_deg, made.rows(), made.columns(),
                             [&](double, double) { return static_cast<float>(steps[post++] * made_step_m); });
    int row = 0, column = 0;
    world.data = made_field(north_deg, west_deg, 1200.0, side, side, [&](double, double) {
        const float H_m = world.truth.H_at_post_m(row * finer, column * finer);
        row += ++column == side;
        column %= side;
        return H_m;
    });
    // Bells of noise are correlated by exp(-d^2 / (4 width^2)).
    const std::vector<double> broad = smoothed_noise(random, 0.55 * correlation_m),
                              narrow = smoothed_noise(random, 0.25 * correlation_m);
    for (std::size_t i = 0; i < broad.size(); ++i)
        world.data.H_m[i] +=
            static_cast<float>(deviation_m * (std::sqrt(0.85) * broad[i] + std::sqrt(0.15) * narrow[i]));
    std::uniform_real_distribution<double> off(-10.0, 10.0);
    world.lat_deg = north_deg - (side / 2 + off(random)) / 1200.0;
    world.lon_deg = west_deg + (side / 2 + off(random)) / 1200.0;
    constexpr std::array heights_m{2.0, 10.0, 40.0};
    world.above_m = heights_m[seed % heights_m.size()];
    return world;
}

void Reliability::add(double predicted_probability, bool is_seen) {
    Tenth& tenth = tenths[static_cast<std::size_t>(std::min(9.0, predicted_probability * 10.0 + 1e-9))];
    const double is = is_seen ? 1.0 : 0.0;
    tenth.posts += 1.0;
    tenth.predicted += predicted_probability;
    tenth.seen += is;
    posts += 1.0;
    predicted += predicted_probability;
    seen += is;
    squares += (predicted_probability - is) * (predicted_probability - is);
}

void Reliability::add(const Reliability& more) {
    for (std::size_t i = 0; i < tenths.size(); ++i) {
        tenths[i].posts += more.tenths[i].posts;
        tenths[i].predicted += more.tenths[i].predicted;
        tenths[i].seen += more.tenths[i].seen;
    }
    posts += more.posts;
    squares += more.squares;
    predicted += more.predicted;
    seen += more.seen;
}

double Reliability::worst_points(double least_share) const {
    double worst = 0.0;
    for (const Tenth& tenth : tenths)
        if (tenth.posts > 0.0 && tenth.posts >= least_share * posts)
            worst = std::max(worst, 100.0 * std::abs(tenth.predicted - tenth.seen) / tenth.posts);
    return worst;
}

double Reliability::mean_points() const {
    double sum = 0.0;
    for (const Tenth& tenth : tenths) sum += 100.0 * std::abs(tenth.predicted - tenth.seen);
    return sum / posts;
}

void add_world(const ErrorWorld& world, std::uint32_t seed, double deviation_m, double correlation_m,
               int realisations, Calibration& calibration, int finer) {
    const auto realised =
        RealisedHeights::create(world.data, {0, side, 0, side}, {deviation_m, correlation_m}, finer);
    const std::vector<char> truth = seen_in(world.truth, world, world.finer),
                            data = seen_in(world.data, world, 1);
    const auto tell = [&](Reliability& reliability,
                          const std::function<HeightField(std::uint32_t)>& field_of) {
        std::vector<int> seen(truth.size());
        for (int i = 0; i < realisations; ++i) {
            const std::vector<char> found =
                seen_in(field_of(seed * 100003U + static_cast<std::uint32_t>(i)), world, finer);
            for (std::size_t k = 0; k < seen.size(); ++k) seen[k] += found[k] == 1;
        }
        for (std::size_t k = 0; k < seen.size(); ++k)
            if (truth[k] != 2) reliability.add(static_cast<double>(seen[k]) / realisations, truth[k] == 1);
    };
    tell(calibration.posterior, [&](std::uint32_t n) { return realised.value().realisation(n); });
    if (finer == 1)
        tell(calibration.data_and_noise, [&](std::uint32_t n) { return realised.value().data_and_noise(n); });
    for (std::size_t k = 0; k < truth.size(); ++k)
        if (truth[k] != 2) calibration.yes_no.add(data[k] == 1 ? 1.0 : 0.0, truth[k] == 1);
}

void Calibration::add(const Calibration& more) {
    posterior.add(more.posterior);
    data_and_noise.add(more.data_and_noise);
    yes_no.add(more.yes_no);
}

void Calibration::print() const {
    print_one("posterior", posterior);
    if (data_and_noise.posts > 0.0) print_one("data-and-noise", data_and_noise);
    print_one("yes-or-no", yes_no);
}

}  // namespace oro::test
