// Region files of posts on a net: the same posts, pages and places to the bit; and what lies.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>

#include "core/baked/bake.h"
#include "core/baked/file_pages.h"
#include "core/baked/net_bytes.h"
#include "core/base/little_endian.h"
#include "tests/core/baked/made_region_file.h"
#include "tests/support/mended_container.h"
#include "tests/support/net_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;

// The middle of a net in several patches: 300 x 420 posts.
std::shared_ptr<const LatticeGeoreference> middle_of_net(double middle_lon_deg) {
    const auto part = net_of({700, 900, {46.5, middle_lon_deg}, 2500.0, 12.0})->part(200, 300, 300, 420);
    EXPECT_TRUE(part.ok());
    return *part;
}

// Turned, in several patches and three levels, over an N that differs from post to post.
HeightField made_net() {
    HeightField field;
    field.grid = grid_on_net(middle_of_net(8.0));
    for (int row = 0; row < 300; ++row) {
        for (int column = 0; column < 420; ++column) field.H_m.push_back(patchy_H_m(row, column));
    }
    const PostGrid& grid = field.grid;
    field.undulation.lat = {4.0, 0.0, static_cast<std::int64_t>(std::ceil(grid.north_deg() * 4)), -1, 14};
    field.undulation.lon = {4.0, 0.0, static_cast<std::int64_t>(std::floor(grid.west_deg() * 4)), +1, 28};
    for (int i = 0; i < 14 * 28; ++i)
        field.undulation.N_m.push_back(static_cast<float>(48.0 + 3.0 * std::sin(0.7 * i)));
    field.N_of_posts_m = N_of_net_m(*grid.net, field.undulation, 2);
    for (int i = 0; i < 400; ++i) field.H_m[static_cast<std::size_t>(50'000 + 3 * i)] = void_height_m;
    return field;
}

BakeOptions to(const fs::path& file) {
    BakeOptions how;
    how.path = file;
    how.description = "{}";
    how.threads = 2;
    return how;
}

void bake(const HeightField& field, const fs::path& file) {
    const auto done = bake_region(field, to(file));
    ASSERT_TRUE(done.ok()) << done.error().line();
}

bool same_bits(const glm::dvec3& a, const glm::dvec3& b) {
    return std::memcmp(&a, &b, sizeof(a)) == 0;
}

TEST(NetFile, BringsBackPostsPagesAndPlaces) {
    const fs::path path = scratch_folder() / "net.oro";
    const HeightField field = made_net();
    bake(field, path);
    auto opened = RegionFile::open(path);
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    ASSERT_TRUE(opened->verify().ok());
    const auto file = std::make_shared<const RegionFile>(std::move(*opened));
    const LatticeGeoreference &was = *field.grid.net, &is = *file->outline().grid.net;
    ASSERT_GT(was.stored().coefficients.size(), 81U) << "several patches";
    EXPECT_EQ(is.row_m(), was.row_m());
    EXPECT_EQ(is.bend(), was.bend());
    EXPECT_EQ(is.error_m(), was.error_m());
    EXPECT_EQ(is.box().east_deg, was.box().east_deg);
    const HeightField by_page = field_of_file(file, 1U << 20U);
    const auto whole = field_in_memory(*file);
    ASSERT_TRUE(whole.ok()) << whole.error().line();
    for (int row = 0; row < 300; ++row) {
        for (int column = 0; column < 420; ++column) {
            ASSERT_TRUE(same_bits(is.normal_at(row, column), was.normal_at(row, column)));
            for (const HeightField* const one : {&by_page, &*whole}) {
                ASSERT_EQ(one->H_at_post_m(row, column), field.H_at_post_m(row, column));
                ASSERT_EQ(one->N_at_post_m(row, column), field.N_at_post_m(row, column));
            }
        }
    }
    const auto from_file = pages_of_file(file), in_memory = pages_in_memory(field, 1.0, 2);
    EXPECT_EQ(from_file->facts().undulation.N_m, in_memory->facts().undulation.N_m);
    EXPECT_EQ(from_file->facts().triangles, in_memory->facts().triangles);
    auto one = std::make_unique<gpu::PageBlock>(), other = std::make_unique<gpu::PageBlock>();
    auto places = std::make_unique<gpu::PagePlaces>(), others = std::make_unique<gpu::PagePlaces>();
    ASSERT_EQ(from_file->levels(), 3);
    for (std::uint64_t number = 0; number < file->order().count(); ++number) {
        const PageIndex index = file->order().index(number);
        EXPECT_TRUE(same(*from_file->record(index), *in_memory->record(index)));
        std::memset(one.get(), 0, sizeof(*one));
        std::memset(other.get(), 0, sizeof(*other));
        ASSERT_TRUE(from_file->load(index, *one).ok());
        ASSERT_TRUE(in_memory->load(index, *other).ok());
        EXPECT_EQ(std::memcmp(one.get(), other.get(), sizeof(*one)), 0) << number;
        ASSERT_TRUE(from_file->load_places(index, *one, *places).ok());
        ASSERT_TRUE(in_memory->load_places(index, *other, *others).ok());
        EXPECT_EQ(std::memcmp(places.get(), others.get(), sizeof(*places)), 0) << number;
    }
}

TEST(NetFile, IsTheSameHoweverOftenItWasBrokenOff) {
    const fs::path folder = scratch_folder();
    const HeightField field = made_net();
    bake(field, folder / "a.oro");
    bake(field, folder / "b.oro");
    EXPECT_TRUE(content(folder / "a.oro") == content(folder / "b.oro"));
    int breaks = 0;
    for (int left = 1; left < 40; left += 3) {
        int more = left;
        const auto done = bake_region(field, to(folder / "c.oro"), [&](double) { return --more > 0; });
        breaks += done.ok() ? 0 : 1;
        if (done.ok()) break;
    }
    EXPECT_GE(breaks, 2);
    EXPECT_TRUE(content(folder / "a.oro") == content(folder / "c.oro"));
    // One that another net has begun is no beginning of this.
    HeightField other = field;
    other.grid = grid_on_net(middle_of_net(8.0001));
    int more = 5;
    EXPECT_FALSE(bake_region(other, to(folder / "d.oro"), [&](double) { return --more > 0; }).ok());
    const auto done = bake_region(field, to(folder / "d.oro"));
    ASSERT_TRUE(done.ok());
    EXPECT_EQ(done->pages_found, 0U);
    EXPECT_TRUE(content(folder / "a.oro") == content(folder / "d.oro"));
}

// A part has the posts of the whole, and its file, too.
TEST(NetFile, PartsHaveThePlacesOfTheirWhole) {
    const auto whole = net_of({700, 900, {89.9, 0.0}, 2500.0, 33.0});
    const auto stored = whole->stored();
    ASSERT_GT(stored.down.patches, 1) << "or nothing is cut";
    const auto part = whole->part(351, 77, 240, 500);
    ASSERT_TRUE(part.ok()) << part.error().line();
    EXPECT_LT((*part)->stored().coefficients.size(), stored.coefficients.size());
    const auto bytes = region_format::net_to_bytes(**part);
    const auto again = region_format::net_from_bytes(bytes, 240, 500);
    ASSERT_TRUE(again.ok()) << again.error().line();
    std::vector<glm::dvec3> expected(500), found(500);
    for (int row = 0; row < 240; ++row) {
        whole->normals_of_row(351 + row, 77, expected);
        for (const auto& net : {*part, *again}) {
            net->normals_of_row(row, 0, found);
            for (std::size_t i = 0; i < found.size(); ++i) ASSERT_TRUE(same_bits(found[i], expected[i]));
        }
    }
}

TEST(NetFile, RefusesEveryFlippedBitOfTheNet) {
    const fs::path path = scratch_folder() / "net.oro";
    const HeightField field = made_net();
    bake(field, path);
    const std::string whole = content(path);
    const Chunk net = chunk_of(path, ChunkType::net);
    const std::size_t begin = net.offset, end = net.offset + net.bytes;
    constexpr unsigned seed = 77;
    std::printf("seed %u, net of %zu bytes\n", seed, end - begin);
    std::mt19937_64 random(seed);
    for (int i = 0; i < 600; ++i) {
        std::string changed = whole;
        const std::size_t byte = i < 256 ? static_cast<std::size_t>(i) : begin + random() % (end - begin);
        changed[byte] = static_cast<char>(changed[byte] ^ (1 << (random() % 8)));
        put(path, changed);
        const auto file = RegionFile::open(path);
        ASSERT_FALSE(file.ok()) << byte;
        ASSERT_TRUE(says(file.error().line(), "byte ")) << file.error().line();
        if (byte >= begin) {
            EXPECT_TRUE(
                says(file.error().line(), "byte " + std::to_string(begin) + ": the net has checksum"));
        }
    }
}

TEST(NetFile, RefusesNetsThatAreNone) {
    const fs::path path = scratch_folder() / "net.oro";
    const HeightField field = made_net();
    bake(field, path);
    const std::string whole = content(path);
    const std::size_t begin = chunk_of(path, ChunkType::net).offset,
                      lat = chunk_of(path, ChunkType::outline).offset + 8;
    const auto with = [&](std::size_t byte, auto number) {
        std::string changed = whole;
        set_number(changed, byte, number);
        put(path, mended(changed));
        return refusal(path);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto at = [](std::size_t byte) { return "is damaged at byte " + std::to_string(byte) + ": "; };
    EXPECT_EQ(with(lat - 8, std::uint64_t{5}), "");  // another fingerprint
    EXPECT_TRUE(says(with(lat, 1200.0), at(lat)));
    EXPECT_TRUE(says(with(lat + 8, nan), at(lat + 8)));
    EXPECT_TRUE(says(with(lat + 16, std::int64_t{40}), at(lat + 16)));
    EXPECT_TRUE(says(with(lat + 28, 1), at(lat + 28)));
    EXPECT_TRUE(says(with(lat + 28, 301), "none: it has 300 x 420 posts, expected 301 x 420"));
    const auto none = at(begin) + "the net of its posts is none: ";
    const std::size_t first_coefficient = begin + region_format::net_front_bytes;
    EXPECT_TRUE(says(with(begin, -1), none + "its posts and patches do not fit each other"));
    EXPECT_TRUE(says(with(begin + 8, 0), none + "its posts and patches do not fit each other"));
    EXPECT_TRUE(says(with(begin + 12, 1 << 30), none + "its posts and patches do not fit each other"));
    EXPECT_TRUE(says(with(begin + 32, nan), none + "its places are"));
    EXPECT_TRUE(says(with(begin + 32, 1.0), none + "its places are"));
    EXPECT_TRUE(says(with(first_coefficient, nan), none + "a coefficient is not within -2 .. 2"));
    EXPECT_TRUE(says(with(first_coefficient, 1.0e300), none + "a coefficient is not within -2 .. 2"));
    EXPECT_TRUE(says(with(first_coefficient, 1.5), none + "its normals are not of length 1, or do not meet"));
}

// Any numbers at all: a net or a refusal, and no place that is no number.
TEST(NetFile, SurvivesRandomNumbers) {
    const auto net = net_of({40, 50, {-33.9, 151.2}, 30.0, 5.0});
    const auto whole = region_format::net_to_bytes(*net);
    constexpr unsigned seed = 4021;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    int refused = 0;
    for (int i = 0; i < 900; ++i) {
        std::vector<std::byte> bytes = whole;
        if (i % 3 == 0) {
            to_little_endian(static_cast<std::uint32_t>(random() % 64), &bytes[4 * (random() % 8)]);
        } else {
            const std::size_t byte = 40 + 8 * (random() % (3 * 81));
            const auto was = from_little_endian<double>(&bytes[byte]);
            const double by =
                std::ldexp(static_cast<double>(random() % 2001) - 1000.0, -static_cast<int>(random() % 40));
            to_little_endian(i % 3 == 1 ? was + by : std::bit_cast<double>(random()), &bytes[byte]);
        }
        const auto read = region_format::net_from_bytes(bytes, 40, 50);
        if (!read.ok()) {
            ++refused;
            ASSERT_FALSE(read.error().what.empty());
            continue;
        }
        const PostPlace place = (*read)->place_at(39, 49);
        ASSERT_TRUE(std::abs(place.lat_deg) <= 90.0 && std::abs(place.lon_deg) <= 180.0);
        const PostNumber back = (*read)->post_at(-33.9, 151.2);
        ASSERT_FALSE(std::isnan(back.row));
    }
    EXPECT_GE(refused, 450);
}

// What memory is taken for follows from the first 40 bytes.
TEST(NetFile, IsNoLargerThanItsFrontAllows) {
    const auto whole = region_format::net_to_bytes(*net_of({40, 50, {-33.9, 151.2}, 30.0, 5.0}));
    const auto most = [&](std::span<const std::byte> bytes) {
        return region_format::most_net_bytes(bytes.first(std::min<std::size_t>(bytes.size(), 40)), 40, 50);
    };
    const auto of_it = most(whole);
    ASSERT_TRUE(of_it.ok()) << of_it.error().line();
    EXPECT_GE(*of_it, whole.size());
    EXPECT_LE(*of_it, whole.size() + 40'000);  // and corrections of one patch
    EXPECT_FALSE(most(std::span(whole).first(39)).ok());
    for (const std::size_t count : {0U, 4U, 8U, 12U}) {
        std::vector<std::byte> bytes = whole;
        to_little_endian(std::int32_t{1 << 30}, &bytes[count]);
        const auto forged = most(bytes);
        EXPECT_TRUE(!forged.ok() || *forged <= whole.size()) << count;
    }
}

}  // namespace
}  // namespace oro
