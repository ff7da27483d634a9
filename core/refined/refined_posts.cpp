#include "core/refined/refined_posts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

#include "core/base/lowbias32.h"
#include "core/base/parallel.h"
#include "core/refined/rim_surface.h"
#include "core/refined/taken_posts.h"
#include "core/terrain/cell_diagonal.h"
#include "core/terrain/triangle_heights.h"

namespace oro {
namespace {

constexpr int margin_posts = 4;      // what cubics of all halvings reach beyond a part
constexpr int void_reach_posts = 2;  // so near a void post nothing is invented

// Numbers of a grid's first row and column in the world, so that its posts have the same noise in any region;
// columns of a whole turn, where that is a whole number of them.
struct WorldNumbers {
    std::int64_t row{}, column{};
    int row_step{1};
    std::int64_t turn{};  // 0: columns do not go on round the Earth
};
WorldNumbers world_numbers(const PostGrid& grid) {
    if (grid.net) return {};
    WorldNumbers numbers{grid.lat.first, grid.lon.first, grid.lat.step, 0};
    const double turn = 360.0 * grid.lon.posts_per_deg;
    if (turn == std::floor(turn) && turn < 1.0e15) numbers.turn = static_cast<std::int64_t>(turn);
    return numbers;
}

// A number of mean 0 and variance 1, at most 3.47, nearly normal: the sum of four even ones of 16 bits each.
double noise_of(std::int64_t row, std::int64_t column, int level) {
    const auto folded = [](std::int64_t number) {
        const auto bits = static_cast<std::uint64_t>(number);
        return static_cast<std::uint32_t>(bits) ^ lowbias32(static_cast<std::uint32_t>(bits >> 32U));
    };
    const std::uint32_t place = lowbias32(folded(row) * 0x9e3779b1U + static_cast<std::uint32_t>(level));
    const std::uint32_t first = lowbias32(place ^ (folded(column) * 0x85ebca77U)),
                        second = lowbias32(first ^ place ^ 0xc2b2ae3dU);
    const auto sum =
        static_cast<double>((first & 0xffffU) + (first >> 16U) + (second & 0xffffU) + (second >> 16U));
    constexpr double mean = 2.0 * 65535.0, deviation = 37837.227;  // sqrt(4 / 12 (65536^2 - 1))
    return (sum - mean) / deviation;
}

// A rectangle of numbers.
struct Sheet {
    int rows{}, columns{};
    std::vector<double> values;
    Sheet(int r, int c)
        : rows(r), columns(c), values(static_cast<std::size_t>(r) * static_cast<std::size_t>(c)) {}
    [[nodiscard]] double& at(int row, int column) {
        return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(column)];
    }
    [[nodiscard]] double at(int row, int column) const {
        return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(column)];
    }
};

// Half way between the second and the third of four numbers in line; beyond an end the line goes on straight.
template <class At>
double half_way(const At& at, int first, int count) {
    const double b = at(first), c = at(first + 1);
    const double a = first > 0 ? at(first - 1) : 2.0 * b - c;
    const double d = first + 2 < count ? at(first + 2) : 2.0 * c - b;
    return (9.0 * (b + c) - a - d) / 16.0;
}

// The smooth surface at twice as many posts.
Sheet doubled(const Sheet& from) {
    Sheet to(2 * from.rows - 1, 2 * from.columns - 1);
    in_parallel(from.rows, thread_count(), [&](int row) {
        for (int column = 0; column < from.columns; ++column)
            to.at(2 * row, 2 * column) = from.at(row, column);
        for (int column = 0; column + 1 < from.columns; ++column)
            to.at(2 * row, 2 * column + 1) =
                half_way([&](int i) { return from.at(row, i); }, column, from.columns);
    });
    in_parallel(from.rows - 1, thread_count(), [&](int row) {
        for (int column = 0; column < to.columns; ++column)
            to.at(2 * row + 1, column) =
                half_way([&](int i) { return to.at(2 * i, column); }, row, from.rows);
    });
    return to;
}

