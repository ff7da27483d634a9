#include "core/cluster_windows/region_windows.h"

#include <algorithm>
#include <cmath>

#include "core/cluster_windows/window_margins.h"

namespace oro {
namespace {

// A part of a side.
struct Stretch {
    int first{};  // of the window
    int count{};
    int own_first{};
    int own_last{};  // the last one
};

int whole_leaves(double posts) {
    return leaf_side * static_cast<int>(std::ceil(posts / leaf_side));
}

// The parts of a side that is cut into so many, nearly alike.
std::vector<Stretch> stretches_of(int posts, int count, const WindowMargins& margins, double widened) {
    const int own = whole_leaves(static_cast<double>(posts) / count);
    const auto wide = [&](int margin) { return whole_leaves(widened * margin); };
    std::vector<Stretch> stretches;
    for (int first = 0; first < posts; first += own) {
        // A rest of a few posts goes to the one before.
        const bool is_last = first + own + leaf_side >= posts;
        const int last = is_last ? posts - 1 : first + own - 1;
        const int begin = first == 0 ? 0 : std::max(0, first - wide(first - margins.begin(first)));
        const int end = is_last ? posts - 1 : std::min(posts - 1, last + 1 + wide(margins.end(last) - last));
        stretches.push_back({begin, end - begin + 1, first, last});
        if (is_last) break;
    }
    return stretches;
}

// How many windows there are across a side.
struct Counts {
    int down{1};
    int right{1};
};

// Posts of all windows are fewest, and none has too many, where margins allow.
Counts counts_of(int rows, int columns, int margin_down, int margin_right, std::size_t posts) {
    const auto of_one = [](int side, int count, int margin) {
        return std::min(1.0 * side, 1.0 * side / count + (count > 2 ? 2.0 : count - 1.0) * margin);
    };
    const auto of_all = [](int side, int count, int margin) { return side + 2.0 * (count - 1) * margin; };
    const int most_down = std::max(1, rows / margin_down), most_right = std::max(1, columns / margin_right);
    Counts best{most_down, most_right};
    double least = of_all(rows, most_down, margin_down) * of_all(columns, most_right, margin_right);
    for (int down = 1; down <= most_down; ++down) {
        const double high = of_one(rows, down, margin_down);
        int right = 1;
        while (right < most_right && high * of_one(columns, right, margin_right) > static_cast<double>(posts))
            ++right;
        if (high * of_one(columns, right, margin_right) > static_cast<double>(posts)) continue;
        const double all = of_all(rows, down, margin_down) * of_all(columns, right, margin_right);
        if (all > least) continue;
        least = all;
        best = {down, right};
    }
    return best;
}

}  // namespace

std::vector<RegionWindow> windows_of(int rows, int columns, const WindowSizes& sizes) {
    const WindowMargins down(WindowMargins::Along::rows, sizes), right(WindowMargins::Along::columns, sizes);
    const Counts counts = counts_of(rows, columns, down.most(), right.most(), sizes.posts);
    std::vector<RegionWindow> windows;
    for (const Stretch& row : stretches_of(rows, counts.down, down, sizes.widened)) {
        for (const Stretch& column : stretches_of(columns, counts.right, right, sizes.widened))
            windows.push_back({{row.first, column.first, row.first > 0, column.first + column.count < columns,
                                row.first + row.count<rows, column.first> 0, false},
                               row.count,
                               column.count,
                               {row.own_first, row.own_last, column.own_first, column.own_last}});
    }
    return windows;
}

SurfaceVertex middle_of(const GroupTiling& tiling, const GroupTile& tile, int rows, int columns) {
    const PlaneBox box = tiling.box_of(tile);
    const auto within = [](std::int64_t first, std::int64_t last, int posts) {
        return static_cast<std::int32_t>(
            std::clamp<std::int64_t>((first + last) / 2, 0, std::int64_t{posts} - 1));
    };
    return {within(box.first_row, box.last_row, rows), within(box.first_column, box.last_column, columns), 0};
}

}  // namespace oro
