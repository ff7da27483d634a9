// A bake that is shared: from parts that others measured it has the bytes of one that measures all itself.
#include "core/baked/measured_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "tests/core/clusters/cluster_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

std::string all_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

class SharedBake : public testing::Test {
  protected:
    const fs::path folder_ = test::scratch_folder();

    [[nodiscard]] BakeOptions how(const std::string& name) const {
        BakeOptions options;
        options.path = (folder_ / name).string();
        options.overwrite = true;
        options.fingerprint = 4711;
        options.description = "{}";
        options.threads = 2;
        return options;
    }
    // The bytes of a bake from so many parts.
    std::string joined(const HeightField& field, std::uint64_t count) const {
        BakeOptions bake = how("joined.oro");
        std::uint64_t rows = 0;
        for (std::uint64_t number = 1; number <= count; ++number) {
            const auto measured = measure_part(field, bake, {number, count});
            EXPECT_TRUE(measured.ok()) << measured.error().line();
            rows += measured.ok() ? *measured : 0;
        }
        EXPECT_EQ(rows, PageOrder(field.grid).count() * nodes_per_row);
        const auto parts = MeasuredParts::open(field.grid, bake);
        EXPECT_TRUE(parts.ok()) << parts.error().line();
        if (!parts.ok()) return "";
        bake.parts = &*parts;
        const auto done = bake_region(field, bake);
        EXPECT_TRUE(done.ok()) << done.error().line();
        for (const std::string& file : parts->files()) fs::remove(file);
        return all_of(bake.path);
    }
    [[nodiscard]] std::string at_once(const HeightField& field) const {
        const BakeOptions bake = how("whole.oro");
        EXPECT_TRUE(bake_region(field, bake).ok());
        return all_of(bake.path);
    }
};

TEST_F(SharedBake, HasTheBytesOfOneMachine) {
    for (const HeightField& field : {test::rough_field(47.0, 8.0, 340, 400), test::holed_field(300, 420, 5),
                                     test::rough_field(-0.05, 179.9, 130, 140)}) {
        const std::string whole = at_once(field);
        ASSERT_GT(whole.size(), 1000U);
        for (const std::uint64_t count : {1U, 2U, 3U, 8U, 100U})
            EXPECT_TRUE(joined(field, count) == whole) << count << " parts";
    }
}

// What parts say is taken: other deviations make another file. So the test above would see a part that is
// ignored.
TEST_F(SharedBake, TakesWhatPartsSay) {
    const HeightField rough = test::rough_field(47.0, 8.0, 340, 400), holed = test::holed_field(340, 400, 5);
    ASSERT_EQ(rough.grid.rows(), holed.grid.rows());
    ASSERT_EQ(rough.grid.columns(), holed.grid.columns());
    const std::string whole = at_once(rough);
    BakeOptions bake = how("joined.oro");
    ASSERT_TRUE(measure_part(holed, bake, {1, 1}).ok());
    const auto parts = MeasuredParts::open(rough.grid, bake);
    ASSERT_TRUE(parts.ok()) << parts.error().line();
    bake.parts = &*parts;
    ASSERT_TRUE(bake_region(rough, bake).ok());
    EXPECT_FALSE(all_of(bake.path) == whole);
}

TEST_F(SharedBake, APartThatIsThereIsNotMeasuredAgain) {
    const HeightField field = test::rough_field(47.0, 8.0, 200, 150);
    const BakeOptions bake = how("r.oro");
    const auto first = measure_part(field, bake, {2, 3});
    ASSERT_TRUE(first.ok());
    EXPECT_GT(*first, 0U);
    EXPECT_EQ(*measure_part(field, bake, {2, 3}), 0U);
    // One that was broken off is begun again, and so is a damaged one.
    ASSERT_FALSE(measure_part(field, bake, {1, 3}, [](double share) { return share < 0.3; }).ok());
    EXPECT_GT(*measure_part(field, bake, {1, 3}), 0U);
    const std::string path = path_of_measured_part(bake.path, {2, 3});
    EXPECT_EQ(path, bake.path + ".part-2of3");
    std::string bytes = all_of(path);
    bytes[bytes.size() / 2] ^= 4;
    std::ofstream(path, std::ios::binary) << bytes;
    EXPECT_EQ(*measure_part(field, bake, {2, 3}), *first);
}

TEST_F(SharedBake, PartsThatDoNotFitAreRefused) {
    const HeightField field = test::rough_field(47.0, 8.0, 200, 150);
    BakeOptions bake = how("r.oro");
    const auto said = [&] {
        const auto parts = MeasuredParts::open(field.grid, bake);
        return parts.ok() ? "" : parts.error().line();
    };
    const auto says = [&](const std::string& words) {
        const std::string line = said();
        EXPECT_NE(line.find(words), std::string::npos) << line << "\nlacks " << words;
    };
    says("is not there, nor any other part: bake --shard writes them");
    for (const std::uint64_t number : {1U, 3U}) ASSERT_TRUE(measure_part(field, bake, {number, 3}).ok());
    says("r.oro.part-2of3: is not there: bake --shard 2/3 writes it");
    ASSERT_TRUE(measure_part(field, bake, {2, 3}).ok());
    EXPECT_EQ(said(), "");
    ASSERT_TRUE(measure_part(field, bake, {1, 4}).ok());
    says("has parts of 3 and of 4");
    fs::remove(path_of_measured_part(bake.path, {1, 4}));
    bake.fingerprint += 1;
    says("is a part of other data");
    bake.fingerprint -= 1;
    fs::resize_file(path_of_measured_part(bake.path, {2, 3}), 1000);
    says("r.oro.part-2of3");
    // A name that is somebody else's.
    std::ofstream(path_of_measured_part(bake.path, {1, 5})) << "mine";
    const auto taken = measure_part(field, bake, {1, 5});
    ASSERT_FALSE(taken.ok());
    EXPECT_NE(taken.error().line().find("no bake has left it behind"), std::string::npos);
}

// A row that was damaged since the part was opened ends the bake; the file does not appear.
TEST_F(SharedBake, ADamagedRowIsTold) {
    const HeightField field = test::rough_field(47.0, 8.0, 200, 150);
    BakeOptions bake = how("r.oro");
    ASSERT_TRUE(measure_part(field, bake, {1, 1}).ok());
    const auto parts = MeasuredParts::open(field.grid, bake);
    ASSERT_TRUE(parts.ok());
    std::fstream file(path_of_measured_part(bake.path, {1, 1}),
                      std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(2000);
    file.put('\x55');
    file.close();
    bake.parts = &*parts;
    const auto done = bake_region(field, bake);
    ASSERT_FALSE(done.ok());
    EXPECT_NE(done.error().line().find("part-1of1"), std::string::npos) << done.error().line();
    EXPECT_FALSE(fs::exists(bake.path));
}

}  // namespace
}  // namespace oro
