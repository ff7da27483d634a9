// Places of a lattice in few bits: which of a rectangle's there are.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/cluster_file/number_code.h"

namespace oro {

// Row and column in a rectangle; they sort row by row.
struct GridPosition {
    std::int32_t row{};
    std::int32_t column{};
    friend auto operator<=>(const GridPosition&, const GridPosition&) = default;
};

// A rectangle is cut in two across its longer side, and it is told how many places are in the first half; and
// so on, until it is full or empty. That takes little more than what the number of ways to choose the places
// asks for, and as little where they are dense as where they are few.
class PointCode {
  public:
    // points: `count` different ones, sorted; an encoder's are coded, a decoder's are replaced. rows, columns
    // >= 1 and below 2^31; count: 1 .. rows * columns.
    template <class Coder>
    void code(Coder& coder, std::int32_t rows, std::int32_t columns, std::uint32_t count,
              std::vector<GridPosition>& points);

  private:
    struct Box {
        std::int32_t row;
        std::int32_t column;
        std::int32_t rows;
        std::int32_t columns;
        [[nodiscard]] std::uint64_t places() const {
            return static_cast<std::uint64_t>(rows) * static_cast<std::uint64_t>(columns);
        }
    };
    template <class Coder>
    void code_box(Coder& coder, const Box& box, std::uint32_t count, std::size_t first);
    template <class Coder>
    std::uint32_t code_first(Coder& coder, const Box& one, const Box& other, std::uint32_t count,
                             std::uint32_t in_one);

    // By the places of a rectangle, few or many, and by how many of them there are.
    std::array<std::array<FewNumbers, 9>, 6> few_;
    std::array<NearZero, 4> many_;
    std::vector<GridPosition> points_;
};

}  // namespace oro
