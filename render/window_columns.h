// Which columns of a picture go into which columns of a window: pure, tested without a device.
#pragma once

#include <cstdint>

namespace oro {

// Columns [from_px, from_end_px) of a picture, scaled to columns [to_px, to_end_px) of a window. Either may
// be empty: then nothing is shown.
struct ShownColumns {
    std::int32_t from_px{}, from_end_px{};
    std::int32_t to_px{}, to_end_px{};
    [[nodiscard]] bool is_empty() const { return from_px >= from_end_px || to_px >= to_end_px; }
    bool operator==(const ShownColumns&) const = default;
};

// Of a picture that is picture_px wide, in a window of window_px, in the window's columns [to_px, to_end_px).
// is_of_whole_window: it shows what lies there of a picture that is scaled to the whole window; a border
// between two of its pixels is rounded to the nearer one. Otherwise all of it is scaled to these columns.
inline ShownColumns shown_columns(std::uint32_t picture_px, std::uint32_t window_px, std::uint32_t to_px,
                                  std::uint32_t to_end_px, bool is_of_whole_window) {
    ShownColumns shown{0, static_cast<std::int32_t>(picture_px), static_cast<std::int32_t>(to_px),
                       static_cast<std::int32_t>(to_end_px)};
    if (!is_of_whole_window || window_px == 0) return shown;
    const auto at = [&](std::uint32_t column) {
        const std::uint64_t twice = 2 * static_cast<std::uint64_t>(column) * picture_px + window_px;
        return static_cast<std::int32_t>(twice / (2 * static_cast<std::uint64_t>(window_px)));
    };
    shown.from_px = at(to_px);
    shown.from_end_px = at(to_end_px);
    return shown;
}

}  // namespace oro
