// A window that draws meshes by clusters: what it shows where the eye rests is what shot draws there.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/comb_mesh.h"
#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::Outcome;
using oro::test::run_orograph;

TEST(WindowMesh, ShowsTheClustersThatShotDraws) {
    if (oro::test::run_program({"Xvfb", "-help"}).exit_code == 127 ||
        oro::test::run_program({"xdotool", "version"}).exit_code == 127)
        GTEST_SKIP() << "needs Xvfb and xdotool";
    oro::test::Circumstances there;
    there.folder = oro::test::scratch_folder();
    there.environment = {"SCREEN_SIZE=400x300", "WAYLAND_DISPLAY", "OROGRAPH_VALIDATION=1"};
    const std::string mesh = (there.folder / "comb.obj").string(),
                      region = (there.folder / "comb.oro").string();
    const Outcome baked = oro::test::bake_comb(mesh, region);
    ASSERT_EQ(baked.exit_code, 0) << baked.err;
    const fs::path script = fs::path(OROGRAPH_ON_DISPLAY).parent_path() / "window_mesh.sh";
    const Outcome seen = oro::test::run_program(
        {OROGRAPH_ON_DISPLAY, script.string(), OROGRAPH_PROGRAM, region, "--mesh", "clusters", "--at",
         "36.6046,-84.19", "--altitude", "640", "--heading", "90", "--pitch", "0"},
        there);
    ASSERT_EQ(seen.exit_code, 0) << seen.out << seen.err;
    int pictures = 0;
    for (const std::string& name : oro::test::names_in(there.folder)) {
        if (!name.starts_with("orograph-") || !name.ends_with(".png")) continue;
        ++pictures;
        const fs::path picture = there.folder / name;
        EXPECT_EQ(json::parse(oro::test::view_in(picture))["mesh"], "clusters");
        const Outcome compared = run_orograph({"compare", picture.string(), "--json", "-q"});
        ASSERT_EQ(compared.exit_code, 0) << compared.err;
        EXPECT_EQ(json::parse(compared.out)["pixels"]["differ"], 0) << name;
    }
    EXPECT_EQ(pictures, 2);
}

}  // namespace
