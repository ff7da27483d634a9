#include "core/high_low.h"

#include <bit>
#include <cstdint>

namespace oro {
namespace {

// The bits of a double's mantissa that a float has no room for.
constexpr std::uint64_t beyond_float = (std::uint64_t{1} << 29U) - 1U;

// Cut in the bits rather than by a round trip through float: GCC 12's vectoriser takes v - double(float(v))
// for 0.
double leading_bits(double value) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) & ~beyond_float);
}

}  // namespace

void split_high_low(const glm::dvec3& value, gpu::vec3& high, gpu::vec3& low) {
    const glm::dvec3 leading(leading_bits(value.x), leading_bits(value.y), leading_bits(value.z));
    high = gpu::vec3(leading);
    low = gpu::vec3(value - leading);
}

}  // namespace oro
