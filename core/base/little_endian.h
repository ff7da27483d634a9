// Numbers as they lie in files: least significant byte first, on every machine.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace oro {

// The unsigned number of as many bits as T, which may be a number of any kind.
template <class T>
using BitsOf =
    std::conditional_t<sizeof(T) == 8, std::uint64_t,
                       std::conditional_t<sizeof(T) == 4, std::uint32_t,
                                          std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint8_t>>>;

template <class T>
[[nodiscard]] T from_little_endian(const std::byte* bytes) {
    static_assert(std::is_arithmetic_v<T>);
    BitsOf<T> bits{};
    if constexpr (std::endian::native == std::endian::little) {
        std::memcpy(&bits, bytes, sizeof(bits));
    } else {
        for (std::size_t i = sizeof(bits); i-- > 0;)
            bits = static_cast<BitsOf<T>>((std::uint64_t{bits} << 8) | static_cast<std::uint64_t>(bytes[i]));
    }
    return std::bit_cast<T>(bits);
}

template <class T>
void to_little_endian(T number, std::byte* bytes) {
    static_assert(std::is_arithmetic_v<T>);
    const auto bits = std::bit_cast<BitsOf<T>>(number);
    for (std::size_t i = 0; i < sizeof(bits); ++i)
        bytes[i] = static_cast<std::byte>((std::uint64_t{bits} >> (8 * i)) & 0xffU);
}

}  // namespace oro
