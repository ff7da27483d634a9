#include "core/baked/page_compression.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <string>

#include "core/base/checksum.h"
#include "core/base/little_endian.h"
#include "core/terrain/post_grid.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text));
}

std::unique_ptr<PagePayload> filled(float H_m) {
    auto payload = std::make_unique<PagePayload>();
    payload->H_m.fill(H_m);
    payload->error_m.fill(0.0F);
    payload->lod_radius_m.fill(0.0F);
    return payload;
}

// Bytes it takes, after it came back to the bit.
std::size_t round_trip(const PagePayload& payload) {
    const std::vector<std::byte> bytes = encode_payload(payload).value();
    EXPECT_LE(bytes.size(), largest_payload_bytes);
    const auto back = filled(1.0F);
    const auto wrong = decode_payload(bytes, *back);
    EXPECT_FALSE(wrong) << *wrong;
    EXPECT_EQ(std::memcmp(back.get(), &payload, sizeof(PagePayload)), 0);
    return bytes.size();
}

TEST(Checksum, IsThatOfTheSpecification) {
    // Source: what xxhsum -H64 (xxHash 0.8) says of these texts.
    EXPECT_EQ(xxh64({}), 0xef46db3751d8e999U);
    EXPECT_EQ(xxh64(bytes_of("a")), 0xd24ec4f1a98c6e5bU);
    EXPECT_EQ(xxh64(bytes_of("abc")), 0x44bc2cf5ad770999U);
    // Longer than one round of 32 bytes.
    EXPECT_EQ(xxh64(bytes_of("Nobody inspects the spammish repetition")), 0xfbcea83c8a378bf1U);
}

TEST(LittleEndian, PutsTheLowestByteFirst) {
    std::array<std::byte, 4> bytes{};
    to_little_endian(std::uint32_t{0x01020304}, bytes.data());
    EXPECT_EQ(bytes, (std::array{std::byte{4}, std::byte{3}, std::byte{2}, std::byte{1}}));
    to_little_endian(-2.0F, bytes.data());  // 0xc0000000 by IEEE 754
    EXPECT_EQ(bytes, (std::array{std::byte{0}, std::byte{0}, std::byte{0}, std::byte{0xc0}}));
    EXPECT_EQ(from_little_endian<float>(bytes.data()), -2.0F);
    EXPECT_EQ(from_little_endian<std::int16_t>(bytes.data() + 2), -16384);
}

TEST(HeightCodec, AVoidPageCostsAlmostNothing) {
    EXPECT_LE(round_trip(*filled(void_height_m)), 64U);
    EXPECT_LE(round_trip(*filled(0.0F)), 64U);
}

TEST(HeightCodec, BringsBackExtremesToTheBit) {
    const float odd[] = {-0.0F,
                         0.0F,
                         32767.0F,
                         -32768.0F,
                         32768.0F,
                         -32769.0F,
                         1.0e-45F,
                         -1.0e-45F,
                         std::numeric_limits<float>::min(),
                         std::numeric_limits<float>::max(),
                         std::nextafter(void_height_m, 0.0F),
                         0.1F,
                         8848.86F,
                         1.0e30F,
                         void_height_m};
    for (const float H_m : odd) {
        round_trip(*filled(H_m));
        auto payload = filled(100.0F);  // one among whole metres, one at each end
        payload->H_m.front() = payload->H_m[9000] = payload->H_m.back() = H_m;
        round_trip(*payload);
    }
    auto payload = filled(0.0F);
    for (std::size_t i = 0; i < payload->H_m.size(); ++i)
        payload->H_m[i] = i % 2 == 0 ? 32767.0F : (i % 3 == 0 ? void_height_m : -32768.0F);
    round_trip(*payload);
    for (std::size_t i = 0; i < payload->H_m.size(); ++i) payload->H_m[i] = odd[i % std::size(odd)];
    round_trip(*payload);
}

TEST(HeightCodec, KeepsWholeMetresOfMountainsInABytePerPost) {
    auto payload = filled(0.0F);
    for (std::size_t i = 0; i < payload->H_m.size(); ++i) {
        const double lat_deg = 47.0 - static_cast<double>(i / 131) / 1200.0;
        const double lon_deg = 8.0 + static_cast<double>(i % 131) / 1200.0;
        payload->H_m[i] = std::round(test::rough_H_m(lat_deg, lon_deg));
    }
    EXPECT_LE(round_trip(*payload), gpu::page_heights);
}

TEST(HeightCodec, BringsBackAnyFiniteNumbers) {
    const unsigned seed = 4711;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    const auto any_bits = [&] {
        for (;;) {
            const auto number = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
            if (std::isfinite(number)) return number;
        }
    };
    for (int run = 0; run < 200; ++run) {
        auto payload = filled(0.0F);
        const auto kind = random() % 4;
        const auto void_share = random() % 3 == 0 ? random() % 101 : 0;
        for (float& H_m : payload->H_m) {
            if (kind == 0) H_m = any_bits();
            if (kind == 1) H_m = static_cast<float>(static_cast<std::int16_t>(random()));
            if (kind == 2)
                H_m = static_cast<float>(random() % 5000) + static_cast<float>(random() % 16) / 16.0F;
            if (kind == 3) H_m = static_cast<float>(random() % 100);
            if (random() % 100 < void_share) H_m = void_height_m;
        }
        for (float& error_m : payload->error_m) error_m = any_bits();
        for (float& radius_m : payload->lod_radius_m) radius_m = any_bits();
        round_trip(*payload);
        if (HasFailure()) FAIL() << "in run " << run;
    }
}

TEST(HeightCodec, RefusesWhatIsNoPayload) {
    const auto payload = filled(12.0F);
    EXPECT_EQ(decode_payload({}, *payload), "is empty");
    for (const unsigned kind : {3U, 4U, 7U, 8U, 255U}) {
        std::vector<std::byte> bytes = encode_payload(*payload).value();
        bytes[0] = static_cast<std::byte>(kind);
        EXPECT_TRUE(decode_payload(bytes, *payload)) << kind;
    }
    std::vector<std::byte> bytes = encode_payload(*filled(12.0F)).value();
    bytes[0] = std::byte{2};  // floats: twice the bytes
    const auto wrong = decode_payload(bytes, *payload);
    ASSERT_TRUE(wrong);
    EXPECT_EQ(*wrong, "unpacks to 36370 bytes, expected 70692");
    for (std::size_t size = 1; size + 1 < bytes.size(); ++size) {
        bytes = encode_payload(*filled(12.0F)).value();
        bytes.resize(size);
        EXPECT_TRUE(decode_payload(bytes, *payload)) << size;
    }
}

TEST(HeightCodec, SurvivesAnyBytes) {
    const unsigned seed = 815;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    auto payload = filled(0.0F);
    for (float& H_m : payload->H_m) H_m = static_cast<float>(random() % 100) + 0.25F;
    const std::vector<std::byte> whole = encode_payload(*payload).value();
    for (int run = 0; run < 2000; ++run) {
        std::vector<std::byte> bytes = whole;
        for (auto flips = random() % 4 + 1; flips > 0; --flips)
            bytes[random() % bytes.size()] ^= static_cast<std::byte>(1U << (random() % 8));
        if (decode_payload(bytes, *payload)) continue;
        for (const float H_m : payload->H_m) ASSERT_TRUE(std::isfinite(H_m));
    }
}

}  // namespace
}  // namespace oro
