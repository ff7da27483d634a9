// A file that somebody writes to while it is read: one line, and nothing is made of two states.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/apps/program.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bundled;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::names_in;
using oro::test::Outcome;
using oro::test::Words;

// Runs the program while a file is overwritten in place with its own bytes, again and again: nothing but its
// time tells.
Outcome run_while_written(const fs::path& file, const Words& words) {
    const std::string session = R"(
        file=$1; shift
        cp "$file" "$file.copy"
        (while :; do dd if="$file.copy" of="$file" conv=notrunc bs=64k 2>/dev/null; : >"$file.begun"; done) & writer=$!
        until [ -e "$file.begun" ]; do sleep 0.01; done
        "$@"; code=$?
        kill $writer 2>/dev/null; wait $writer 2>/dev/null
        rm -f "$file.copy" "$file.begun"
        exit $code)";
    Words all{"bash", "-c", session, "bash", file, OROGRAPH_PROGRAM};
    all.insert(all.end(), words.begin(), words.end());
    return oro::test::run_program(all);
}

TEST(RewrittenFiles, AreRefusedByEveryCommand) {
    const fs::path folder = oro::test::scratch_folder(), land = folder / "land.tif";
    fs::copy_file(bundled(), land);
    for (const Words& words :
         {Words{"bake", land, "--out", folder / "a.oro", "-q"}, Words{"info", land},
          Words{"viewshed", land, "--at", "36.53,-84.23", "--radius", "2", "--out", folder / "a.tif", "-q"},
          Words{"shot", land, "--style", "default", "--size", "64x48", "--out", folder / "a.png", "-q"}}) {
        SCOPED_TRACE(words[0]);
        expect_refusal(run_while_written(land, words), failed, {land, "was changed while it was read"});
        EXPECT_EQ(names_in(folder), Words{"land.tif"});
    }
}

TEST(RewrittenFiles, MayBeImagesAndNames) {
    const fs::path folder = oro::test::scratch_folder(), image = folder / "image.tif",
                   names = folder / "names.geojson";
    fs::copy_file(bundled(), image);
    oro::test::write_bytes(names, R"({"type":"Feature","properties":{"name":"a"},"geometry":)"
                                  R"({"type":"Point","coordinates":[-84.3,36.5]}})");
    for (const auto& [option, file] : {std::pair{"--drape", image}, std::pair{"--names", names}}) {
        SCOPED_TRACE(option);
        expect_refusal(run_while_written(file, {"shot", bundled(), option, file, "--style", "default",
                                                "--size", "64x48", "--out", folder / "a.png", "-q"}),
                       failed, {file, "was changed while it was read"});
        EXPECT_EQ(names_in(folder), (Words{"image.tif", "names.geojson"}));
    }
}

}  // namespace
