#include "core/cluster_file/point_code.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace oro {
namespace {

std::size_t size_class(std::uint64_t places) {
    if (places <= 4) return static_cast<std::size_t>(places - 2);
    return places <= 8 ? 3 : places <= 32 ? 4 : 5;
}

}  // namespace

// How many of `count` places are in the first of two halves.
template <class Coder>
std::uint32_t PointCode::code_first(Coder& coder, const Box& one, const Box& other, std::uint32_t count,
                                    std::uint32_t in_one) {
    const std::uint64_t places = one.places() + other.places();
    // Where more than half are there, those that are not are told.
    if (count > places / 2) {
        const auto missing = static_cast<std::uint32_t>(places - count);
        const auto of_one = static_cast<std::uint32_t>(one.places() - in_one);
        return static_cast<std::uint32_t>(one.places()) - code_first(coder, one, other, missing, of_one);
    }
    const auto lowest = static_cast<std::uint32_t>(count > other.places() ? count - other.places() : 0);
    const auto highest = static_cast<std::uint32_t>(std::min<std::uint64_t>(count, one.places()));
    if (lowest == highest) return lowest;
    std::uint32_t found = 0;
    if (count <= 8) {
        found = few_[size_class(places)][count].code(coder, static_cast<std::uint32_t>(std::bit_width(count)),
                                                     in_one);
    } else {
        const int shift = std::max(0, static_cast<int>(std::bit_width(places)) - 32);
        const auto half = static_cast<std::int32_t>((one.places() >> shift) * count / (places >> shift));
        const auto which = static_cast<std::size_t>(std::min(static_cast<int>(std::bit_width(count)), 7) - 4);
        found = static_cast<std::uint32_t>(
            half + many_[which].code(coder, static_cast<std::int32_t>(in_one) - half));
    }
    return std::clamp(found, lowest, highest);
}

template <class Coder>
void PointCode::code_box(Coder& coder, const Box& box, std::uint32_t count, std::size_t first) {
    if (count == 0) return;
    if (count == box.places()) {
        if constexpr (!Coder::writes) {
            for (std::int32_t row = 0; row < box.rows; ++row) {
                for (std::int32_t column = 0; column < box.columns; ++column)
                    points_.push_back({box.row + row, box.column + column});
            }
        }
        return;
    }
    Box one = box, other = box;
    if (box.rows > box.columns) {
        one.rows = box.rows - box.rows / 2;
        other.row += one.rows;
        other.rows -= one.rows;
    } else {
        one.columns = box.columns - box.columns / 2;
        other.column += one.columns;
        other.columns -= one.columns;
    }
    std::uint32_t in_one = 0;
    if constexpr (Coder::writes) {
        const auto begin = points_.begin() + static_cast<std::ptrdiff_t>(first);
        in_one = static_cast<std::uint32_t>(std::partition(begin, begin + count,
                                                           [&](const GridPosition& point) {
                                                               return point.row < one.row + one.rows &&
                                                                      point.column < one.column + one.columns;
                                                           }) -
                                            begin);
    }
    in_one = code_first(coder, one, other, count, in_one);
    code_box(coder, one, in_one, first);
    code_box(coder, other, count - in_one, first + in_one);
}

template <class Coder>
void PointCode::code(Coder& coder, std::int32_t rows, std::int32_t columns, std::uint32_t count,
                     std::vector<GridPosition>& points) {
    const Box all{0, 0, rows, columns};
    assert(count >= 1 && count <= all.places());
    points_.clear();
    if constexpr (Coder::writes) points_ = points;
    code_box(coder, all, count, 0);
    if constexpr (!Coder::writes) {
        std::sort(points_.begin(), points_.end());
        points.swap(points_);
    }
}

template void PointCode::code(RangeEncoder&, std::int32_t, std::int32_t, std::uint32_t,
                              std::vector<GridPosition>&);
template void PointCode::code(RangeDecoder&, std::int32_t, std::int32_t, std::uint32_t,
                              std::vector<GridPosition>&);

}  // namespace oro
