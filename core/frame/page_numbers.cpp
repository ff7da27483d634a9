#include "core/frame/page_numbers.h"

#include <algorithm>

namespace oro {

PageNumbers::PageNumbers(const RegionPages& pages) : first_page_{0}, first_row_{0}, first_column_{0} {
    for (int level = 0; level < pages.levels(); ++level) {
        const PageLayout layout = pages.layout(level);
        layouts_.push_back(layout);
        first_page_.push_back(first_page_.back() + static_cast<std::uint32_t>(layout.count()));
        first_row_.push_back(first_row_.back() + static_cast<std::uint32_t>(layout.rows));
        first_column_.push_back(first_column_.back() + static_cast<std::uint32_t>(layout.columns));
    }
}

PageIndex PageNumbers::page(std::uint32_t number) const {
    const auto above = std::upper_bound(first_page_.begin(), first_page_.end(), number);
    const auto level = static_cast<std::size_t>(above - first_page_.begin()) - 1;
    const auto within = static_cast<int>(number - first_page_[level]);
    return {within / layouts_[level].columns, within % layouts_[level].columns, static_cast<int>(level)};
}

bool PageNumbers::contains(const PageIndex& page) const {
    if (page.level < 0 || page.level >= static_cast<int>(layouts_.size())) return false;
    const PageLayout& layout = layouts_[static_cast<std::size_t>(page.level)];
    return page.row >= 0 && page.row < layout.rows && page.column >= 0 && page.column < layout.columns;
}

}  // namespace oro
