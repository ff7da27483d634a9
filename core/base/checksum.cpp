#include "core/base/checksum.h"

#include <cstdio>

// All of xxHash is compiled into this file: a benchmark carries it to machines that lack the library.
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "core/base/little_endian.h"

namespace oro {

std::uint64_t xxh64(std::span<const std::byte> bytes, std::uint64_t seed) {
    return XXH64(bytes.data(), bytes.size(), seed);
}

std::string other_checksum(std::uint64_t found, std::uint64_t expected) {
    char text[80];
    std::snprintf(text, sizeof(text), "has checksum %016llx, expected %016llx",
                  static_cast<unsigned long long>(found), static_cast<unsigned long long>(expected));
    return text;
}

std::optional<std::string> wrong_checksum(std::span<const std::byte> bytes, std::uint64_t seed) {
    const std::size_t without = bytes.size() - 8;
    const auto stored = from_little_endian<std::uint64_t>(&bytes[without]);
    const std::uint64_t computed = xxh64(bytes.first(without), seed);
    if (computed == stored) return std::nullopt;
    return other_checksum(computed, stored);
}

struct RunningChecksum::State {
    XXH64_state_t xxh;
};

RunningChecksum::RunningChecksum() : state_(std::make_unique<State>()) {
    XXH64_reset(&state_->xxh, 0);
}

RunningChecksum::RunningChecksum(RunningChecksum&&) noexcept = default;
RunningChecksum& RunningChecksum::operator=(RunningChecksum&&) noexcept = default;
RunningChecksum::~RunningChecksum() = default;

void RunningChecksum::add(std::span<const std::byte> bytes) {
    if (!bytes.empty()) XXH64_update(&state_->xxh, bytes.data(), bytes.size());
}

std::uint64_t RunningChecksum::sum() const {
    return XXH64_digest(&state_->xxh);
}

}  // namespace oro
