#include "core/cluster_file/range_coder.h"

#include <cassert>
#include <utility>

namespace oro {
namespace {

constexpr std::uint32_t least_range = 1U << 24U;
// Larger numbers are coded in two parts.
constexpr std::uint32_t part_bits = 16;
constexpr std::uint32_t largest_part = 1U << part_bits;

template <class Coder>
std::uint32_t in_two_parts(Coder& coder, std::uint32_t count, std::uint32_t value) {
    const std::uint32_t high = coder.uniform(((count - 1) >> part_bits) + 1, value >> part_bits);
    const bool last = high == (count - 1) >> part_bits;
    const std::uint32_t low = coder.uniform(last ? ((count - 1) & (largest_part - 1)) + 1 : largest_part,
                                            value & (largest_part - 1));
    return (high << part_bits) | low;
}

}  // namespace

void RangeEncoder::put_byte() {
    const bool carry = low_ > 0xffffffffU;
    if (carry || low_ < 0xff000000U) {
        if (any_) bytes_.push_back(static_cast<std::byte>((waiting_ + (carry ? 1U : 0U)) & 0xffU));
        for (; waiting_count_ > 0; --waiting_count_) bytes_.push_back(carry ? std::byte{0} : std::byte{0xff});
        any_ = true;
        waiting_ = static_cast<std::uint8_t>(low_ >> 24U);
    } else {
        ++waiting_count_;
    }
    low_ = (low_ << 8U) & 0xffffffffU;
}

void RangeEncoder::keep_range_large() {
    while (range_ < least_range) {
        put_byte();
        range_ <<= 8U;
    }
}

bool RangeEncoder::bit(AdaptiveBit& likely, bool value) {
    const std::uint32_t of_one = (range_ >> 16U) * likely.one();
    if (value) {
        range_ = of_one;
    } else {
        low_ += of_one;
        range_ -= of_one;
    }
    likely.learn(value);
    keep_range_large();
    return value;
}

std::uint32_t RangeEncoder::uniform(std::uint32_t count, std::uint32_t value) {
    assert(value < count);
    if (count > largest_part) return in_two_parts(*this, count, value);
    const std::uint32_t each = range_ / count;
    low_ += std::uint64_t{each} * value;
    range_ = each;
    keep_range_large();
    return value;
}

std::vector<std::byte> RangeEncoder::finish() {
    for (int i = 0; i < 5; ++i) put_byte();
    return std::move(bytes_);
}

RangeDecoder::RangeDecoder(std::span<const std::byte> bytes) : bytes_(bytes) {
    for (int i = 0; i < 4; ++i) code_ = (code_ << 8U) | next_byte();
}

std::uint32_t RangeDecoder::next_byte() {
    if (next_ < bytes_.size()) return std::to_integer<std::uint32_t>(bytes_[next_++]);
    wrong_ = true;
    return 0;
}

void RangeDecoder::keep_range_large() {
    while (range_ < least_range) {
        code_ = (code_ << 8U) | next_byte();
        range_ <<= 8U;
    }
}

bool RangeDecoder::bit(AdaptiveBit& likely, bool) {
    const std::uint32_t of_one = (range_ >> 16U) * likely.one();
    const bool value = code_ < of_one;
    if (value) {
        range_ = of_one;
    } else {
        code_ -= of_one;
        range_ -= of_one;
    }
    likely.learn(value);
    keep_range_large();
    return value;
}

std::uint32_t RangeDecoder::uniform(std::uint32_t count, std::uint32_t) {
    if (count > largest_part) return in_two_parts(*this, count, 0);
    const std::uint32_t each = range_ / count;
    std::uint32_t value = code_ / each;
    if (value >= count) {
        value = count - 1;
        wrong_ = true;
    }
    code_ -= each * value;
    range_ = each;
    keep_range_large();
    return value;
}

}  // namespace oro
