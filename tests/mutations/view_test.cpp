// Damaged views, and pictures that carry one.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "apps/view/view.h"
#include "tests/mutations/mutation.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using namespace oro;
using namespace oro::test;

TEST(Mutated, ViewsAndPictures) {
    for (const std::string name : {"v.png", "v.jpg", "v.tif", "v.json"}) {
        Sample sample{"view-" + name.substr(2), scratch_folder(), name, {name}, false};
        const std::string picture = name == "v.json" ? "other.png" : name;
        const std::string command = std::string(OROGRAPH_PROGRAM) +
                                    " shot -q --style default --size 32x24 --samples 1 '" +
                                    (bundled_data() / "jacksboro.tif").string() + "' --out '" +
                                    (sample.folder / picture).string() + "' 2>/dev/null";
        ASSERT_EQ(std::system(command.c_str()), 0);
        if (name == "v.json") {
            const auto view = read_view((sample.folder / picture).string());
            ASSERT_TRUE(view.ok()) << view.error().line();
            write_bytes(sample.folder / name, view_to_json(*view, true));
        }
        expect_no_silence(sample, share_of(750), [](const fs::path& file, std::string& said) {
            const auto view = read_view(file.string());
            if (!view.ok()) {
                said = view.error().line();
                return Found::refused;
            }
            const std::string text = view_to_json(*view, true);
            const auto again = view_from_json(text, "again");
            said = again.ok() ? "" : again.error().line();
            return again.ok() && view_to_json(*again, true) == text ? Found::same : Found::unclean;
        });
    }
}

}  // namespace
