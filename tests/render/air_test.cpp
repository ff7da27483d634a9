// The sky against a reference that integrates by brute force.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <random>

#include "core/terrain/ground.h"
#include "tests/support/air_reference.h"
#include "tests/support/drawn/drawn_scene.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr double pi = std::numbers::pi;

// Clear air, 150 km of visibility. Source: S. Hillaire 2020, table 1; Koschmieder: 3.912 / 150 km, of green.
gpu::AirModel clear_air() {
    gpu::AirModel air{};
    air.on = 1;
    air.molecules_per_m = {5.802e-6F, 13.558e-6F, 33.1e-6F};
    air.molecules_scale_m = 8000.0F;
    air.dust_extinction_per_m = 1.2522e-5F;
    air.dust_scattering_per_m = 1.1372e-5F;
    air.dust_scale_m = 1200.0F;
    air.dust_forward = 0.8F;
    air.ozone_per_m = {0.650e-6F, 1.881e-6F, 0.085e-6F};
    air.ground_albedo = 0.25F;
    air.exposure = 1.0F;
    return air;
}

gpu::FrameStyle lit_style(double sun_elevation_deg) {
    gpu::FrameStyle style{};
    style.tint_count = 1;
    style.tints[0].colour = gpu::vec3(0.3F);
    const double sun = sun_elevation_deg * pi / 180.0;
    style.sun_enu = gpu::vec3(0.0F, std::cos(sun), std::sin(sun));
    style.relief = 1.0F;
    style.air = clear_air();
    return style;
}

class AirTables : public test::GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        field_ = test::rough_field(46.9, 8.1, 200, 200);
        scene_.emplace(*gpu_, pages_in_memory(field_, 1.0, 2), RasterPath::compute, 16, 16);
    }
    void TearDown() override {
        scene_.reset();
        GpuTest::TearDown();
    }

    // The tables for an eye at a height, and the radius of the Earth that they are for.
    std::vector<float> tables(double eye_h_m, double sun_elevation_deg) {
        Camera camera;
        camera.width_px = camera.height_px = 16;
        camera.eye = {46.85, 8.15, eye_h_m};
        const test::DrawnFrame frame = scene_->draw(camera, 1.0, lit_style(sun_elevation_deg));
        radius_m_ = static_cast<double>(frame.plan.grids[0].constants.earth_radius_m);
        auto air = scene_->renderer().read_air();
        EXPECT_TRUE(air.ok());
        return std::move(air).value();
    }

    HeightField field_;
    std::optional<test::DrawnScene> scene_;
    double radius_m_{};
};

// Of an eye that moves the tables of an eye nearby do, and those of one far away do not. What is drawn to
// stay has its own.
TEST_F(AirTables, OfAMovingEyeAreMadeAnewNowAndThen) {
    // Entries that no table fills may be no numbers.
    const auto same_bytes = [](const std::vector<float>& one, const std::vector<float>& other) {
        return one.size() == other.size() &&
               std::memcmp(one.data(), other.data(), one.size() * sizeof(float)) == 0;
    };
    const std::vector<float> low = tables(1000.0, 30.0), little_higher = tables(1020.0, 30.0);
    EXPECT_FALSE(same_bytes(low, little_higher));
    const auto moved_to = [&](double eye_h_m) {
        Camera camera;
        camera.width_px = camera.height_px = 16;
        camera.eye = {46.85, 8.15, eye_h_m};
        auto plan = scene_->scene().settled_plan({camera, test::whole_picture(camera), 1.0});
        EXPECT_TRUE(plan.ok());
        EXPECT_TRUE(scene_->renderer().submit(std::move(*plan), lit_style(30.0)).ok());
        EXPECT_TRUE(scene_->renderer().finish().ok());
        return scene_->renderer().read_air().value();
    };
    EXPECT_TRUE(same_bytes(tables(1000.0, 30.0), low));
    EXPECT_TRUE(same_bytes(moved_to(1020.0), low));
    EXPECT_TRUE(same_bytes(moved_to(1029.0), low));
    const std::vector<float> higher = moved_to(1100.0);
    EXPECT_FALSE(same_bytes(higher, low));
    EXPECT_TRUE(same_bytes(higher, tables(1100.0, 30.0)));
    EXPECT_TRUE(same_bytes(tables(1020.0, 30.0), little_higher));
}

