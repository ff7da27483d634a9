// The checksum of what lies in files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace oro {

// XXH64 of some bytes: tells damage (any flipped bit, but for one case in 2^64), not forgery. The same on
// every machine. `seed` tells alike bytes in different places from each other.
// Source: Y. Collet, xxHash fast digest algorithm, specification 0.1.1, section "XXH64".
[[nodiscard]] std::uint64_t xxh64(std::span<const std::byte> bytes, std::uint64_t seed = 0);

// What an error says of bytes whose checksum is another: "has checksum 0123..., expected 4567...".
[[nodiscard]] std::string other_checksum(std::uint64_t found, std::uint64_t expected);

// Holds bytes whose last eight are the checksum of those before them, little endian, against it: nothing
// where it is right, else what other_checksum() says. There are at least eight bytes.
[[nodiscard]] std::optional<std::string> wrong_checksum(std::span<const std::byte> bytes, std::uint64_t seed);

// The checksum, with seed 0, of bytes that come piece by piece.
class RunningChecksum {
  public:
    RunningChecksum();
    RunningChecksum(const RunningChecksum&) = delete;
    RunningChecksum& operator=(const RunningChecksum&) = delete;
    RunningChecksum(RunningChecksum&&) noexcept;
    RunningChecksum& operator=(RunningChecksum&&) noexcept;
    ~RunningChecksum();
    void add(std::span<const std::byte> bytes);
    // The checksum of all that was added so far.
    [[nodiscard]] std::uint64_t sum() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace oro
