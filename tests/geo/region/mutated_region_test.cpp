// A baked region whose file was changed anywhere: whatever is asked of it is answered as the whole file
// answers, or refused in one line. The long run: OROGRAPH_TEST_MUTATIONS=2500.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>

#include "core/baked/bake.h"
#include "core/baked/file_pages.h"
#include "core/baked/region_format.h"
#include "core/base/checksum.h"
#include "core/terrain/ground.h"
#include "geo/opening/baked_region.h"
#include "geo/region/region_description.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/mutated_bytes.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

// Something to ask of a region file, and a sum of the answer.
struct Question {
    const char* name;
    std::function<Result<std::uint64_t>(const std::string& path)> ask;
};

template <class Number>
std::uint64_t sum_of(const std::vector<Number>& numbers) {
    return xxh64(std::as_bytes(std::span(numbers)));
}

Result<RegionGrid> whole_region(const std::string& path) {
    return test::open_grid(request_for({path}));
}

Result<std::uint64_t> drawn_pages(const std::string& path) {
    ORO_TRY(const RegionGrid region, whole_region(path));
    const auto pages = pages_of_file(region.file);
    std::uint64_t sum = 0;
    const PageOrder& order = region.file->order();
    for (std::uint64_t number = 0; number < order.count(); ++number) {
        ORO_TRY(const PageRecord record, pages->record(order.index(number)));
        const auto bytes = region_format::record_to_bytes({record, 0, 0, 0});
        const auto block = std::make_unique<gpu::PageBlock>();
        ORO_CHECK(pages->load(order.index(number), *block));
        sum = xxh64(bytes, xxh64(std::as_bytes(std::span(block.get(), 1)), sum));
    }
    return sum;
}

// One page at a time, as a sight line or the eye asks.
Result<std::uint64_t> posts_when_asked(const std::string& path) {
    ORO_TRY(const RegionGrid region, whole_region(path));
    std::vector<float> posts;
    for (int row = 0; row < region.field.grid.rows(); row += 29) {
        for (int column = 0; column < region.field.grid.columns(); column += 31)
            posts.push_back(region.field.H_at_post_m(row, column));
    }
    ORO_CHECK(region.field.health());
    return sum_of(posts);
}

Result<std::uint64_t> ground(const std::string& path) {
    ORO_TRY(const RegionGrid region, whole_region(path));
    const PostGrid& grid = region.field.grid;
    std::vector<double> heights;
    for (const double share : {0.1, 0.5, 0.77})
        heights.push_back(ground_h_m(region.field,
                                     grid.north_deg() + share * (grid.south_deg() - grid.north_deg()),
                                     grid.west_deg() + share * (grid.east_deg() - grid.west_deg()))
                              .value_or(-1.0));
    ORO_CHECK(region.field.health());
    return sum_of(heights);
}

Result<std::uint64_t> all_posts(const std::string& path) {
    ORO_TRY(const RegionGrid region, whole_region(path));
    ORO_TRY(const HeightField field, field_in_memory(*region.file));
    return sum_of(field.H_m) ^ sum_of(field.undulation.N_m);
}

Result<std::uint64_t> a_part(const std::string& path) {
    RegionRequest request = request_for({path});
    request.box = BoundingBox{-84.30, 36.51, -84.22, 36.58};
    ORO_TRY(const RegionGrid region, test::open_grid(request));
    return sum_of(region.field.H_m) ^ sum_of(region.field.undulation.N_m);
}

Result<std::uint64_t> description(const std::string& path) {
    ORO_TRY(const RegionGrid region, whole_region(path));
    const HeightRange range = height_range(region.field);
    const std::string text = region_description(region) + std::to_string(range.lowest_m) + " " +
                             std::to_string(range.highest_m) + " " + std::to_string(region.voids);
    return xxh64(std::as_bytes(std::span(text)));
}