// A line of sight by its place in the sky's table, 0 to 1 and 0 to 1 (shaders/air/sky.glsl), for a sun.
struct SkyLine {
    double elevation_rad, turn_rad, to_sun;
};
SkyLine line_at(double share, double turned, double eye_h_m, double radius_m, double sun_rad) {
    const double dip = std::acos(radius_m / (radius_m + eye_h_m)), passes_m = share * share * 1e5;
    SkyLine line{};
    line.elevation_rad = eye_h_m > 1e5 ? -std::acos((radius_m + passes_m) / (radius_m + eye_h_m))
                                       : share * share * (0.5 * pi + dip) - dip;
    line.turn_rad = pi * turned;
    line.to_sun = std::sin(line.elevation_rad) * std::sin(sun_rad) +
                  std::cos(line.elevation_rad) * std::cos(sun_rad) * std::cos(line.turn_rad);
    return line;
}

// Between the entries of the sky's table.
glm::dvec3 radiance_of(const std::vector<float>& tables, double share, double turned, double to_sun) {
    const double row = share * (gpu::air_sky_rises - 1), column = turned * (gpu::air_sky_turns - 1);
    const unsigned i = std::min(static_cast<unsigned>(row), gpu::air_sky_rises - 2),
                   j = std::min(static_cast<unsigned>(column), gpu::air_sky_turns - 2);
    const auto entry = [&](unsigned r, unsigned c, std::size_t k) {
        const std::size_t at = 3 * (gpu::air_sky_first + 3 * (r * gpu::air_sky_turns + c) + k);
        return glm::dvec3(tables[at], tables[at + 1], tables[at + 2]);
    };
    const auto between = [&](std::size_t k) {
        return glm::exp(glm::mix(glm::mix(entry(i, j, k), entry(i, j + 1, k), column - j),
                                 glm::mix(entry(i + 1, j, k), entry(i + 1, j + 1, k), column - j), row - i));
    };
    const double g = 0.8;
    return between(0) * (3.0 / (16.0 * pi) * (1.0 + to_sun * to_sun)) +
           between(1) * (3.0 / (8.0 * pi) * (1.0 - g * g) * (1.0 + to_sun * to_sun) /
                         ((2.0 + g * g) * std::pow(1.0 + g * g - 2.0 * g * to_sun, 1.5))) +
           between(2);
}

