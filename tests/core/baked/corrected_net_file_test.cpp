// Region files of posts on a net with corrections: the same places to the bit; and what lies.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <random>

#include "core/baked/bake.h"
#include "core/baked/file_pages.h"
#include "core/baked/net_bytes.h"
#include "core/base/little_endian.h"
#include "tests/core/baked/made_region_file.h"
#include "tests/support/net_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;

const KinkedPlane kinked{{300, 420, {46.5, 8.0}, 25.0, 12.0}, 150.3, 0.2};

HeightField made_field() {
    HeightField field;
    field.grid = grid_on_net(kinked_net_of(kinked));
    for (int row = 0; row < 300; ++row)
        for (int column = 0; column < 420; ++column) field.H_m.push_back(patchy_H_m(row, column));
    return field;
}

void bake_kinked(const HeightField& field, const fs::path& file) {
    BakeOptions how;
    how.path = file;
    how.description = "{}";
    how.threads = 2;
    const auto done = bake_region(field, how);
    ASSERT_TRUE(done.ok()) << done.error().line();
}

TEST(CorrectedNetFile, BringsBackPostsPagesAndPlaces) {
    const fs::path path = scratch_folder() / "net.oro";
    const HeightField field = made_field();
    bake_kinked(field, path);
    auto opened = RegionFile::open(path);
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    ASSERT_TRUE(opened->verify().ok());
    const auto file = std::make_shared<const RegionFile>(std::move(*opened));
    const LatticeGeoreference &was = *field.grid.net, &is = *file->outline().grid.net;
    const auto corrections = was.stored().corrections;
    ASSERT_GT(corrections.size(), 2U);
    EXPECT_EQ(is.stored().corrections.size(), corrections.size());
    EXPECT_EQ(is.error_m(), was.error_m());
    EXPECT_EQ(is.kink(), was.kink());
    for (int row = 0; row < 300; ++row) {
        for (int column = 0; column < 420; ++column) {
            const glm::dvec3 expected = was.normal_at(row, column), found = is.normal_at(row, column);
            ASSERT_EQ(std::memcmp(&expected, &found, sizeof(found)), 0);
        }
    }
    const auto from_file = pages_of_file(file), in_memory = pages_in_memory(field, 1.0, 2);
    auto one = std::make_unique<gpu::PageBlock>(), other = std::make_unique<gpu::PageBlock>();
    auto places = std::make_unique<gpu::PagePlaces>(), others = std::make_unique<gpu::PagePlaces>();
    for (std::uint64_t number = 0; number < file->order().count(); ++number) {
        const PageIndex index = file->order().index(number);
        EXPECT_TRUE(same(*from_file->record(index), *in_memory->record(index)));
        ASSERT_TRUE(from_file->load(index, *one).ok());
        ASSERT_TRUE(in_memory->load(index, *other).ok());
        ASSERT_TRUE(from_file->load_places(index, *one, *places).ok());
        ASSERT_TRUE(in_memory->load_places(index, *other, *others).ok());
        EXPECT_EQ(std::memcmp(places.get(), others.get(), sizeof(*places)), 0) << number;
    }
}

TEST(CorrectedNetFile, NetsWithoutCorrectionsTakeNoBytesForThem) {
    const auto net = net_of(kinked.plane);
    EXPECT_FALSE(net->is_corrected());
    EXPECT_EQ(region_format::net_to_bytes(*net).size(), 40 + net->stored().coefficients.size() * 24);
}

// Where the corrections begin in the bytes of a net, and how many there are.
struct Corrections {
    std::vector<std::byte> bytes;
    std::size_t begin, count;
};
Corrections made_corrections() {
    const auto net = kinked_net_of(kinked);
    const auto stored = net->stored();
    return {region_format::net_to_bytes(*net), 40 + stored.coefficients.size() * 24,
            stored.corrections.size()};
}

std::string refusal_of_net(const std::vector<std::byte>& bytes) {
    const auto net = region_format::net_from_bytes(bytes, 300, 420);
    return net.ok() ? "" : net.error().what;
}

TEST(CorrectedNetFile, TakesFewBytes) {
    const Corrections made = made_corrections();
    const double of_a_post =
        static_cast<double>(made.bytes.size() - made.begin) / (static_cast<double>(made.count) * 61.0 * 61.0);
    std::printf("%.2f bytes a corrected post\n", of_a_post);
    EXPECT_LT(of_a_post, 1.0);
}

