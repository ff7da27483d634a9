// A window that draws meshes by clusters: what it shows where the eye rests is what shot draws there.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::Words;

// A comb of 60 teeth over the ground, 1,440 triangles or so: far away most of them are one.
std::string obj_of_comb() {
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

TEST(WindowMesh, ShowsTheClustersThatShotDraws) {
    if (oro::test::run_program({"Xvfb", "-help"}).exit_code == 127 ||
        oro::test::run_program({"xdotool", "version"}).exit_code == 127)
        GTEST_SKIP() << "needs Xvfb and xdotool";
    oro::test::Circumstances there;
    there.folder = oro::test::scratch_folder();
    there.environment = {"SCREEN_SIZE=400x300", "WAYLAND_DISPLAY", "OROGRAPH_VALIDATION=1"};
    const std::string mesh = (there.folder / "comb.obj").string(),
                      region = (there.folder / "comb.oro").string();
    oro::test::write_bytes(mesh, obj_of_comb());
    const Outcome baked = run_orograph(
        {"bake", bundled(), "--mesh-file", mesh, "--mesh-crs", "EPSG:4326", "--out", region, "-q"});
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
