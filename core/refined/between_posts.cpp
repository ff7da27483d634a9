#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/parallel.h"
#include "core/refined/refined_posts.h"
#include "core/refined/taken_posts.h"
#include "core/terrain/cell_diagonal.h"

namespace oro {
namespace {

constexpr int window_posts = 10;  // around a post
constexpr int window_margin_posts = window_posts + 4;

// Sums of squares over rectangles of posts, and how many there are: in whole numbers, so that they are the
// same for whichever part they are asked of.
class SquareSums {
  public:
    SquareSums(int rows, int columns)
        : across_(static_cast<std::size_t>(columns) + 1),
          sums_((static_cast<std::size_t>(rows) + 1) * across_),
          counts_(sums_.size()) {}
    // All of a row after those before; value_at(column): nothing where there is none.
    template <class Value>
    void add_row(int row, int columns, const Value& value_at) {
        std::uint64_t sum = 0;
        std::uint32_t count = 0;
        for (int column = 0; column < columns; ++column) {
            std::int64_t value = 0;
            if (value_at(column, value)) {
                sum += static_cast<std::uint64_t>(value * value);
                ++count;
            }
            const std::size_t here = number(row + 1, column + 1);
            sums_[here] = sums_[here - across_] + sum;
            counts_[here] = counts_[here - across_] + count;
        }
    }
    // Of rows and columns from .. to, both among them. Nothing where there are fewer than `least`.
    [[nodiscard]] double mean(int first_row, int last_row, int first_column, int last_column,
                              std::uint32_t least) const {
        const std::size_t a = number(first_row, first_column), b = number(first_row, last_column + 1),
                          c = number(last_row + 1, first_column), d = number(last_row + 1, last_column + 1);
        const std::uint32_t count = counts_[d] - counts_[b] - counts_[c] + counts_[a];
        if (count < least) return 0.0;
        return static_cast<double>(sums_[d] - sums_[b] - sums_[c] + sums_[a]) / count;
    }

  private:
    [[nodiscard]] std::size_t number(int row, int column) const {
        return static_cast<std::size_t>(row) * across_ + static_cast<std::size_t>(column);
    }
    std::size_t across_;
    std::vector<std::uint64_t> sums_;
    std::vector<std::uint32_t> counts_;
};

constexpr std::array lags{1, 2, 4};
constexpr double step_m = 1.0 / 2048.0;

// What is counted around each post: second differences at three lags along columns and along rows, and what
// the cubic is off the straight way half way between posts and in cells.
struct Counted {
    std::vector<SquareSums> along_column, along_row;  // by lag
    SquareSums cubic_down, cubic_right, cubic_middle;
};

// Of a step off the straight way, sixteen times; the middle one 16 times as well, rounded down.
std::int64_t cubic_off(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
    return b + c - a - d;
}

class Counting {
  public:
    explicit Counting(const TakenPosts& taken) : taken_(taken) {}

    // The second difference around a post.
    [[nodiscard]] bool second(int row, int column, int down, int right, std::int64_t& value) const {
        std::int32_t a{}, b{}, c{};
        if (!steps(row, column, b) || !steps(row - down, column - right, a) ||
            !steps(row + down, column + right, c))
            return false;
        value = std::int64_t{a} + c - 2 * std::int64_t{b};
        return true;
    }
    [[nodiscard]] bool cubic(int row, int column, int down, int right, std::int64_t& value) const {
        std::array<std::int32_t, 4> at{};
        for (int i = 0; i < 4; ++i)
            if (!steps(row + (i - 1) * down, column + (i - 1) * right, at[static_cast<std::size_t>(i)]))
                return false;
        value = cubic_off(at[0], at[1], at[2], at[3]);
        return true;
    }
    [[nodiscard]] bool cubic_middle(int row, int column, std::int64_t& value) const {
        std::array<std::int64_t, 4> weighed{};
        std::int64_t corners = 0;
        for (int i = 0; i < 4; ++i) {
            std::array<std::int32_t, 4> at{};
            for (int j = 0; j < 4; ++j)
                if (!steps(row + i - 1, column + j - 1, at[static_cast<std::size_t>(j)])) return false;
            weighed[static_cast<std::size_t>(i)] = weighed_steps(at[0], at[1], at[2], at[3]);
            if (i == 1 || i == 2) corners += std::int64_t{at[1]} + at[2];
        }
        const std::int64_t smooth = 9 * (weighed[1] + weighed[2]) - weighed[0] - weighed[3];  // 256 times
        value = (smooth - 64 * corners) >> 4;
        return true;
    }

