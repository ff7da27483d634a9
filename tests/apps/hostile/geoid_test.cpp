// Geoid grids that are damaged, as users meet them: every command refuses, doctor names the file.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::Circumstances;
using oro::test::expect_refusal;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::Words;

TEST(DamagedGeoidGrid, EveryCommandRefusesAndDoctorNamesTheFile) {
    const fs::path proj = "/usr/share/proj";
    if (!fs::exists(proj / "egm96_15.gtx")) GTEST_SKIP() << "needs " << proj / "egm96_15.gtx";
    const fs::path folder = oro::test::scratch_folder();
    fs::create_symlink(proj / "proj.db", folder / "proj.db");
    const fs::path grid = folder / "egm96_15.gtx";
    Circumstances damaged;
    damaged.environment = {"PROJ_DATA=" + folder.string()};
    const std::string whole = bytes_of(proj / "egm96_15.gtx");
    for (const std::size_t bytes : {std::size_t{1000000}, std::size_t{40}, std::size_t{0}}) {
        SCOPED_TRACE(bytes);
        oro::test::write_bytes(grid, whole.substr(0, bytes));
        const fs::path picture = folder / "a.png", baked = folder / "a.oro";
        for (const Words& words :
             {Words{"info", bundled()}, Words{"bake", bundled(), "--out", baked},
              Words{"plan", bundled(), "--at", "36.6,-84.2"},
              Words{"shot", bundled(), "--at", "36.6,-84.2", "--size", "64x48", "--out", picture},
              Words{"info", bundled(), "--strict-datum"}})
            expect_refusal(run_orograph(words, damaged), 1, {grid.string(), "damaged"});
        EXPECT_FALSE(fs::exists(picture) || fs::exists(baked));
        const Outcome reported = run_orograph({"doctor", "--json"}, damaged);
        EXPECT_EQ(reported.exit_code, 0) << reported.err;
        EXPECT_EQ(reported.err, "");
        const nlohmann::json geoid = nlohmann::json::parse(reported.out)["geoids"][0];
        EXPECT_EQ(geoid["found"], true);
        EXPECT_NE(geoid["damage"].get<std::string>().find(grid.string()), std::string::npos) << geoid.dump();
    }
    EXPECT_NE(run_orograph({"doctor"}, damaged).out.find("DAMAGED"), std::string::npos);
    // What is not there at all is another thing: N = 0 stands in, with a note.
    fs::remove(grid);
    const Outcome without = run_orograph({"info", bundled()}, damaged);
    EXPECT_EQ(without.exit_code, 0) << without.err;
    EXPECT_NE(without.out.find("N = 0 stands in"), std::string::npos) << without.out;
    expect_refusal(run_orograph({"info", bundled(), "--strict-datum"}, damaged), 1, {"egm96_15"});
}

}  // namespace