// The noise of one halving for the posts that it adds.
class AddedNoise {
  public:
    // between: of the posts that were taken. level: from 1.
    AddedNoise(const std::vector<BetweenPosts>& between, const TakenPosts& taken, const WorldNumbers& world,
               const PostGrid& grid, int level)
        : between_(between), taken_(taken), world_(world), grid_(grid), level_(level) {}

    void add(Sheet& sheet) const {
        // Middles of cells first: a post half way along a side takes a part of its noise from those beside
        // it.
        in_parallel(sheet.rows / 2, thread_count(), [&](int i) {
            for (int column = 1; column < sheet.columns; column += 2)
                sheet.at(2 * i + 1, column) += middle(2 * i + 1, column);
        });
        in_parallel(sheet.rows, thread_count(), [&](int row) {
            const double ratio = rows_to_columns(row);
            for (int column = row % 2 == 0 ? 1 : 0; column < sheet.columns; column += 2)
                sheet.at(row, column) += side(sheet, row, column, ratio);
        });
    }

  private:
    // How much of the noise of a cell's middle its sides take, where cells are square: more where it is
    // nearer.
    static constexpr double taken_share = 0.35, most_taken = 0.5;
    // A cubic through posts that were made explains less of what is between them than one through the data's:
    // so much more noise they get. Measured (docs/notes/2026-11-28-detail-between-posts.md).
    static constexpr double later_noise = 1.15;

    [[nodiscard]] double number(int row, int column) const {
        const std::int64_t along = std::int64_t{1} << level_;
        const std::int64_t down = world_.row * along + world_.row_step * (taken_.grid_row(0) * along + row);
        std::int64_t right = world_.column * along + taken_.grid_column(0) * along + column;
        if (world_.turn > 0) {
            const std::int64_t turn = world_.turn * along;
            right = ((right % turn) + turn) % turn;
        }
        return noise_of(down, right, level_);
    }
    // A part of what is known of the posts around, between them.
    template <class Part>
    [[nodiscard]] double around(int row, int column, const Part& part) const {
        const int top = std::min(row >> level_, taken_.rows() - 2),
                  left = std::min(column >> level_, taken_.columns() - 2);
        const double scale = std::ldexp(1.0, -level_);
        const double down = row * scale - top, right = column * scale - left;
        const auto value = [&](int i, int j) {
            const BetweenPosts& post =
                between_[static_cast<std::size_t>(top + i) * static_cast<std::size_t>(taken_.columns()) +
                         static_cast<std::size_t>(left + j)];
            double m = level_ > 1 ? later_noise * part(post) : part(post);
            for (int halving = 1; halving < level_; ++halving) m *= static_cast<double>(post.halved);
            return m;
        };
        return (1.0 - down) * ((1.0 - right) * value(0, 0) + right * value(0, 1)) +
               down * ((1.0 - right) * value(1, 0) + right * value(1, 1));
    }
    [[nodiscard]] double middle(int row, int column) const {
        return around(row, column, [](const BetweenPosts& post) { return double{post.middle_noise_m}; }) *
               number(row, column);
    }
    // The spacing of rows over that of columns.
    [[nodiscard]] double rows_to_columns(int row) const {
        const PostSpacing spacing = spacing_on_row(grid_, taken_.grid_row(0) + std::ldexp(row, -level_));
        return spacing.row_m / spacing.column_m;
    }
    [[nodiscard]] double side(const Sheet& sheet, int row, int column, double rows_to_columns) const {
        const bool along_row = row % 2 == 0;
        const double whole_m = around(row, column, [&](const BetweenPosts& post) {
            return double{along_row ? post.column_noise_m : post.row_noise_m};
        });
        const double share =
            std::min(taken_share * (along_row ? 1.0 / rows_to_columns : rows_to_columns), most_taken);
        double taken_m = 0.0, taken_m2 = 0.0;
        for (const int beside : {-1, 1}) {
            const int r = along_row ? row + beside : row, c = along_row ? column : column + beside;
            if (r < 0 || c < 0 || r >= sheet.rows || c >= sheet.columns) continue;
            const double deviation_m =
                around(r, c, [](const BetweenPosts& post) { return double{post.middle_noise_m}; });
            taken_m += share * deviation_m * number(r, c);
            taken_m2 += share * share * deviation_m * deviation_m;
        }
        // Sides of cells that are far from square may get too much.
        const double whole_m2 = whole_m * whole_m;
        if (taken_m2 > whole_m2) return taken_m * std::sqrt(whole_m2 / taken_m2);
        return taken_m + std::sqrt(whole_m2 - taken_m2) * number(row, column);
    }

