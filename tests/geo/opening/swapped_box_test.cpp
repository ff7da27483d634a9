// A box whose west and east are swapped goes most of the way round the Earth: it is told from one that shall.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "geo/opening/open_region.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using test::request_for, test::scratch_folder, test::write_hgt;
namespace fs = std::filesystem;

// The error of a request with a box; "" where the region is opened.
std::string fault_with_box(RegionRequest request, const std::string& box) {
    request.box = *parse_bounding_box(box);
    const Result<Region> region = open_region(request);
    if (region.ok()) return "";
    return (region.error().kind == ErrorKind::usage ? "usage: " : "other: ") + region.error().line();
}

TEST(SwappedBox, IsRefusedWithTheOneThatIsMeant) {
    const fs::path folder = scratch_folder();
    write_hgt(folder / "N10E020.hgt", 1201, [](int, int) { return 100; });
    const RegionRequest request = request_for({folder.string()});
    const std::string words =
        " crosses the antimeridian, and goes most of the way round the Earth: did you mean ";
    const auto refused = [&](const std::string& box, const std::string& meant) {
        EXPECT_EQ(fault_with_box(request, box), "usage: --bbox " + box + ":" + words + meant + "?");
    };
    refused("20.6,10.2,20.4,10.8", "20.4,10.2,20.6,10.8");
    // The box as it stands has no data at all, and the swapped one is the tile.
    refused("21,10,20,11", "20,10,21,11");
    // The swapped one has no data, or only the box as it stands has some: it is what was asked for.
    EXPECT_EQ(fault_with_box(request, "30.6,10.2,30.4,10.8"), "");
    EXPECT_EQ(fault_with_box(request, "20.4,10.2,20.6,10.8"), "");
}

TEST(SwappedBox, OverTheAntimeridianIsNone) {
    const fs::path folder = scratch_folder();
    write_hgt(folder / "S18E179.hgt", 1201, [](int, int) { return 100; });
    write_hgt(folder / "S18W180.hgt", 1201, [](int, int) { return 100; });
    const RegionRequest request = request_for({folder.string()});
    EXPECT_EQ(fault_with_box(request, "179.5,-17.8,-179.5,-17.2"), "");
    EXPECT_EQ(fault_with_box(request, "175,-20,-175,-15"), "");
    // Most of the way round the Earth, with data on both sides of the antimeridian.
    EXPECT_EQ(fault_with_box(request, "10,-20,9,-15").find("did you mean"), std::string::npos);
    EXPECT_EQ(fault_with_box(request, "179.8,-17.8,179.6,-17.2").find("did you mean"), std::string::npos);
}

TEST(SwappedBox, OfRealDataOverTheAntimeridianIsNone) {
    const auto fiji = test::real_data("geotiff/fiji_antimeridian_etopo1_170_190.tif");
    if (!fiji) GTEST_SKIP() << "needs geotiff";
    EXPECT_EQ(fault_with_box(request_for({fiji->string()}), "175,-20,-175,-15"), "");
    EXPECT_EQ(fault_with_box(request_for({fiji->string()}), "172,-20,-172,-15"), "");
}

}  // namespace
}  // namespace oro
