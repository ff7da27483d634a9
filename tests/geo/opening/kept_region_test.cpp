// A region that is kept from one job to the next is what would be read anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/files_of_job.h"
#include "core/base/files_read.h"
#include "geo/opening/open_region.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

class KeptRegion : public testing::Test {
  protected:
    const fs::path folder_ = scratch_folder();

    void TearDown() override {
        keep_no_region();
        end_files_of_jobs();
        forget_files_read();
    }
    [[nodiscard]] RegionRequest tile(double height_m) const {
        RegionRequest request;
        request.paths = {write_hgt(folder_ / "N10E020.hgt", 1201,
                                   [&](int r, int c) { return std::round(height_m + 0.1 * r + 0.05 * c); })};
        return request;
    }
    static float first_H_m(const RegionRequest& request) {
        begin_files_of_job();
        const Result<Region> region = open_region(request);
        EXPECT_TRUE(region.ok()) << region.error().line();
        return region.ok() ? region->grids[0].field.H_at_post_m(0, 0) : NAN;
    }
};

TEST_F(KeptRegion, IsReadOnceAsLongAsItIsTheSame) {
    const RegionRequest request = tile(500.0);
    keep_last_region();
    EXPECT_EQ(first_H_m(request), 500.0F);
    EXPECT_EQ(first_H_m(request), 500.0F);
    EXPECT_EQ(regions_read(), 1U);
    // The second job has read the file, too.
    const std::vector<FileOfJob> read = files_read_of_job();
    EXPECT_TRUE(
        std::ranges::any_of(read, [&](const FileOfJob& file) { return file.path == request.paths[0]; }));
    EXPECT_FALSE(check_not_read(request.paths[0]).ok());
    // Another part, and another way of reading, are other regions.
    RegionRequest part = request;
    part.box = BoundingBox{20.25, 10.25, 20.5, 10.5};
    EXPECT_EQ(first_H_m(part), 500.0F + 60.0F + 15.0F);
    RegionRequest listed = part;
    listed.listed_first = true;
    EXPECT_EQ(first_H_m(listed), 500.0F + 60.0F + 15.0F);
    EXPECT_EQ(regions_read(), 3U);
}

TEST_F(KeptRegion, IsReadAgainWhereItsFilesAreOthers) {
    const RegionRequest request = tile(500.0);
    keep_last_region();
    EXPECT_EQ(first_H_m(request), 500.0F);
    (void)tile(600.0);
    EXPECT_EQ(first_H_m(request), 600.0F);
    EXPECT_EQ(regions_read(), 2U);
}

// What a job does to its region is its own.
TEST_F(KeptRegion, IsACopy) {
    const RegionRequest request = tile(500.0);
    keep_last_region();
    begin_files_of_job();
    Result<Region> first = open_region(request);
    ASSERT_TRUE(first.ok());
    first->grids[0].field.H_m[0] = 1.0F;
    EXPECT_EQ(first_H_m(request), 500.0F);
    keep_no_region();
    EXPECT_EQ(first_H_m(request), 500.0F);
    EXPECT_EQ(regions_read(), 0U);
}

}  // namespace
}  // namespace oro