    const std::vector<BetweenPosts>& between_;
    const TakenPosts& taken_;
    const WorldNumbers& world_;
    const PostGrid& grid_;
    int level_;
};

// How much of what is invented a post of the data lets be beside it: 0 on still posts and near void ones, 1
// elsewhere.
std::vector<float> shares_of(const TakenPosts& taken, const GridPart& part) {
    std::vector<float> shares(part.count());
    in_parallel(part.rows, thread_count(), [&](int down) {
        for (int right = 0; right < part.columns; ++right) {
            const int row = taken.row_of(part.first_row + down),
                      column = taken.column_of(part.first_column + right);
            bool still = taken.is_still(row, column);
            for (int i = -void_reach_posts; i <= void_reach_posts && !still; ++i)
                for (int j = -void_reach_posts; j <= void_reach_posts && !still; ++j)
                    still = taken.has(row + i, column + j) && is_void(taken.H_m(row + i, column + j));
            if (!still)
                shares[static_cast<std::size_t>(down) * static_cast<std::size_t>(part.columns) +
                       static_cast<std::size_t>(right)] = 1.0F;
        }
    });
    return shares;
}

// The heights that cubics go through: where there is none, that of the data before or behind in the row.
Sheet without_voids(const TakenPosts& taken) {
    Sheet sheet(taken.rows(), taken.columns());
    for (int row = 0; row < taken.rows(); ++row) {
        double last_m = 0.0;
        for (int column = 0; column < taken.columns(); ++column) {
            const float H_m = taken.H_m(row, column);
            if (!is_void(H_m)) last_m = double{H_m};
            sheet.at(row, column) = last_m;
        }
    }
    return sheet;
}

struct RowFound {
    double sum_m2{}, largest_m{};
    std::uint64_t posts{}, still{};
};

// What the part becomes, of a surface that is invented everywhere.
class Joining {
  public:
    Joining(const HeightField& field, const GridPart& part, const TakenPosts& taken, const Sheet& invented,
            int halvings)
        : field_(field),
          part_(part),
          invented_(invented),
          shares_(shares_of(taken, part)),
          rim_(taken, part),
          halvings_(halvings),
          skipped_row_(taken.row_of(part.first_row) << halvings),
          skipped_column_(taken.column_of(part.first_column) << halvings),
          diagonals_(static_cast<std::size_t>(part.rows - 1) * static_cast<std::size_t>(part.columns - 1)) {
        in_parallel(part.rows - 1, thread_count(), [&](int row) {
            for (int column = 0; column < part.columns - 1; ++column)
                diagonals_[cell_number(row, column)] =
                    cell_diagonal(field, part.first_row + row, part.first_column + column);
        });
    }

    // One row of the finer posts.
    RowFound row(int fine_row, float* H_m) const {
        RowFound found;
        const int along = 1 << halvings_, columns = ((part_.columns - 1) << halvings_) + 1;
        for (int fine = 0; fine < columns; ++fine) {
            if (fine_row % along == 0 && fine % along == 0) {
                H_m[fine] =
                    field_.H_at_post_m(part_.first_row + fine_row / along, part_.first_column + fine / along);
                continue;
            }
            H_m[fine] = void_height_m;
            const std::optional<double> data_m = of_data_m(fine_row, fine);
            if (!data_m) continue;
            ++found.posts;
            H_m[fine] = static_cast<float>(*data_m);
            const double share = share_at(fine_row, fine);
            if (share == 0.0) {
                ++found.still;
                continue;
            }
            constexpr double steps = 2048.0;
            const double off_m = share * (made_m(fine_row, fine) - *data_m);
            H_m[fine] = static_cast<float>(std::floor((*data_m + off_m) * steps + 0.5) / steps);
            found.sum_m2 += off_m * off_m;
            found.largest_m = std::max(found.largest_m, std::abs(off_m));
        }
        return found;
    }