const std::vector<Question>& questions() {
    static const std::vector<Question> all{{"pages to draw", drawn_pages},
                                           {"posts when asked", posts_when_asked},
                                           {"ground", ground},
                                           {"all posts", all_posts},
                                           {"a part", a_part},
                                           {"description", description}};
    return all;
}

// Some 200 x 150 posts of the bundled region: 4 pages and 1.
std::string bake_part(const fs::path& file) {
    RegionRequest request = request_for({(bundled_data() / "jacksboro.tif").string()});
    request.box = BoundingBox{-84.33, 36.5, -84.16, 36.62};
    const auto region = opened(request);
    EXPECT_TRUE(region);
    BakeOptions how;
    how.path = file.string();
    how.description = region_description(*region);
    const auto done = bake_region(region->field, how);
    EXPECT_TRUE(done.ok()) << done.error().line();
    return file.string();
}

std::string content_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// Where the file's parts begin: header, chunks, and in those of pages each record and each payload.
std::vector<std::size_t> parts_of(const std::string& path) {
    const auto container = Container::open(path);
    EXPECT_TRUE(container.ok());
    std::vector<std::size_t> parts{0};
    std::size_t pages = 0;
    for (const Chunk& chunk : (*container)->table().chunks) {
        if (chunk.type == ChunkType::pages) pages = chunk.bytes / region_format::record_bytes;
        if (chunk.bytes == 0) continue;
        const bool is_of_pages = chunk.type == ChunkType::pages || chunk.type == ChunkType::heights;
        const std::size_t pieces = is_of_pages ? pages : 1;
        for (std::size_t piece = 0; piece < pieces; ++piece)
            parts.push_back(chunk.offset + chunk.bytes * piece / pieces);
    }
    return parts;
}

TEST(MutatedRegion, AnswersAsTheWholeOneOrNotAtAll) {
    const std::string path = bake_part(scratch_folder() / "region.oro");
    const std::string whole = content_of(path);
    const std::vector<std::size_t> parts = parts_of(path);
    std::vector<std::uint64_t> answers;
    for (const Question& question : questions()) {
        const auto answer = question.ask(path);
        ASSERT_TRUE(answer.ok()) << question.name << ": " << answer.error().line();
        answers.push_back(*answer);
    }
    const auto seed = std::random_device{}();
    const int count = mutation_count(300);
    std::printf("seed %u, %d mutations\n", seed, count);
    std::mt19937_64 random(seed);
    std::vector<int> refused(questions().size());
    for (int i = 0; i < count; ++i) {
        const Mutation mutation = mutated(whole, parts, random);
        SCOPED_TRACE("seed " + std::to_string(seed) + ", mutation " + std::to_string(i) + ": " +
                     mutation.what);
        std::ofstream(path, std::ios::binary) << mutation.bytes;
        const auto expect_place = [&](const std::string& line) {
            EXPECT_EQ(line.rfind(path + ": ", 0), 0U) << line;
            EXPECT_TRUE(line.find("byte") != std::string::npos || line.find("is empty") != std::string::npos)
                << line;
        };
        for (std::size_t q = 0; q < questions().size(); ++q) {
            const auto answer = questions()[q].ask(path);
            if (answer.ok()) {
                EXPECT_EQ(*answer, answers[q]) << questions()[q].name;
            } else {
                expect_place(answer.error().line());
                ++refused[q];
            }
        }
        // No byte is without a checksum.
        const auto file = RegionFile::open(path);
        const Result<void> checked = file.ok() ? file->verify() : Result<void>(file.error());
        ASSERT_FALSE(checked.ok());
        expect_place(checked.error().line());
    }
    for (std::size_t q = 0; q < questions().size(); ++q)
        std::printf("%s: refused %d of %d times\n", questions()[q].name, refused[q], count);
    EXPECT_EQ(refused[0], count) << "pages to draw are all pages";
}

}  // namespace
}  // namespace oro
