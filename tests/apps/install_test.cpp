// The installed program: it finds its data wherever the installation is moved, and knows nothing of the build
// tree.
#include <gtest/gtest.h>

#include <string>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bytes_of;

TEST(Install, FindsItsDataAndHoldsNoPathOfTheBuildTree) {
    const fs::path folder = oro::test::scratch_folder();
    const auto installed = oro::test::run_program(
        {OROGRAPH_CMAKE, "--install", OROGRAPH_BUILD_DIR, "--prefix", (folder / "first").string()});
    ASSERT_EQ(installed.exit_code, 0) << installed.err << installed.out;
    const fs::path moved = folder / "somewhere else";
    fs::rename(folder / "first", moved);
    const fs::path program = moved / "bin" / "orograph";
    const fs::path data = moved / "share" / "orograph";
    for (const char* name : {"jacksboro.tif", "README.md", "styles/haze.json"})
        EXPECT_TRUE(fs::exists(data / name)) << name;

    const std::string bytes = bytes_of(program);
    EXPECT_EQ(bytes.find(OROGRAPH_BUILD_DIR), std::string::npos) << "the build tree's path is inside";
    EXPECT_EQ(bytes.find(oro::test::bundled_data().parent_path().string() + "/"), std::string::npos)
        << "the source tree's path is inside";

    oro::test::Circumstances elsewhere;
    elsewhere.folder = folder;
    elsewhere.environment = {"OROGRAPH_DATA"};
    const auto shot = oro::test::run_program({program.string(), "shot", (data / "jacksboro.tif").string(),
                                              "--size", "64x48", "--out", "p.png", "-q"},
                                             elsewhere);
    EXPECT_EQ(shot.exit_code, 0) << shot.err;
    EXPECT_TRUE(fs::exists(folder / "p.png"));
}

}  // namespace
