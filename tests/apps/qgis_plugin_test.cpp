// What the plugin of QGIS runs the program with, without QGIS: scripts/check-qgis runs the plugin in QGIS.
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

}  // namespace
