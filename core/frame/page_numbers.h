// Numbers of all pages of a region, by which a device knows them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/frame/region_pages.h"

namespace oro {

// Numbers of pages of all levels of a region, of their rows and of their columns: from the finest level on,
// row by row.
class PageNumbers {
  public:
    // At most 2^32 - 1 pages.
    explicit PageNumbers(const RegionPages& pages);
    [[nodiscard]] std::uint32_t of(const PageIndex& page) const {
        const auto level = static_cast<std::size_t>(page.level);
        return first_page_[level] + static_cast<std::uint32_t>(layouts_[level].number(page.row, page.column));
    }
    [[nodiscard]] PageIndex page(std::uint32_t number) const;
    [[nodiscard]] std::uint32_t row(const PageIndex& page) const {
        return first_row_[static_cast<std::size_t>(page.level)] + static_cast<std::uint32_t>(page.row);
    }
    [[nodiscard]] std::uint32_t column(const PageIndex& page) const {
        return first_column_[static_cast<std::size_t>(page.level)] + static_cast<std::uint32_t>(page.column);
    }
    [[nodiscard]] std::uint32_t page_count() const { return first_page_.back(); }
    [[nodiscard]] std::uint32_t row_count() const { return first_row_.back(); }
    [[nodiscard]] std::uint32_t column_count() const { return first_column_.back(); }
    // Of a level, or one above the last: none.
    [[nodiscard]] bool contains(const PageIndex& page) const;

  private:
    std::vector<PageLayout> layouts_;                                   // of each level
    std::vector<std::uint32_t> first_page_, first_row_, first_column_;  // ... and what all have together
};

}  // namespace oro
