// Hills on all scales by a formula: for tests of what depends on slopes, ridges and pits.
#pragma once

#include <cmath>

#include "tests/support/made_terrain.h"

namespace oro::test {

// Waves of all directions around a height: each half as high and 2.03 times as short as the one before.
// per_deg: radians of the first one in a degree.
struct Waves {
    double middle_m;
    double height_m;
    double per_deg;
    int octaves;
    [[nodiscard]] double H_m(double lat_deg, double lon_deg) const {
        double H = middle_m, height = height_m, scale = per_deg;
        for (int octave = 0; octave < octaves; ++octave) {
            H += height * std::sin(scale * lat_deg + 1.3 * octave) *
                 std::cos(0.8 * scale * lon_deg - 0.7 * octave);
            height *= 0.5;
            scale *= 2.03;
        }
        return H;
    }
};

// H between some -300 and 3,300 m, features from 20 km down to the post spacing. Deterministic.
inline float rough_H_m(double lat_deg, double lon_deg) {
    return static_cast<float>(Waves{1500.0, 900.0, 40.0, 7}.H_m(lat_deg, lon_deg));
}

// `rows` x `columns` posts of 3 seconds from (north, west).
inline HeightField rough_field(double north_deg, double west_deg, int rows, int columns) {
    return made_field(north_deg, west_deg, 1200.0, rows, columns, rough_H_m);
}

}  // namespace oro::test
