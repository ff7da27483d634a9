// A part of a grid's posts.
#pragma once

#include <cstddef>

namespace oro {

// Rows from the north and columns from the west, as the grid numbers them. Empty where rows or columns is 0.
// Of a grid that goes round the Earth columns may begin before the first and end behind the last: column c is
// then that of c a turn on.
struct GridPart {
    int first_row{};
    int rows{};
    int first_column{};
    int columns{};
    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
    }
    // Where a post of the part stands in what holds one value for each, row by row.
    [[nodiscard]] std::size_t number(int row, int column) const {
        return static_cast<std::size_t>(row - first_row) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column - first_column);
    }
    bool operator==(const GridPart&) const = default;
};

}  // namespace oro