  private:
    [[nodiscard]] std::size_t cell_number(int row, int column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(part_.columns - 1) +
               static_cast<std::size_t>(column);
    }
    struct Cell {
        int row, column;  // of the part
        double down, right;
    };
    [[nodiscard]] Cell cell_of(int fine_row, int fine_column) const {
        const int row = std::min(fine_row >> halvings_, part_.rows - 2),
                  column = std::min(fine_column >> halvings_, part_.columns - 2);
        const double scale = std::ldexp(1.0, -halvings_);
        return {row, column, fine_row * scale - row, fine_column * scale - column};
    }
    // What is invented, towards the rim without noise.
    [[nodiscard]] double made_m(int fine_row, int fine_column) const {
        const double scale = std::ldexp(1.0, -halvings_), row = fine_row * scale,
                     column = fine_column * scale, noise = rim_.noise_share(row, column);
        const double within_m = invented_.at(skipped_row_ + fine_row, skipped_column_ + fine_column);
        return noise == 1.0 ? within_m : std::lerp(rim_.H_m(row, column), within_m, noise);
    }
    // The data's surface, as it is drawn.
    [[nodiscard]] std::optional<double> of_data_m(int fine_row, int fine_column) const {
        const double scale = std::ldexp(1.0, -halvings_);
        const auto post_m = [&](int row, int column) -> std::optional<double> {
            const float H_m = field_.H_at_post_m(row, column);
            return is_void(H_m) ? std::nullopt : std::optional(double{H_m});
        };
        const auto diagonal_at = [&](int row, int column) {
            // Places on the rim are also looked for beyond it.
            const int down = row - part_.first_row, right = column - part_.first_column;
            if (down < 0 || right < 0 || down >= part_.rows - 1 || right >= part_.columns - 1)
                return cell_diagonal(field_, row, column);
            return diagonals_[cell_number(down, right)];
        };
        return h_at_row_column_m(field_.grid, post_m, diagonal_at, part_.first_row + fine_row * scale,
                                 part_.first_column + fine_column * scale);
    }
    // 0 on the rim.
    [[nodiscard]] double share_at(int fine_row, int fine_column) const {
        if (fine_row == 0 || fine_column == 0 || fine_row == (part_.rows - 1) << halvings_ ||
            fine_column == (part_.columns - 1) << halvings_)
            return 0.0;
        const Cell cell = cell_of(fine_row, fine_column);
        const auto share = [&](int down, int right) {
            return double{
                shares_[static_cast<std::size_t>(cell.row + down) * static_cast<std::size_t>(part_.columns) +
                        static_cast<std::size_t>(cell.column + right)]};
        };
        return (1.0 - cell.down) * ((1.0 - cell.right) * share(0, 0) + cell.right * share(0, 1)) +
               cell.down * ((1.0 - cell.right) * share(1, 0) + cell.right * share(1, 1));
    }

    const HeightField& field_;
    const GridPart& part_;
    const Sheet& invented_;
    std::vector<float> shares_;
    RimSurface rim_;
    int halvings_;
    int skipped_row_, skipped_column_;
    std::vector<Diagonal> diagonals_;  // of the part's cells
};

// Of an axis whose first post is number `first` of the grid's.
GridAxis finer_axis(const GridAxis& axis, int first, int posts, int halvings) {
    GridAxis finer = axis;
    const std::int64_t along = std::int64_t{1} << halvings;
    finer.posts_per_deg = axis.posts_per_deg * static_cast<double>(along);
    finer.first = (axis.first + axis.step * first) * along;
    finer.count = ((posts - 1) << halvings) + 1;
    return finer;
}

