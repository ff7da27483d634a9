// What the tests of baking share.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace oro::test {
namespace fs = std::filesystem;

// Bytes of an SRTM3 tile of hills.
inline std::string hills() {
    std::string tile;
    for (int row = 0; row < 1201; ++row) {
        for (int column = 0; column < 1201; ++column) {
            const int height = 500 + (row * 7 + column * 3) % 200;
            tile += {static_cast<char>(height >> 8), static_cast<char>(height & 255)};
        }
    }
    return tile;
}

// Each test has a folder of its own.
class Bake : public testing::Test {
  protected:
    const fs::path folder = scratch_folder();

    // Bakes the bundled region into region.oro.
    fs::path baked(const Words& more = {}) const {
        const fs::path file = folder / "region.oro";
        const Outcome outcome = run_orograph(joined({"bake", bundled(), "--out", file, "-q"}, more));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "") << "in spite of -q";
        return file;
    }
    fs::path file(const std::string& name, const std::string& bytes) const {
        write_bytes(folder / name, bytes);
        return folder / name;
    }
};

}  // namespace oro::test
