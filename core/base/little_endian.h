// Numbers as they lie in files: least significant byte first, on every machine.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

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

// Appends numbers to `bytes`. A function template that shows it a struct's fields, visit(field), can show
// them to a NumberReader, too: so their order is written down once for both ways.
class NumberWriter {
  public:
    static constexpr bool writes = true;
    template <class T>
    void operator()(const T& number) {
        std::array<std::byte, sizeof(T)> lying;
        to_little_endian(number, lying.data());
        bytes.insert(bytes.end(), lying.begin(), lying.end());
    }
    std::vector<std::byte> bytes;
};

// Reads numbers one after another out of bytes that it does not own. Beyond their end it gives zeros and
// remembers that it did.
class NumberReader {
  public:
    static constexpr bool writes = false;
    explicit NumberReader(std::span<const std::byte> bytes) : bytes_(bytes) {}
    template <class T>
    void operator()(T& number) {
        if (bytes_.size() < sizeof(T)) {
            fail();
            number = T{};
            return;
        }
        number = from_little_endian<T>(bytes_.data());
        bytes_ = bytes_.subspan(sizeof(T));
    }
    // The bytes that are not read yet.
    [[nodiscard]] std::span<const std::byte> rest() const { return bytes_; }
    // True where so many things of so many bytes each may follow.
    [[nodiscard]] bool has(std::uint64_t count, std::size_t each) const {
        return count <= bytes_.size() / each;
    }
    // What was read is not what was meant.
    void fail() { failed_ = true; }
    // True unless all bytes were read, and no more than all.
    [[nodiscard]] bool is_wrong() const { return failed_ || !bytes_.empty(); }

  private:
    std::span<const std::byte> bytes_;
    bool failed_{false};
};

}  // namespace oro