// The zenith, the horizon and lines by chance between, from the valley, an airliner and space: within 2 % of
// the brightest channel; where all is dark, of 1e-6 of the sun's light, and from space, where pictures are
// lit for the day, of 2e-5 of it (a third of the darkest grey).
TEST_F(AirTables, SkyIsWhatBruteForceGives) {
    double worst = 0.0;
    std::optional<test::AirReference> reference;
    constexpr unsigned seed = 20261122;
    std::mt19937 random(seed);
    std::printf("seed %u\n", seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (const double eye_h_m : {600.0, 11000.0, 400000.0}) {
        for (const double sun_deg : {60.0, 20.0, 5.0, 0.0, -5.0}) {
            const std::vector<float> sky = tables(eye_h_m, sun_deg);
            if (!reference) reference.emplace(clear_air(), radius_m_);
            double of_sun = 0.0;
            for (int i = 0; i < 24; ++i) {
                const double row = i < 4 ? 0.0 : i < 8 ? 1.0 : share(random);
                const double turned = i < 8 ? (i % 4) / 3.0 : share(random), sun_rad = sun_deg * pi / 180.0;
                const SkyLine line = line_at(row, turned, eye_h_m, radius_m_, sun_rad);
                const double fade = eye_h_m > 1e5 ? std::min(1.0, (1.0 - row) / 0.002) : 1.0;
                const glm::dvec3 drawn = fade * radiance_of(sky, row, turned, line.to_sun);
                const glm::dvec3 truth =
                    reference->radiance(eye_h_m, line.elevation_rad, line.turn_rad, sun_rad);
                const glm::dvec3 apart = glm::abs(drawn - truth) /
                                         std::max({truth.x, truth.y, truth.z, eye_h_m > 1e5 ? 2e-5 : 1e-6});
                of_sun = std::max({of_sun, apart.x, apart.y, apart.z});
                EXPECT_LT(std::max({apart.x, apart.y, apart.z}), 0.02)
                    << "eye " << eye_h_m << " m, sun " << sun_deg << ", row " << row << ", turned " << turned
                    << ": " << drawn.x << " " << drawn.y << " " << drawn.z << " for " << truth.x << " "
                    << truth.y << " " << truth.z;
            }
            std::printf("eye at %.0f m, sun at %.0f deg: within %.2f %%\n", eye_h_m, sun_deg, 100.0 * of_sun);
            worst = std::max(worst, of_sun);
        }
    }
    EXPECT_GT(worst, 1e-5) << "a reference that shares nothing is never the same";
}

// What a pixel shows of light from outside: exposure, the curve of shaders/shade/daylight.glsl, sRGB, in
// codes.
double code_of(double radiance, double exposure) {
    double light = 0.22 * std::pow(std::max(radiance * exposure, 0.0) / 0.22, 1.15);
    if (light > 0.35) light = 0.35 + 0.65 * (1.0 - std::exp(-(light - 0.35) / 0.65));
    light = std::clamp(light, 0.0, 1.0);
    return 255.0 * (light > 0.0031308 ? 1.055 * std::pow(light, 1.0 / 2.4) - 0.055 : 12.92 * light);
}

// Towards which a pixel looks, of an eye that looks north: east, north, up.
glm::dvec3 direction_of(int x, int y, double pitch_deg, double fov_deg, int side_px) {
    const double half = std::tan(fov_deg * pi / 360.0), pitch = pitch_deg * pi / 180.0;
    const double right = (2.0 * (x + 0.5) / side_px - 1.0) * half,
                 up = (1.0 - 2.0 * (y + 0.5) / side_px) * half;
    return glm::normalize(glm::dvec3(0.0, std::cos(pitch), std::sin(pitch)) +
                          right * glm::dvec3(1.0, 0.0, 0.0) +
                          up * glm::dvec3(0.0, -std::sin(pitch), std::cos(pitch)));
}

// Pixels themselves, from the horizon to beyond the zenith: the codes of what the reference integrates,
// within 2 % of the brightest channel's light (1e-6 of the sun's where all is dark) and one code for dither
// and rounding. The sun's disc and a degree around it are left out.
TEST_F(AirTables, PixelsOfTheSkyAreWhatBruteForceGives) {
    constexpr int side_px = 16;
    constexpr double fov_deg = 50.0, eye_h_m = 11000.0;
    std::optional<test::AirReference> reference;
    int looked_at = 0;
    for (const double sun_deg : {60.0, 20.0, 5.0, 0.0, -5.0}) {
        double worst = 0.0;
        for (const double pitch_deg : {25.0, 70.0}) {
            Camera camera{{46.85, 8.15, eye_h_m}, {0.0, pitch_deg, 0.0}, fov_deg, side_px, side_px};
            const test::DrawnFrame frame = scene_->draw(camera, 1.0, lit_style(sun_deg));
            const auto air = scene_->renderer().read_air();
            const auto rgba = scene_->renderer().read_picture(side_px, side_px);
            ASSERT_TRUE(air.ok() && rgba.ok());
            if (!reference)
                reference.emplace(clear_air(),
                                  static_cast<double>(frame.plan.grids[0].constants.earth_radius_m));
            const double exposure = (*air)[3 * std::size_t{gpu::air_exposure_at}], sun = sun_deg * pi / 180.0;
            const glm::dvec3 to_sun(0.0, std::cos(sun), std::sin(sun));
            for (int i = 0; i < side_px * side_px; i += 17) {
                const glm::dvec3 to = direction_of(i % side_px, i / side_px, pitch_deg, fov_deg, side_px);
                if (glm::dot(to, to_sun) > std::cos(1.3 * pi / 180.0)) continue;
                const glm::dvec3 truth =
                    reference->radiance(eye_h_m, std::asin(to.z), std::abs(std::atan2(to.x, to.y)), sun);
                const double slack = 0.02 * std::max({truth.x, truth.y, truth.z, 1e-6});
                for (int c = 0; c < 3; ++c) {
                    const double drawn = (*rgba)[static_cast<std::size_t>(4 * i + c)];
                    EXPECT_GE(drawn, code_of(truth[c] - slack, exposure) - 1.0) << sun_deg << ", pixel " << i;
                    EXPECT_LE(drawn, code_of(truth[c] + slack, exposure) + 1.0) << sun_deg << ", pixel " << i;
                    worst = std::max(worst, std::abs(drawn - code_of(truth[c], exposure)));
                }
                ++looked_at;
            }
        }
        std::printf("sun at %.0f deg: within %.2f codes\n", sun_deg, worst);
    }
    EXPECT_GE(looked_at, 150);
}

// A line of sight to the ground by its place in the aerial table (shaders/air/aerial.glsl) that ends between
// its entries, too.
struct GroundLine {
    double row, column, slice;  // in entries
    double way;                 // of its way through the air, of 1
    double elevation_rad, turn_rad, to_m;
};
constexpr double floor_m = -500.0;
GroundLine ground_line(double share, double turn, double ground_h_m, bool falls, double eye_h_m,
                       double radius_m) {
    const double dip = std::acos((radius_m + floor_m) / (radius_m + eye_h_m)), squared = share * share;
    GroundLine line{};
    const double half =
        falls ? squared * std::tan(0.25 * pi - 0.5 * dip) : -squared * std::tan(0.25 * pi + 0.5 * dip);
    line.elevation_rad = -dip - 2.0 * std::atan(half);
    line.row = share * (gpu::aerial_rises - 1) + (falls ? 0.0 : gpu::aerial_rises);
    line.turn_rad = std::acos(2.0 * turn - 1.0);
    line.column = turn * (gpu::aerial_turns - 1);
    const double r = radius_m + eye_h_m, along = r * std::sin(line.elevation_rad);
    const auto square = [&](double shell_m) {
        return along * along + (radius_m + shell_m) * (radius_m + shell_m) - r * r;
    };
    const double from_m = eye_h_m > 1e5 ? -along - std::sqrt(square(1e5)) : 0.0;
    const double end_m = falls ? -along - std::sqrt(square(floor_m)) : -along + std::sqrt(square(1e5));
    // To where it comes down to the ground, or leaves the heights that have ground.
    const bool comes_down = along < 0.0 && square(ground_h_m) > 0.0 && eye_h_m > ground_h_m;
    const double way_m = -along + (comes_down ? -1.0 : 1.0) * std::sqrt(std::max(square(ground_h_m), 0.0));
    const double way = std::clamp((way_m - from_m) / (end_m - from_m), 0.0, 1.0);
    line.to_m = from_m + way * (end_m - from_m);
    line.way = way;
    line.slice =
        (way < 0.5 ? std::sqrt(0.5 * way) : 1.0 - std::sqrt(0.5 * (1.0 - way))) * (gpu::aerial_slices - 1);
    return line;
}

struct AirSeen {
    glm::dvec3 gathered, through;
};
// Between its entries.
AirSeen seen_in(const std::vector<float>& tables, const GroundLine& line, double to_sun) {
    const unsigned half = line.row < gpu::aerial_rises ? 0 : gpu::aerial_rises,
                   i = std::min(static_cast<unsigned>(line.row) - half, gpu::aerial_rises - 2) + half,
                   j = std::min(static_cast<unsigned>(line.column), gpu::aerial_turns - 2),
                   k = std::min(static_cast<unsigned>(line.slice), gpu::aerial_slices - 2);
    // Of 16 bits each: logarithms of light but for what dust scatters, and of that; what is let through.
    const auto code = [&](std::size_t number, bool is_share) {
        const auto word = std::bit_cast<std::uint32_t>(tables[number / 2]);
        const double of_one = (number % 2 == 0 ? word & 65535U : word >> 16U) / 65535.0;
        return is_share ? of_one
                        : gpu::aerial_log_low +
                              of_one * (static_cast<double>(gpu::aerial_log_high) - gpu::aerial_log_low);
    };
    const auto entry = [&](unsigned part, unsigned slice) {
        const auto one = [&](unsigned row, unsigned column) {
            const std::size_t at =
                8 * (gpu::aerial_first +
                     2 * ((row * gpu::aerial_turns + column) * gpu::aerial_slices + slice)) +
                3 * part;
            return glm::dvec3(code(at, part == 2), code(at + 1, part == 2), code(at + 2, part == 2));
        };
        return glm::mix(glm::mix(one(i, j), one(i, j + 1), line.column - j),
                        glm::mix(one(i + 1, j), one(i + 1, j + 1), line.column - j), line.row - i);
    };
    const auto way_of = [](double x) { return x < 0.5 ? 2.0 * x * x : 1.0 - 2.0 * (1.0 - x) * (1.0 - x); };
    const double last = gpu::aerial_slices - 1, low = way_of(k / last), high = way_of((k + 1) / last),
                 on = (line.way - low) / (high - low);
    const glm::dvec3 let = entry(2, k + 1) / entry(2, k), here = glm::pow(let, glm::dvec3(on));
    glm::dvec3 come = (1.0 - here) / (1.0 - let);
    for (int c = 0; c < 3; ++c)
        if (let[c] > 0.999) come[c] = on;
    const auto between = [&](unsigned part) {
        return glm::mix(glm::exp(entry(part, k)), glm::exp(entry(part, k + 1)), come);
    };
    const double g = 0.8;
    return {between(0) + between(1) * (3.0 / (8.0 * pi) * (1.0 - g * g) * (1.0 + to_sun * to_sun) /
                                       ((2.0 + g * g) * std::pow(1.0 + g * g - 2.0 * g * to_sun, 1.5))),
            entry(2, k) * here};
}

// What lies between the eye and the ground: light within 2 % of what white ground sends through it and of
// itself, together, and what it lets through within 0.025.
TEST_F(AirTables, GroundIsSeenThroughWhatBruteForceGives) {
    std::optional<test::AirReference> reference;
    constexpr unsigned seed = 20261123;
    std::mt19937 random(seed);
    std::printf("seed %u\n", seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (const double eye_h_m : {2.0, 3000.0, 11000.0, 110000.0, 400000.0}) {
        for (const double sun_deg : {60.0, 20.0, 5.0, 0.0, -5.0}) {
            const std::vector<float> air = tables(eye_h_m, sun_deg);
            if (!reference) reference.emplace(clear_air(), radius_m_);
            const double sun_rad = sun_deg * pi / 180.0;
            AirSeen worst{};
            for (int i = 0; i < 24; ++i) {
                const bool falls = i % 4 != 0 || eye_h_m > 1e5;
                const GroundLine line = ground_line(
                    share(random), share(random),
                    (falls ? std::min(eye_h_m, 5000.0) : 5000.0) * share(random), falls, eye_h_m, radius_m_);
                const double to_sun =
                    std::sin(line.elevation_rad) * std::sin(sun_rad) +
                    std::cos(line.elevation_rad) * std::cos(sun_rad) * std::cos(line.turn_rad);
                const AirSeen drawn = seen_in(air, line, to_sun);
                const auto truth =
                    reference->seen(eye_h_m, line.elevation_rad, line.turn_rad, sun_rad, line.to_m);
                const glm::dvec3 ground =
                    reference->sunlight(0.0, std::sin(sun_rad)) * (std::max(std::sin(sun_rad), 0.0) / pi);
                const glm::dvec3 light = glm::abs(drawn.gathered + ground * drawn.through - truth.gathered -
                                                  ground * truth.through) /
                                         glm::max(truth.gathered + ground * truth.through, glm::dvec3(2e-5));
                const glm::dvec3 through = glm::abs(drawn.through - truth.through);
                worst = {glm::max(worst.gathered, light), glm::max(worst.through, through)};
                EXPECT_LT(std::max({light.x, light.y, light.z}), 0.02)
                    << "eye " << eye_h_m << " m, sun " << sun_deg << ", row " << line.row << ", slice "
                    << line.slice << ", " << line.to_m << " m: " << drawn.gathered.x << " "
                    << drawn.gathered.y << " " << drawn.gathered.z << " for " << truth.gathered.x << " "
                    << truth.gathered.y << " " << truth.gathered.z;
                EXPECT_LT(std::max({through.x, through.y, through.z}), 0.025)
                    << "row " << line.row << ", slice " << line.slice << ", eye " << eye_h_m;
            }
            std::printf("eye at %.0f m, sun at %.0f deg: light within %.2f %%, through %.2f %%\n", eye_h_m,
                        sun_deg, 100.0 * std::max({worst.gathered.x, worst.gathered.y, worst.gathered.z}),
                        100.0 * std::max({worst.through.x, worst.through.y, worst.through.z}));
        }
    }
}

// The sun's light at places on the ground by its own table (shaders/air/aerial.glsl, light_at), between its
// entries: within 2 % of the brightest channel.
TEST_F(AirTables, PlacesAreLitAsBruteForceGives) {
    const std::vector<float> air = tables(3000.0, 20.0);
    const test::AirReference reference(clear_air(), radius_m_, false);
    const double bend = 0.06, first = std::asinh(-0.342 / bend), last = std::asinh(1.0 / bend);
    double worst = 0.0;
    for (const double h_m : {0.0, 470.0, 1300.0, 2900.0, 4800.0}) {
        for (const double sun_deg : {70.0, 33.0, 11.0, 4.3, 1.7, 0.8}) {
            const double rise = std::sin(sun_deg * pi / 180.0);
            const double row = std::sqrt(h_m / 1e5) * (gpu::lit_heights - 1);
            const double column = (std::asinh(rise / bend) - first) / (last - first) * (gpu::lit_suns - 1);
            const auto i = static_cast<unsigned>(row), j = static_cast<unsigned>(column);
            const auto entry = [&](unsigned at_row, unsigned at_column) {
                const std::size_t at = 4 * (gpu::lit_first + at_row * gpu::lit_suns + at_column);
                glm::dvec3 logs;
                for (int c = 0; c < 3; ++c) {
                    const auto word = std::bit_cast<std::uint32_t>(air[at + static_cast<std::size_t>(c / 2)]);
                    logs[c] = gpu::aerial_log_low +
                              (c % 2 == 0 ? word & 65535U : word >> 16U) *
                                  (static_cast<double>(gpu::aerial_log_high) - gpu::aerial_log_low) / 65535.0;
                }
                return logs;
            };
            const glm::dvec3 drawn =
                glm::exp(glm::mix(glm::mix(entry(i, j), entry(i, j + 1), column - j),
                                  glm::mix(entry(i + 1, j), entry(i + 1, j + 1), column - j), row - i));
            const glm::dvec3 truth = reference.sunlight(h_m, rise);
            const glm::dvec3 apart = glm::abs(drawn - truth) / std::max({truth.x, truth.y, truth.z});
            worst = std::max({worst, apart.x, apart.y, apart.z});
            EXPECT_LT(std::max({apart.x, apart.y, apart.z}), 0.02)
                << h_m << " m, sun " << sun_deg << ": " << drawn.x << " " << drawn.y << " " << drawn.z
                << " for " << truth.x << " " << truth.y << " " << truth.z;
        }
    }
    std::printf("within %.2f %%\n", 100.0 * worst);
    EXPECT_GT(worst, 1e-5) << "a reference that shares nothing is never the same";
}

}  // namespace
}  // namespace oro
