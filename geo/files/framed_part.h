// How a part of an output that is kept holds what is told of it beside its bytes.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "geo/files/kept_parts.h"

namespace oro {

// Names what a frame is of, eight letters: another name for another Facts.
using FrameName = std::array<char, 8>;

template <class Facts>
struct FramedPart {
    Facts facts;
    std::vector<std::uint8_t> bytes;
};

template <class Facts>
struct FrameHead {
    FrameName frame;
    std::uint64_t bytes;
    Facts facts;
};

// A part of that name with its facts, as they lie in memory of this machine. Nothing where it is not there.
// Errors (failed): a file that is no such frame, or was cut; what the system says.
template <class Facts>
Result<std::optional<FramedPart<Facts>>> read_framed(const KeptParts& parts, const std::string& name,
                                                     const FrameName& frame) {
    static_assert(std::is_trivially_copyable_v<Facts>);
    ORO_TRY(const auto read, parts.read(name));
    if (!read) return std::optional<FramedPart<Facts>>();
    FrameHead<Facts> head{};
    if (read->size() >= sizeof head) std::memcpy(&head, read->data(), sizeof head);
    if (read->size() < sizeof head || head.frame != frame || head.bytes != read->size() - sizeof head)
        return Error{ErrorKind::failed, parts.path_of(name), "is no tile of an export: remove it"};
    return std::optional(FramedPart<Facts>{head.facts, {read->begin() + sizeof head, read->end()}});
}

// Errors (failed): what the system says.
template <class Facts>
Result<void> write_framed(const KeptParts& parts, const std::string& name, const FrameName& frame,
                          const Facts& facts, std::span<const std::uint8_t> bytes) {
    static_assert(std::is_trivially_copyable_v<Facts>);
    const FrameHead<Facts> head{frame, bytes.size(), facts};
    std::vector<std::uint8_t> all(sizeof head);
    std::memcpy(all.data(), &head, sizeof head);
    all.insert(all.end(), bytes.begin(), bytes.end());
    return parts.write(name, all);
}

}  // namespace oro
