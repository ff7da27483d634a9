// Whole numbers for a range coder (core/cluster_file/range_coder.h), either way.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/cluster_file/range_coder.h"

namespace oro {

// Numbers that are small most of the time, and how small is learned.
class SmallNumber {
  public:
    template <class Coder>
    std::uint32_t code(Coder& coder, std::uint32_t value = 0) {
        const auto width_there = static_cast<std::uint32_t>(std::bit_width(value));
        std::uint32_t width = 0;
        while (width < 32 && coder.bit(longer_[width], width_there > width)) ++width;
        if (width < 2) return width;
        const std::uint32_t half = 1U << (width - 2);
        const bool upper = coder.bit(upper_[width], (value & half) != 0);
        const std::uint32_t rest = half > 1 ? coder.uniform(half, value & (half - 1)) : 0;
        return (1U << (width - 1)) | (upper ? half : 0U) | rest;
    }

  private:
    std::array<AdaptiveBit, 32> longer_;
    std::array<AdaptiveBit, 33> upper_;
};

// The same for numbers of either sign near 0.
class NearZero {
  public:
    template <class Coder>
    std::int32_t code(Coder& coder, std::int32_t value = 0) {
        const auto bits = static_cast<std::uint32_t>(value);
        const std::uint32_t folded = folded_.code(coder, (bits << 1U) ^ (value < 0 ? ~0U : 0U));
        return static_cast<std::int32_t>((folded >> 1U) ^ ((folded & 1U) != 0 ? ~0U : 0U));
    }

  private:
    SmallNumber folded_;
};

// 0 .. 15, each as likely as it was so far.
class FewNumbers {
  public:
    // bits: 1 .. 4, the same at each call.
    template <class Coder>
    std::uint32_t code(Coder& coder, std::uint32_t bits, std::uint32_t value = 0) {
        std::uint32_t node = 1;
        for (std::uint32_t i = bits; i-- > 0;)
            node = 2 * node + (coder.bit(nodes_[node], ((value >> i) & 1U) != 0) ? 1U : 0U);
        return node - (1U << bits);
    }

  private:
    std::array<AdaptiveBit, 16> nodes_;
};

}  // namespace oro
