// Numbers in fewer bits than they have: what is likely takes less than a bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace oro {

// How likely a bit is 1, learned from those before it. Both sides learn alike.
class AdaptiveBit {
  public:
    // Of 2^16; never 0, never all.
    [[nodiscard]] std::uint32_t one() const { return one_; }
    void learn(bool bit) {
        const int target = bit ? 65536 : 0;
        one_ = static_cast<std::uint16_t>(one_ + (target - static_cast<int>(one_)) / (seen_ + 2));
        if (seen_ < most_seen) ++seen_;
    }

  private:
    // After so many bits the last ones count more than those long ago.
    static constexpr std::uint8_t most_seen = 60;
    std::uint16_t one_{32768};
    std::uint8_t seen_{};
};

// Binary range coder with carry. Source: G. N. N. Martin, Range encoding: an algorithm for removing
// redundancy from a digitised message, 1979; the carry is kept as in I. Pavlov, LZMA specification, 2015.
//
// RangeEncoder and RangeDecoder have the same functions, so that one text says how something is coded both
// ways: given a number, the encoder writes it; the decoder gives what was written, whatever it is given.
class RangeEncoder {
  public:
    static constexpr bool writes = true;
    bool bit(AdaptiveBit& likely, bool value);
    // 0 .. count - 1, all as likely; count: 1 .. 2^32 - 1.
    std::uint32_t uniform(std::uint32_t count, std::uint32_t value);
    // The bytes that no later one changes, but those that were taken before.
    [[nodiscard]] std::vector<std::byte> take() { return std::exchange(bytes_, {}); }
    // All bytes that were not taken; the encoder is then of no use.
    [[nodiscard]] std::vector<std::byte> finish();

  private:
    void keep_range_large();
    void put_byte();

    std::uint64_t low_{};
    std::uint32_t range_{0xffffffffU};
    std::uint8_t waiting_{};         // a byte that a carry may change
    std::uint64_t waiting_count_{};  // with those after it, all 0xff
    bool any_{};
    std::vector<std::byte> bytes_;
};

class RangeDecoder {
  public:
    static constexpr bool writes = false;
    explicit RangeDecoder(std::span<const std::byte> bytes);
    bool bit(AdaptiveBit& likely, bool unused = false);
    std::uint32_t uniform(std::uint32_t count, std::uint32_t unused = 0);
    // More was asked for than the bytes hold, or they are none that an encoder writes. Numbers are then of
    // no use, but in their ranges.
    [[nodiscard]] bool is_wrong() const { return wrong_; }
    // All bytes were asked for.
    [[nodiscard]] bool at_end() const { return next_ == bytes_.size(); }

  private:
    void keep_range_large();
    std::uint32_t next_byte();

    std::span<const std::byte> bytes_;
    std::size_t next_{};
    std::uint32_t range_{0xffffffffU};
    std::uint32_t code_{};
    bool wrong_{};
};

}  // namespace oro
