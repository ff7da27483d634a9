#include "geo/measures/stored_values.h"

#include <algorithm>

namespace oro {

std::uint64_t posts_in(const std::vector<PostWindow>& windows) {
    // Between two neighbouring borders of windows, rows are all alike.
    std::vector<int> borders;
    for (const PostWindow& window : windows)
        borders.insert(borders.end(), {window.row, window.row + window.rows});
    std::ranges::sort(borders);
    std::uint64_t posts = 0;
    for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
        std::vector<std::pair<int, int>> spans;
        for (const PostWindow& window : windows) {
            if (window.row <= borders[i] && borders[i] < window.row + window.rows)
                spans.emplace_back(window.column, window.column + window.columns);
        }
        std::ranges::sort(spans);
        int end = 0;
        std::uint64_t columns = 0;
        for (const auto& [first, last] : spans) {
            if (last > end) columns += static_cast<std::uint64_t>(last - std::max(first, end));
            end = std::max(end, last);
        }
        posts += columns * static_cast<std::uint64_t>(borders[i + 1] - borders[i]);
    }
    return posts;
}

void StoredValues::add(const PostBlock& block) {
    windows_.push_back(block.window);
    seen_.lowest_stored_m = std::min(seen_.lowest_stored_m, block.lowest_stored_m);
    seen_.highest_stored_m = std::max(seen_.highest_stored_m, block.highest_stored_m);
}

std::optional<StoredRange> StoredValues::range(int rows, int columns) const {
    if (seen_.lowest_stored_m > seen_.highest_stored_m) return std::nullopt;
    return StoredRange{
        seen_.lowest_stored_m, seen_.highest_stored_m,
        posts_in(windows_) == static_cast<std::uint64_t>(rows) * static_cast<std::uint64_t>(columns)};
}

}  // namespace oro