// The polynomials of a net are of places in patches: the same with more posts to a patch.
Result<std::shared_ptr<const LatticeGeoreference>> finer_net(const LatticeGeoreference& net,
                                                             const GridPart& part, int halvings) {
    if (net.is_corrected())
        return Error{ErrorKind::no_data, "--detail",
                     "is not for grids whose datum comes by a grid of shifts: their posts are placed one by "
                     "one, and there is none between them; --resample makes one of latitudes and longitudes"};
    ORO_TRY(const auto own, net.part(part.first_row, part.first_column, part.rows, part.columns));
    LatticeGeoreference::Stored stored = own->stored();
    for (LatticeGeoreference::Stored::Axis* axis : {&stored.down, &stored.across}) {
        axis->first <<= halvings;
        axis->posts = ((axis->posts - 1) << halvings) + 1;
        axis->patch_posts <<= halvings;
    }
    return LatticeGeoreference::from(stored);
}

Result<PostGrid> finer_grid(const PostGrid& grid, const GridPart& part, int halvings) {
    if (grid.net) {
        ORO_TRY(auto net, finer_net(*grid.net, part, halvings));
        return grid_on_net(std::move(net));
    }
    return PostGrid{finer_axis(grid.lat, part.first_row, part.rows, halvings),
                    finer_axis(grid.lon, part.first_column, part.columns, halvings)};
}

// The surface with noise everywhere, of the posts that were taken.
Sheet invented_surface(const HeightField& field, const TakenPosts& taken, int halvings,
                       const std::vector<char>& still) {
    const GridPart all{taken.grid_row(0), taken.rows(), taken.grid_column(0), taken.columns()};
    const std::vector<BetweenPosts> between = between_posts(field, all, still);
    const WorldNumbers world = world_numbers(field.grid);
    Sheet sheet = without_voids(taken);
    for (int level = 1; level <= halvings; ++level) {
        sheet = doubled(sheet);
        AddedNoise(between, taken, world, field.grid, level).add(sheet);
    }
    return sheet;
}

}  // namespace

Result<RefinedPosts> refined_posts(const HeightField& field, const GridPart& part, int halvings,
                                   std::span<const char> still) {
    RefinedPosts made;
    ORO_TRY(made.field.grid, finer_grid(field.grid, part, halvings));
    const TakenPosts taken(field, part, margin_posts, still);
    std::vector<char> taken_still;
    for (int row = 0; row < taken.rows(); ++row)
        for (int column = 0; column < taken.columns(); ++column)
            taken_still.push_back(taken.is_still(row, column) ? 1 : 0);
    const Sheet invented = invented_surface(field, taken, halvings, taken_still);
    const Joining joining(field, part, taken, invented, halvings);
    made.field.H_m.resize(made.field.grid.post_count());
    std::vector<RowFound> rows(static_cast<std::size_t>(made.field.grid.rows()));
    in_parallel(made.field.grid.rows(), thread_count(), [&](int row) {
        const auto across = static_cast<std::size_t>(made.field.grid.columns());
        rows[static_cast<std::size_t>(row)] =
            joining.row(row, made.field.H_m.data() + static_cast<std::size_t>(row) * across);
    });
    double sum_m2 = 0.0;
    for (const RowFound& row : rows) {
        sum_m2 += row.sum_m2;
        made.largest_m = std::max(made.largest_m, row.largest_m);
        made.posts += row.posts;
        made.still += row.still;
    }
    made.rms_m = made.posts > 0 ? std::sqrt(sum_m2 / static_cast<double>(made.posts)) : 0.0;
    made.field.undulation = field.undulation;
    if (made.field.grid.net && !field.undulation.N_m.empty())
        made.field.N_of_posts_m = N_of_net_m(*made.field.grid.net, field.undulation, thread_count());
    ORO_CHECK(field.health());
    return made;
}

}  // namespace oro