  private:
    [[nodiscard]] bool steps(int row, int column, std::int32_t& value) const {
        if (!taken_.has(row, column)) return false;
        value = taken_.steps(row, column);
        return value != no_decisive_steps && !taken_.is_still(row, column);
    }
    const TakenPosts& taken_;
};

Counted counted(const TakenPosts& taken) {
    const int rows = taken.rows(), columns = taken.columns();
    const SquareSums none(rows, columns);
    Counted sums{{none, none, none}, {none, none, none}, none, none, none};
    const Counting counting(taken);
    // Each is a task: nine sums over the same posts.
    in_parallel(9, thread_count(), [&](int which) {
        SquareSums& sum = which < 3   ? sums.along_column[static_cast<std::size_t>(which)]
                          : which < 6 ? sums.along_row[static_cast<std::size_t>(which - 3)]
                          : which < 7 ? sums.cubic_down
                          : which < 8 ? sums.cubic_right
                                      : sums.cubic_middle;
        for (int row = 0; row < rows; ++row)
            sum.add_row(row, columns, [&](int column, std::int64_t& value) {
                if (which < 6) {
                    const int lag = lags[static_cast<std::size_t>(which % 3)];
                    return counting.second(row, column, which < 3 ? lag : 0, which < 3 ? 0 : lag, value);
                }
                if (which < 8) return counting.cubic(row, column, 7 - which, which - 6, value);
                return counting.cubic_middle(row, column, value);
            });
    });
    return sums;
}

// How much more the ground leaves the mean of four corners in a cell's middle than the straight way half way
// between two posts, mean squares, where second differences grow as the power p of distance. Source: the
// variances of sums of such a process with weights that sum to 0 (J.-P. Chiles, P. Delfiner, Geostatistics,
// 2012, section 4.3).
double middle_ratio(double p) {
    constexpr double near = 0.01;
    if (std::abs(p - 2.0) < near) return 1.5;
    const double root = std::exp2(0.5 * p);
    return (2.0 / root - 0.5 - 0.25 * root) / (std::exp2(1.0 - p) - 0.5);
}

// What holds around one post.
class Around {
  public:
    Around(const Counted& sums, const TakenPosts& taken, int row, int column)
        : sums_(sums),
          north_(std::max(row - window_posts, 0)),
          south_(std::min(row + window_posts, taken.rows() - 1)),
          west_(std::max(column - window_posts, 0)),
          east_(std::min(column + window_posts, taken.columns() - 1)) {}

    [[nodiscard]] BetweenPosts found(const PostSpacing& spacing) const {
        BetweenPosts here;
        const std::optional<Growth> growth = growth_of(spacing);
        if (!growth) return here;
        // A quarter of the mean square second difference at half a post.
        const auto half_way_m2 = [&](double length_m) {
            return 0.25 *
                   std::exp(growth->log_m2 + growth->power * (std::log(0.5 * length_m) - growth->log_m));
        };
        const double down_m2 = half_way_m2(spacing.row_m), right_m2 = half_way_m2(spacing.column_m);
        const double middle_m2 = middle_ratio(growth->power) * 0.5 * (down_m2 + right_m2);
        const auto rest_m = [&](double whole_m2, const SquareSums& cubic) {
            constexpr double sixteenth = 1.0 / 16.0;
            return static_cast<float>(std::sqrt(std::max(whole_m2 - mean_m2(cubic, sixteenth), 0.0)));
        };
        here.by_row_m = static_cast<float>(std::sqrt(down_m2));
        here.by_column_m = static_cast<float>(std::sqrt(right_m2));
        here.row_noise_m = rest_m(down_m2, sums_.cubic_down);
        here.column_noise_m = rest_m(right_m2, sums_.cubic_right);
        here.middle_noise_m = rest_m(middle_m2, sums_.cubic_middle);
        here.halved = static_cast<float>(std::exp2(-0.5 * growth->power));
        return here;
    }

