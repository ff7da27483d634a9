#include "core/frame/visibility_feedback.h"

#include <algorithm>
#include <utility>

namespace oro {
namespace {

constexpr int side = static_cast<int>(gpu::meshlets_per_side);

// A page's rows of bits, from eight words of them.
std::array<std::uint16_t, gpu::meshlets_per_side> rows_of(std::span<const gpu::uint> words) {
    std::array<std::uint16_t, gpu::meshlets_per_side> rows{};
    for (std::size_t i = 0; i < rows.size(); ++i)
        rows[i] = static_cast<std::uint16_t>(words[i / 2] >> (i % 2 * 16));
    return rows;
}

bool any_of(const std::array<std::uint16_t, gpu::meshlets_per_side>& bits) {
    std::uint32_t all = 0;
    for (const std::uint16_t row : bits) all |= row;
    return all != 0;
}

}  // namespace

bool is_same_view(const gpu::FrameConstants& one, const gpu::FrameConstants& other) {
    return one.width_px == other.width_px && one.height_px == other.height_px &&
           one.first_x_px == other.first_x_px && one.first_y_px == other.first_y_px &&
           one.projection_scale == other.projection_scale && one.view_from_ecef == other.view_from_ecef &&
           one.eye_high == other.eye_high && one.eye_low == other.eye_low && one.tau_px == other.tau_px;
}

void PageSet::clear() {
    for (PageTable& level : levels_) level.clear();
    pages_.clear();
}

std::uint32_t PageSet::find(const PageIndex& page) const {
    const auto level = static_cast<std::size_t>(page.level);
    return level < levels_.size() ? levels_[level].find(page.row, page.column) : PageTable::none;
}

std::pair<std::uint32_t, bool> PageSet::number_of(const PageIndex& page) {
    const auto level = static_cast<std::size_t>(page.level);
    if (levels_.size() <= level) levels_.resize(level + 1);
    const std::uint32_t known = levels_[level].find(page.row, page.column);
    if (known != PageTable::none) return {known, false};
    const auto number = static_cast<std::uint32_t>(pages_.size());
    levels_[level].insert(page.row, page.column, number);
    pages_.push_back(page);
    return {number, true};
}

void VisibilityFeedback::Nodes::clear() {
    pages.clear();
    bits.clear();
    below.clear();
}

const VisibilityFeedback::Bits* VisibilityFeedback::Nodes::bits_of(const PageIndex& page) const {
    const std::uint32_t number = pages.find(page);
    return number == PageTable::none ? nullptr : &bits[number];
}

bool VisibilityFeedback::Nodes::is_same(const Nodes& other) const {
    if (pages.size() != other.pages.size()) return false;
    for (std::size_t i = 0; i < pages.size(); ++i) {
        // Mostly in the same order.
        const Bits* const theirs = other.pages[i] == pages[i] ? &other.bits[i] : other.bits_of(pages[i]);
        if (theirs == nullptr || *theirs != bits[i]) return false;
    }
    return true;
}

bool VisibilityFeedback::Seen::is_drawn_same(const Seen& other) const {
    if (shown.pages.size() != other.shown.pages.size()) return false;
    for (std::size_t i = 0; i < shown.pages.size(); ++i) {
        const std::uint32_t theirs = other.shown.pages[i] == shown.pages[i]
                                         ? static_cast<std::uint32_t>(i)
                                         : other.shown.pages.find(shown.pages[i]);
        if (theirs == PageTable::none || other.drawn[theirs] != drawn[i]) return false;
    }
    return true;
}

// Adds bits to a page's, and the page to those above it.
void VisibilityFeedback::mark(Nodes& nodes, const PageIndex& page, const Bits& bits) const {
    if (!any_of(bits)) return;
    const auto [number, is_new] = nodes.pages.number_of(page);
    if (is_new) nodes.bits.emplace_back();
    Bits& to = nodes.bits[number];
    for (std::size_t i = 0; i < bits.size(); ++i) to[i] = static_cast<std::uint16_t>(to[i] | bits[i]);
    if (!is_new) return;
    PageIndex above = page;
    while (nodes.below.insert(above) && above.level + 1 < pages_->levels())
        above = {above.row / 2, above.column / 2, above.level + 1};
}

// Nodes and those around them: in the pages beside, too.
void VisibilityFeedback::mark_grown(Nodes& nodes, const PageIndex& page, const Bits& bits) const {
    if (!any_of(bits)) return;
    std::array<std::uint32_t, side + 2> grown{};  // from row and column -1 on
    for (int row = 0; row < side; ++row) {
        const std::uint32_t own = std::uint32_t{bits[static_cast<std::size_t>(row)]} << 1U;
        const std::uint32_t wide = own | own << 1U | own >> 1U;
        for (int i = row; i < row + 3; ++i) grown[static_cast<std::size_t>(i)] |= wide;
    }
    std::uint32_t columns = 0;
    for (const std::uint32_t row : grown) columns |= row;
    // Whether any of them lie beyond a rim.
    const std::array rows{grown.front() != 0, true, grown.back() != 0};
    const std::array sides{(columns & 1U) != 0, true, (columns >> static_cast<unsigned>(side + 1)) != 0};
    const PageLayout layout = pages_->layout(page.level);
    for (int down = -1; down <= 1; ++down)
        for (int right = -1; right <= 1; ++right) {
            if (!rows[static_cast<std::size_t>(down + 1)] || !sides[static_cast<std::size_t>(right + 1)])
                continue;
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
    if (nodes.below.contains(page)) return true;
    PageIndex above{page.row / 2, page.column / 2, page.level + 1};
    int size = side / 2, first_row = page.row % 2 * size, first_column = page.column % 2 * size;
    while (above.level < pages_->levels()) {
        const Bits* const found = nodes.bits_of(above);
        const int count = std::max(1, size);
        const std::uint32_t mask = ((1U << static_cast<unsigned>(count)) - 1U)
                                   << static_cast<unsigned>(first_column);
        for (int row = first_row; found != nullptr && row < first_row + count; ++row)
            if (((*found)[static_cast<std::size_t>(row)] & mask) != 0) return true;
        first_row = (above.row % 2 * side + first_row) / 2;
        first_column = (above.column % 2 * side + first_column) / 2;
        size /= 2;
        above = {above.row / 2, above.column / 2, above.level + 1};
    }
    return false;
}

void VisibilityFeedback::find_seen(const FrameFeedback& feedback) {
    seen_.asked.clear();
    seen_.shown.clear();
    seen_.finer.clear();
    for (std::size_t i = 0; i < feedback.pages.size(); ++i) {
        const std::span words =
            std::span(feedback.words).subspan(i * gpu::feedback_words, gpu::feedback_words);
        mark(seen_.asked, feedback.pages[i], rows_of(words.first(gpu::accepted_words)));
        mark_grown(seen_.shown, feedback.pages[i],
                   rows_of(words.subspan(gpu::accepted_words, gpu::accepted_words)));
        mark_grown(seen_.finer, feedback.pages[i], rows_of(words.last(gpu::accepted_words)));
    }
    seen_.drawn.assign(seen_.shown.pages.size(), 0);
    for (const PageIndex& page : feedback.pages)
        if (const std::uint32_t found = seen_.shown.pages.find(page); found != PageTable::none)
            seen_.drawn[found] = 1;
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
    std::swap(seen_, before_);
    find_seen(feedback);
    const std::size_t hidden = hidden_.size();
    const bool shows_same = seen_.shown.is_same(before_.shown), is_drawn_same = seen_.is_drawn_same(before_);
    if (!shows_same || !is_drawn_same) hidden_.clear();
    for (const PageIndex& page : feedback.pages)
        if (any_over(seen_.asked, page) && !any_over(seen_.shown, page) && !any_over(seen_.finer, page))
            hidden_.insert(page);
    return !shows_same || !is_drawn_same || hidden_.size() != hidden || !seen_.asked.is_same(before_.asked) ||
           !seen_.finer.is_same(before_.finer);
}

bool VisibilityFeedback::is_hidden(const PageIndex& page) {
    if (seen_.asked.pages.size() == 0 && seen_.shown.pages.size() == 0 && hidden_.size() == 0) return false;
    if (came_back_.contains(page)) return false;
    if (any_over(seen_.shown, page)) {
        if (were_hidden_.contains(page)) came_back_.insert(page);
        return false;
    }
    if (!hidden_.contains(page) && (any_over(seen_.finer, page) || !any_over(seen_.asked, page)))
        return false;
    were_hidden_.insert(page);
    return true;
}

}  // namespace oro
