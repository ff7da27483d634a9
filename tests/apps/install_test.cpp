// The installed program: it finds its data wherever the installation is moved, and knows nothing of the build
// tree.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

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

// What desktops, shells and man(1) know the program by.
TEST(Install, HasItsDesktopFilesPagesAndCompletion) {
    const fs::path folder = oro::test::scratch_folder();
    const auto installed = oro::test::run_program(
        {OROGRAPH_CMAKE, "--install", OROGRAPH_BUILD_DIR, "--prefix", folder.string()});
    ASSERT_EQ(installed.exit_code, 0) << installed.err << installed.out;
    const fs::path share = folder / "share";
    const std::string id = "io.github.orograph.Orograph";
    for (const std::string& file : std::vector<std::string>{
             "bash-completion/completions/orograph", "zsh/site-functions/_orograph",
             "fish/vendor_completions.d/orograph.fish", "man/man1/orograph.1", "man/man1/orograph-shot.1",
             "man/man1/orograph-doctor.1", "applications/" + id + ".desktop", "mime/packages/" + id + ".xml",
             "metainfo/" + id + ".metainfo.xml", "icons/hicolor/scalable/apps/" + id + ".svg",
             "icons/hicolor/symbolic/apps/" + id + "-symbolic.svg",
             "qgis/python/plugins/orograph/metadata.txt", "qgis/python/plugins/orograph/algorithms/base.py",
             "qgis/python/plugins/orograph/styles/viewshed.qml", "qgis/python/plugins/orograph/icon.svg",
             "doc/orograph/web/index.html", "doc/orograph/web/region.js", "doc/orograph/web/package.json",
             "doc/orograph/web/README.md"})
        EXPECT_FALSE(bytes_of(share / file).empty()) << file;
    // What was written when the program was built is what it prints.
    const std::string program = (folder / "bin" / "orograph").string();
    EXPECT_EQ(oro::test::run_program({program, "completion", "bash"}).out,
              bytes_of(share / "bash-completion/completions/orograph"));
    EXPECT_EQ(oro::test::run_program({program, "manual", "shot"}).out,
              bytes_of(share / "man/man1/orograph-shot.1"));

    const auto valid = [&](const oro::test::Words& words) {
        if (std::system(("command -v " + words[0] + " >/dev/null 2>&1").c_str()) != 0) return;
        const auto checked = oro::test::run_program(words);
        EXPECT_EQ(checked.exit_code, 0) << words[0] << ": " << checked.out << checked.err;
    };
    valid({"desktop-file-validate", (share / "applications" / (id + ".desktop")).string()});
    valid({"appstreamcli", "validate", "--no-net", (share / "metainfo" / (id + ".metainfo.xml")).string()});
    valid({"xmllint", "--noout", (share / "mime/packages" / (id + ".xml")).string(),
           (share / "metainfo" / (id + ".metainfo.xml")).string(),
           (share / "icons/hicolor/scalable/apps" / (id + ".svg")).string(),
           (share / "icons/hicolor/symbolic/apps" / (id + "-symbolic.svg")).string()});
}

}  // namespace