TEST(CorrectedNetFile, RefusesBytesThatAreNoCorrections) {
    const Corrections made = made_corrections();
    ASSERT_GT(made.count, 2U);
    EXPECT_EQ(refusal_of_net(made.bytes), "");
    const auto with = [&](std::size_t at, auto number) {
        std::vector<std::byte> bytes = made.bytes;
        to_little_endian(number, &bytes[at]);
        return refusal_of_net(bytes);
    };
    const std::size_t first = made.begin + 4, second = first + 4, frame = first + 4 * made.count;
    const auto first_patch = from_little_endian<std::int32_t>(&made.bytes[first]);
    EXPECT_TRUE(says(with(made.begin, std::uint32_t{0}), "its corrections are 0 in "));
    EXPECT_TRUE(says(with(made.begin, ~std::uint32_t{0}), "its corrections are 4294967295 in "));
    EXPECT_TRUE(says(with(made.begin, static_cast<std::uint32_t>(made.count - 1)), "cannot be unpacked"));
    EXPECT_TRUE(says(with(first, std::int32_t{-1}), "the correction of patch -1, of 35 patches"));
    EXPECT_TRUE(says(with(second, std::int32_t{35}), "the correction of patch 35, of 35 patches"));
    EXPECT_TRUE(says(with(second, first_patch), " comes after that of " + std::to_string(first_patch)));
    EXPECT_TRUE(says(with(frame, std::uint32_t{0}), "its corrections cannot be unpacked: "));
    for (const std::size_t size : {made.begin + 1, made.begin + 4, frame - 1}) {
        const std::vector<std::byte> cut(made.bytes.begin(),
                                         made.bytes.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_TRUE(says(refusal_of_net(cut), "its corrections are ")) << refusal_of_net(cut);
    }
    std::vector<std::byte> cut = made.bytes;
    cut.pop_back();
    EXPECT_TRUE(says(refusal_of_net(cut), "its corrections cannot be unpacked: "));
    // Patches larger than any with corrections: what a table would need is not taken on trust.
    EXPECT_NE(with(8, std::int32_t{1 << 30}), "");
}

// Numbers that unpack well.
TEST(CorrectedNetFile, RefusesCorrectionsThatAreNone) {
    const LatticeGeoreference::Stored stored = kinked_net_of(kinked)->stored();
    const auto refusal_with = [&](const std::function<void(LatticeGeoreference::Stored&)>& change) {
        LatticeGeoreference::Stored changed = stored;
        change(changed);
        const auto net = LatticeGeoreference::from(changed);
        return net.ok() ? "" : net.error().what;
    };
    EXPECT_EQ(refusal_with([](LatticeGeoreference::Stored&) {}), "");
    for (const std::int16_t most : {std::int16_t{32767}, std::int16_t{-32768}})
        EXPECT_TRUE(says(
            refusal_with([&](LatticeGeoreference::Stored& net) { net.corrections[0].posts[100][1] = most; }),
            "moves a post by more than 95 mm"));
    EXPECT_TRUE(
        says(refusal_with([](LatticeGeoreference::Stored& net) { net.corrections[0].posts[100][1] = 30000; }),
             "jumps from one post to the next"));
    EXPECT_TRUE(
        says(refusal_with([](LatticeGeoreference::Stored& net) { net.corrections[1].posts.pop_back(); }),
             " posts, expected "));
    // All of a patch moved by 3 mm: it meets no other.
    EXPECT_TRUE(says(refusal_with([](LatticeGeoreference::Stored& net) {
                         for (auto& post : net.corrections[0].posts) post[2] += 1000;
                     }),
                     "do not meet"));
    EXPECT_TRUE(says(refusal_with([](LatticeGeoreference::Stored& net) {
                         net.corrections.erase(net.corrections.begin());
                     }),
                     "do not meet"));
}

// Any numbers at all: a net or a refusal, and no place that is no number.
TEST(CorrectedNetFile, SurvivesRandomNumbers) {
    const Corrections made = made_corrections();
    constexpr unsigned seed = 4022;
    std::mt19937_64 random(seed);
    int refused = 0;
    for (int i = 0; i < 600; ++i) {
        std::vector<std::byte> bytes = made.bytes;
        const std::size_t at =
            i % 3 == 0 ? made.begin + random() % 8 : made.begin + random() % (bytes.size() - made.begin - 8);
        if (i % 3 == 1)
            bytes.resize(at);
        else
            to_little_endian(static_cast<std::uint64_t>(random() >> (random() % 64)), &bytes[at]);
        const auto read = region_format::net_from_bytes(bytes, 300, 420);
        if (!read.ok()) {
            ++refused;
            ASSERT_FALSE(read.error().what.empty());
            continue;
        }
        const PostPlace place = (*read)->place_at(299, 419);
        ASSERT_TRUE(std::abs(place.lat_deg) <= 90.0 && std::abs(place.lon_deg) <= 180.0);
        ASSERT_FALSE(std::isnan((*read)->post_at(46.5, 8.0).row));
    }
    std::printf("seed %u: %d of 600 refused\n", seed, refused);
    EXPECT_GE(refused, 300);
}

}  // namespace
}  // namespace oro
