// The noise of the ground's materials: one lattice for every eye.
#include "core/frame/ground_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

// Where an octave says that the eye is, in cells from another eye's.
glm::dvec3 cells_between(const gpu::NoiseOctave& from, const gpu::NoiseOctave& to) {
    glm::dvec3 cells;
    for (int axis = 0; axis < 3; ++axis)
        cells[axis] = static_cast<std::int32_t>(to.cell[axis] - from.cell[axis]) +
                      static_cast<double>(to.part[axis]) - static_cast<double>(from.part[axis]);
    return cells;
}

TEST(GroundNoise, IsOneLatticeForAllEyes) {
    constexpr unsigned seed = 20261127;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    for (int i = 0; i < 200; ++i) {
        const Ecef one = ecef_from_geodetic({90.0 * share(random), 180.0 * share(random), 3000.0});
        const glm::dvec3 step = 2000.0 * glm::dvec3(share(random), share(random), share(random));
        gpu::FrameConstants here{}, there{};
        set_ground_noise(one, here);
        set_ground_noise({one.m + step}, there);
        glm::dvec3 turned = step;
        for (int octave = 0; octave < static_cast<int>(gpu::noise_octaves); ++octave) {
            const gpu::NoiseOctave& from = here.noise[octave];
            const glm::dvec3 expected = turned / static_cast<double>(from.cell_m);
            const glm::dvec3 found = cells_between(from, there.noise[octave]);
            // A float has the cell's edge within 6e-8 of it; of up to 6e4 cells.
            for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(found[axis], expected[axis], 5e-3) << "cells";
            EXPECT_NEAR(std::hypot(expected.x, expected.y, expected.z) * static_cast<double>(from.cell_m),
                        std::hypot(step.x, step.y, step.z), 1e-6)
                << "turns keep lengths, metres";
            turned = glm::dvec3(2.0 * turned.x - 2.0 * turned.y + turned.z,
                                turned.x + 2.0 * turned.y + 2.0 * turned.z,
                                2.0 * turned.x + turned.y - 2.0 * turned.z) /
                     3.0;
        }
    }
}

// Noise of uniform numbers at lattice points: its variance is 0.1603 of a square of the amplitude.
TEST(GroundNoise, HasAVarianceOfOne) {
    gpu::FrameConstants constants{};
    set_ground_noise(ecef_from_geodetic({46.5, 8.0, 1000.0}), constants);
    double border = 0.0, patches = 0.0, before_m = 1e9;
    for (const gpu::NoiseOctave& octave : constants.noise) {
        border += 0.1603 * std::pow(static_cast<double>(octave.border), 2);
        patches += 0.1603 * std::pow(static_cast<double>(octave.patches), 2);
        EXPECT_LT(static_cast<double>(octave.cell_m), before_m);
        before_m = static_cast<double>(octave.cell_m);
    }
    EXPECT_NEAR(border, 1.0, 1e-3);
    EXPECT_NEAR(patches, 1.0, 1e-3);
    EXPECT_LT(before_m, 0.05) << "the smallest cell, metres";
}

}  // namespace
}  // namespace oro
