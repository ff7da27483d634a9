// A small mesh over the bundled region, of which a far eye needs a part.
#pragma once

#include <cstdio>
#include <string>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace oro::test {

// A comb of 60 teeth over the ground, 1,440 triangles or so: far away most of them are one.
inline std::string obj_of_comb() {
    std::string text;
    char line[100];
    for (int i = 0; i <= 120; ++i)
        for (int k = 0; k <= 6; ++k) {
            std::snprintf(line, sizeof line, "v %.9f %.9f %.3f\n", -84.176 + 0.00001 * k,
                          36.604 + 0.00001 * i, 600.0 + 8.0 * k + (i % 2 == 0 ? 0.4 : 0.0));
            text += line;
        }
    for (int i = 0; i < 120; ++i)
        for (int k = 0; k < 6; ++k) {
            const int a = 1 + 7 * i + k;
            text += "f " + std::to_string(a) + " " + std::to_string(a + 7) + " " + std::to_string(a + 1) +
                    "\nf " + std::to_string(a + 1) + " " + std::to_string(a + 7) + " " +
                    std::to_string(a + 8) + "\n";
        }
    return text;
}

// Writes it, and the region with it.
inline Outcome bake_comb(const std::string& mesh, const std::string& region) {
    write_bytes(mesh, obj_of_comb());
    return run_orograph(
        {"bake", bundled(), "--mesh-file", mesh, "--mesh-crs", "EPSG:4326", "--out", region, "-q"});
}

}  // namespace oro::test
