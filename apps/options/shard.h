// A part of a list that several machines do together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/result.h"

namespace oro {

// Of things that are numbered from 0, every `count`th from number - 1 on: each thing is in one of the parts 1
// to `count`, whoever asks.
struct Shard {
    std::int64_t number{1};
    std::int64_t count{1};

    [[nodiscard]] bool holds(std::size_t index) const {
        return static_cast<std::int64_t>(index % static_cast<std::size_t>(count)) == number - 1;
    }
    [[nodiscard]] bool is_whole() const { return count == 1; }
};

// A whole list may be cut into so many parts.
inline constexpr std::int64_t most_shards = 1'000'000;

// Of "2/4", the text of --shard; "" is the whole. Errors (usage): text that is no such part.
Result<Shard> parse_shard(const std::string& text);
// How a part's own file is told from the whole's: "-2of4"; "" of the whole.
std::string shard_suffix(const Shard& shard);

}  // namespace oro