  private:
    // Mean square second differences as a power of the distance, through the middle of logarithms.
    struct Growth {
        double power, log_m, log_m2;
    };
    [[nodiscard]] double mean_m2(const SquareSums& of, double share) const {
        constexpr std::uint32_t least = 24;
        return of.mean(north_, south_, west_, east_, least) * (step_m * share) * (step_m * share);
    }
    // The straight line through the six; nothing of level ground, and where too few posts tell.
    [[nodiscard]] std::optional<Growth> growth_of(const PostSpacing& spacing) const {
        constexpr double least_m2 = 1.0e-6;
        Growth growth{0.0, 0.0, 0.0};
        std::array<double, 6> x{}, y{};
        for (std::size_t i = 0; i < 6; ++i) {
            const bool down = i < 3;
            const double square_m2 = mean_m2(down ? sums_.along_column[i] : sums_.along_row[i - 3], 1.0);
            if (square_m2 < least_m2) return std::nullopt;
            x[i] = std::log(lags[i % 3] * (down ? spacing.row_m : spacing.column_m));
            y[i] = std::log(square_m2);
            growth.log_m += x[i] / 6.0;
            growth.log_m2 += y[i] / 6.0;
        }
        double xy = 0.0, xx = 0.0;
        for (std::size_t i = 0; i < 6; ++i) {
            xy += (x[i] - growth.log_m) * (y[i] - growth.log_m2);
            xx += (x[i] - growth.log_m) * (x[i] - growth.log_m);
        }
        growth.power = std::clamp(xy / xx, 0.2, 3.5);
        return growth;
    }

    const Counted& sums_;
    int north_, south_, west_, east_;
};

}  // namespace

std::vector<BetweenPosts> between_posts(const HeightField& field, const GridPart& part,
                                        std::span<const char> still) {
    const TakenPosts taken(field, part, window_margin_posts, still);
    const Counted sums = counted(taken);
    std::vector<BetweenPosts> found(part.count());
    in_parallel(part.rows, thread_count(), [&](int down) {
        const int row = part.first_row + down;
        const PostSpacing spacing = spacing_on_row(field.grid, row);
        for (int column = part.first_column; column < part.first_column + part.columns; ++column)
            found[part.number(row, column)] =
                Around(sums, taken, taken.row_of(row), taken.column_of(column)).found(spacing);
    });
    return found;
}

std::vector<char> level_posts(const HeightField& field, const GridPart& part) {
    const TakenPosts taken(field, part, 2, {});
    std::vector<char> level(part.count());
    // The middle of 3 x 3 posts of one height.
    const auto is_middle = [&](int row, int column) {
        if (!taken.has(row, column)) return false;
        const std::int32_t own = taken.steps(row, column);
        if (own == no_decisive_steps) return false;
        for (int down = -1; down <= 1; ++down)
            for (int right = -1; right <= 1; ++right)
                if (!taken.has(row + down, column + right) || taken.steps(row + down, column + right) != own)
                    return false;
        return true;
    };
    in_parallel(part.rows, thread_count(), [&](int down) {
        for (int right = 0; right < part.columns; ++right) {
            const int row = taken.row_of(part.first_row + down),
                      column = taken.column_of(part.first_column + right);
            bool any = false;
            for (int i = -1; i <= 1 && !any; ++i)
                for (int j = -1; j <= 1 && !any; ++j) any = is_middle(row + i, column + j);
            level[static_cast<std::size_t>(down) * static_cast<std::size_t>(part.columns) +
                  static_cast<std::size_t>(right)] = any ? 1 : 0;
        }
    });
    return level;
}

}  // namespace oro
