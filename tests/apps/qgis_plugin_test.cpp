// What of the plugin of QGIS needs no QGIS: how it runs the program, what it gives it, and its styles.
// scripts/check-qgis runs the plugin in QGIS.
#include <gtest/gtest.h>

#include <string>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {

TEST(QgisPlugin, RunsAProgramWithProgressErrorsAndCancel) {
    const auto source = oro::test::bundled_data().parent_path();
    if (oro::test::run_program({"python3", "--version"}).exit_code != 0) GTEST_SKIP() << "needs python3";
    const auto said = oro::test::run_program({"python3", (source / "tests/apps/qgis_program.py").string(),
                                              (source / "apps/qgis/orograph").string(),
                                              oro::test::scratch_folder().string()});
    ASSERT_EQ(said.exit_code, 0) << said.err;
    // Of a system without pseudo-terminals, as a bare chroot is, the program has none: its bar comes by a
    // pipe.
    const bool has_terminals =
        oro::test::run_program({"python3", "-c", "import os; os.openpty()"}).exit_code == 0;
    const std::string note = has_terminals ? "'orograph: note: a terminal'" : "";
    EXPECT_EQ(said.out,
              "all files are Python\n"
              "('{\"words\": \"a b ü\"}', [" +
                  note +
                  "], [(42, 'reading a b c'), (100, 'done')])\n"
                  "('ProgramFailed: orograph: no such file', ['orograph: no such file'], [])\n"
                  "ProgramFailed: /silent: ended with 4\n"
                  "ProgramFailed: /nothing: cannot be started: No such file or directory\n"
                  "obedient Cancelled:  True True\n"
                  "stubborn Cancelled:  True False\n"
                  "20000 20000 line 20000\n");
}

TEST(QgisPlugin, HasAllFormatsTablesOfObserversAndStylesOfItsLayers) {
    const auto source = oro::test::bundled_data().parent_path();
    if (oro::test::run_program({"python3", "--version"}).exit_code != 0) GTEST_SKIP() << "needs python3";
    const auto said = oro::test::run_program({"python3", (source / "tests/apps/qgis_words.py").string(),
                                              (source / "apps/qgis/orograph").string(), OROGRAPH_PROGRAM,
                                              oro::test::bundled(), oro::test::scratch_folder().string()});
    ASSERT_EQ(said.exit_code, 0) << said.err;
    EXPECT_EQ(said.out,
              "formats of the program: True\n"
              "cog cog.tif False\n"
              "terrain-rgb terrain-rgb True\n"
              "3dtiles 3dtiles True\n"
              "gltf gltf.glb False\n"
              "quantized-mesh quantized-mesh True\n"
              "['--at=36.545000000,-84.255000000', '--at=36.545100000,-84.255000000'] False\n"
              "1000 False\n"
              "--observers True\n"
              "1001 observers; the last at 36.545000,-84.252500\n"
              "each style is loaded by an algorithm: True\n"
              "camera.qml singleSymbol heading_deg\n"
              "footprint.qml singleSymbol\n"
              "horizon.qml singlebandpseudocolor\n"
              "line-of-sight.qml singleSymbol\n"
              "profile.qml singleSymbol H_m\n"
              "sight.qml categorizedSymbol part\n"
              "sky-view.qml singlebandpseudocolor\n"
              "slope.qml singlebandpseudocolor\n"
              "viewshed.qml paletted\n");
}

}  // namespace
