#include "core/frame/visibility_feedback.h"

#include <algorithm>
#include <utility>

namespace oro {
namespace {

constexpr int side = static_cast<int>(gpu::meshlets_per_side);

std::tuple<int, int, int> key_of(const PageIndex& page) {
    return {page.level, page.row, page.column};
}

// A page's rows of bits, from eight words of them.
std::array<std::uint16_t, gpu::meshlets_per_side> rows_of(std::span<const gpu::uint> words) {
    std::array<std::uint16_t, gpu::meshlets_per_side> rows{};
    for (std::size_t i = 0; i < rows.size(); ++i)
        rows[i] = static_cast<std::uint16_t>(words[i / 2] >> (i % 2 * 16));
    return rows;
}

}  // namespace

bool is_same_view(const gpu::FrameConstants& one, const gpu::FrameConstants& other) {
    return one.width_px == other.width_px && one.height_px == other.height_px &&
           one.first_x_px == other.first_x_px && one.first_y_px == other.first_y_px &&
           one.projection_scale == other.projection_scale && one.view_from_ecef == other.view_from_ecef &&
           one.eye_high == other.eye_high && one.eye_low == other.eye_low && one.tau_px == other.tau_px;
}

// Adds bits to a page's, and the page to those above it.
void VisibilityFeedback::mark(Nodes& nodes, const PageIndex& page, const Bits& bits) const {
    if (std::ranges::all_of(bits, [](std::uint16_t row) { return row == 0; })) return;
    Bits& to = nodes.bits[key_of(page)];
    for (std::size_t i = 0; i < bits.size(); ++i) to[i] = static_cast<std::uint16_t>(to[i] | bits[i]);
    PageIndex above = page;
    while (nodes.below.insert(key_of(above)).second && above.level + 1 < pages_->levels())
        above = {above.row / 2, above.column / 2, above.level + 1};
}

// Nodes and those around them: in the pages beside, too.
void VisibilityFeedback::mark_grown(Nodes& nodes, const PageIndex& page, const Bits& bits) const {
    std::array<std::uint32_t, side + 2> grown{};  // from row and column -1 on
    for (int row = 0; row < side; ++row) {
        const std::uint32_t own = std::uint32_t{bits[static_cast<std::size_t>(row)]} << 1U;
        const std::uint32_t wide = own | own << 1U | own >> 1U;
        for (int i = row; i < row + 3; ++i) grown[static_cast<std::size_t>(i)] |= wide;
    }
    const PageLayout layout = pages_->layout(page.level);
    for (int down = -1; down <= 1; ++down)
        for (int right = -1; right <= 1; ++right) {
            PageIndex neighbour{page.row + down, page.column + right, page.level};
            if (pages_->wraps_longitude())
                neighbour.column = (neighbour.column + layout.columns) % layout.columns;
            if (neighbour.row < 0 || neighbour.row >= layout.rows || neighbour.column < 0 ||
                neighbour.column >= layout.columns)
                continue;
            Bits part{};
            for (int row = 0; row < side; ++row) {
                const int from = row + down * side + 1;
                if (from < 0 || from >= side + 2) continue;
                const std::uint32_t own = grown[static_cast<std::size_t>(from)];
                const std::uint32_t moved = right < 0   ? (own & 1U) << static_cast<unsigned>(side - 1)
                                            : right > 0 ? own >> static_cast<unsigned>(side + 1)
                                                        : own >> 1U;
                part[static_cast<std::size_t>(row)] = static_cast<std::uint16_t>(moved);
            }
            mark(nodes, neighbour, part);
        }
}

bool VisibilityFeedback::any_over(const Nodes& nodes, const PageIndex& page) const {
    if (nodes.below.contains(key_of(page))) return true;
    PageIndex above{page.row / 2, page.column / 2, page.level + 1};
    int size = side / 2, first_row = page.row % 2 * size, first_column = page.column % 2 * size;
    while (above.level < pages_->levels()) {
        const auto found = nodes.bits.find(key_of(above));
        const int count = std::max(1, size);
        const std::uint32_t mask = ((1U << static_cast<unsigned>(count)) - 1U)
                                   << static_cast<unsigned>(first_column);
        for (int row = first_row; found != nodes.bits.end() && row < first_row + count; ++row)
            if ((found->second[static_cast<std::size_t>(row)] & mask) != 0) return true;
        first_row = (above.row % 2 * side + first_row) / 2;
        first_column = (above.column % 2 * side + first_column) / 2;
        size /= 2;
        above = {above.row / 2, above.column / 2, above.level + 1};
    }
    return false;
}

bool VisibilityFeedback::add(const FrameFeedback& feedback) {
    if (feedback.pages.empty()) return false;
    if (!is_same_view(feedback.view, last_)) {
        last_ = feedback.view;
        hidden_.clear();
        if (++views_ > views_kept) {
            were_hidden_.clear();
            came_back_.clear();
            views_ = 1;
        }
    }
    const Nodes asked = std::exchange(asked_, {}), shown = std::exchange(shown_, {}),
                finer = std::exchange(finer_, {});
    const std::map<Key, bool> drawn = std::exchange(drawn_, {});
    const std::size_t hidden = hidden_.size();
    for (std::size_t i = 0; i < feedback.pages.size(); ++i) {
        const std::span words =
            std::span(feedback.words).subspan(i * gpu::feedback_words, gpu::feedback_words);
        mark(asked_, feedback.pages[i], rows_of(words.first(gpu::accepted_words)));
        mark_grown(shown_, feedback.pages[i],
                   rows_of(words.subspan(gpu::accepted_words, gpu::accepted_words)));
        mark_grown(finer_, feedback.pages[i], rows_of(words.last(gpu::accepted_words)));
    }
    for (const auto& [key, bits] : shown_.bits) drawn_[key] = false;
    for (const PageIndex& page : feedback.pages)
        if (const auto found = drawn_.find(key_of(page)); found != drawn_.end()) found->second = true;
    if (shown_.bits != shown.bits || drawn_ != drawn) hidden_.clear();
    for (const PageIndex& page : feedback.pages)
        if (any_over(asked_, page) && !any_over(shown_, page) && !any_over(finer_, page))
            hidden_.insert(key_of(page));
    return asked_.bits != asked.bits || shown_.bits != shown.bits || finer_.bits != finer.bits ||
           drawn_ != drawn || hidden_.size() != hidden;
}

bool VisibilityFeedback::is_hidden(const PageIndex& page) {
    const Key key = key_of(page);
    if (came_back_.contains(key)) return false;
    if (any_over(shown_, page)) {
        if (were_hidden_.contains(key)) came_back_.insert(key);
        return false;
    }
    if (!hidden_.contains(key) && (any_over(finer_, page) || !any_over(asked_, page))) return false;
    were_hidden_.insert(key);
    return true;
}

}  // namespace oro
