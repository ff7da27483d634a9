#include "core/truth/true_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "core/base/parallel.h"
#include "core/base/wide.h"
#include "core/terrain/cell_diagonals.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/post_spacing.h"
#include "core/terrain/triangle_heights.h"

namespace oro {
namespace {

constexpr int chunk_level = 5;                                        // of whole chunks
constexpr int chunk_cells = TrueSurface::block_cells << chunk_level;  // 128
constexpr double slack_m = 1.0e-3;                                    // of layers

using Layer = TrueSurface::Layer;
constexpr Layer no_layer{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

Layer joined(const Layer& a, const Layer& b) {
    return {std::min(a.lowest_h_m, b.lowest_h_m), std::max(a.highest_h_m, b.highest_h_m)};
}

// Takes posts into the lowest and highest heights so far; as many at a time as a vector holds.
ORO_WIDE void take_into_range(const float* heights_m, int count, float& lowest, float& highest) {
    constexpr int lanes = 16;
    std::array<float, lanes> low, high;
    low.fill(lowest);
    high.fill(highest);
    int i = 0;
    for (; i + lanes <= count; i += lanes) {
        for (int lane = 0; lane < lanes; ++lane) {
            const float post = heights_m[i + lane];
            const float up = post == void_height_m ? std::numeric_limits<float>::infinity() : post;
            const float down = post == void_height_m ? -std::numeric_limits<float>::infinity() : post;
            float &own_low = low[static_cast<std::size_t>(lane)],
                  &own_high = high[static_cast<std::size_t>(lane)];
            own_low = up < own_low ? up : own_low;
            own_high = down > own_high ? down : own_high;
        }
    }
    for (; i < count; ++i) {
        if (is_void(heights_m[i])) continue;
        low[0] = std::min(low[0], heights_m[i]);
        high[0] = std::max(high[0], heights_m[i]);
    }
    lowest = *std::ranges::min_element(low);
    highest = *std::ranges::max_element(high);
}

int divided_up(int count, int by) {
    return (count + by - 1) / by;
}

}  // namespace

// Layers of its blocks, level by level from the finest, row by row; in float, rounded outwards.
struct TrueSurface::Chunk {
    struct FloatLayer {
        float lowest{std::numeric_limits<float>::infinity()};
        float highest{-std::numeric_limits<float>::infinity()};
    };
    std::array<std::vector<FloatLayer>, chunk_level + 1> levels;

    static FloatLayer around(const Layer& layer) {
        if (layer.empty()) return {};
        constexpr float far = std::numeric_limits<float>::infinity();
        return {std::nextafter(static_cast<float>(layer.lowest_h_m), -far),
                std::nextafter(static_cast<float>(layer.highest_h_m), far)};
    }
    [[nodiscard]] Layer at(int level, int row, int column) const {
        const int side = 1 << (chunk_level - level);
        const FloatLayer& layer =
            levels[static_cast<std::size_t>(level)][static_cast<std::size_t>(row * side + column)];
        return {static_cast<double>(layer.lowest), static_cast<double>(layer.highest)};
    }
    void put(int level, const Layer& layer) {
        levels[static_cast<std::size_t>(level)].push_back(around(layer));
    }
};

struct TrueSurface::ChunkDiagonals {
    static constexpr std::size_t row_bytes = chunk_cells / 8;
    std::array<std::uint8_t, chunk_cells * row_bytes> sw_ne{};  // of its cells, row by row, eight a byte

    // By the grid's row and column.
    [[nodiscard]] Diagonal at(int row, int column) const {
        const auto cell = static_cast<std::size_t>(row % chunk_cells * chunk_cells + column % chunk_cells);
        return (sw_ne[cell / 8] >> (cell % 8) & 1) != 0 ? Diagonal::sw_ne : Diagonal::nw_se;
    }
};

namespace {

// What a slot holds, made by `make` where it is empty; of several threads that make it one keeps its own.
template <class Kept, class Make>
Kept& kept_in(std::atomic<Kept*>& slot, const Make& make) {
    if (Kept* const there = slot.load(std::memory_order_acquire)) return *there;
    Kept* const made = make();
    Kept* none = nullptr;
    if (slot.compare_exchange_strong(none, made, std::memory_order_acq_rel)) return *made;
    delete made;  // another thread was faster
    return *none;
}

}  // namespace

TrueSurface::TrueSurface(const HeightField& field, double exaggeration, int threads,
                         const std::vector<char>* masked)
    : field_(field), exaggeration_(exaggeration), masked_(masked) {
    const PostGrid& grid = field.grid;
    if (grid.net && !field.N_of_posts_m.empty()) {
        const auto [lowest, highest] =
            std::minmax_element(field.N_of_posts_m.begin(), field.N_of_posts_m.end());
        N_range_m_ = {static_cast<double>(*lowest), static_cast<double>(*highest)};
    }
    // Posts of a net that are not in memory have theirs from between these nodes.
    if (!field.undulation.N_m.empty() && (!grid.net || field.N_of_posts_m.empty())) {
        for (int row = 0; !grid.net && row < grid.rows(); ++row)
            N_rows_.push_back(field.undulation.row_between(row_lat_deg(grid, row)));
        for (int column = 0; !grid.net && column < grid.columns(); ++column)
            N_columns_.push_back(field.undulation.column_between(grid.lon.at_deg(column)));
        const auto [lowest, highest] =
            std::minmax_element(field.undulation.N_m.begin(), field.undulation.N_m.end());
        N_range_m_ = {static_cast<double>(*lowest), static_cast<double>(*highest)};
    }
    if (grid.rows() < 2 || grid.columns() < 2) return;
    const int down = divided_up(grid.rows() - 1, chunk_cells),
              across = divided_up(grid.columns() - 1, chunk_cells);
    levels_ = chunk_level + 1;
    while ((std::max(down, across) - 1) >> (levels_ - 1 - chunk_level) > 0) ++levels_;
    chunk_rows_ = std::vector<std::atomic<ChunkRow*>>(static_cast<std::size_t>(down));
    measure_above(threads);
    if (grid.net) place_corners(threads);
}

void TrueSurface::place_corners(int threads) {
    const PostGrid& grid = field_.grid;
    corners_.rows = divided_up(grid.rows() - 1, block_cells) + 1;
    corners_.columns = divided_up(grid.columns() - 1, block_cells) + 1;
    const auto columns = static_cast<std::size_t>(corners_.columns);
    corners_.normals.resize(static_cast<std::size_t>(corners_.rows) * columns);
    in_parallel(corners_.rows, threads, [&](int row) {
        for (std::size_t column = 0; column < columns; ++column)
            corners_.normals[static_cast<std::size_t>(row) * columns + column] =
                grid.net->normal_at(std::min(row * block_cells, grid.rows() - 1),
                                    std::min(static_cast<int>(column) * block_cells, grid.columns() - 1));
    });
}

TrueSurface::~TrueSurface() {
    for (const std::atomic<ChunkRow*>& row : chunk_rows_) {
        const std::unique_ptr<ChunkRow> slots(row.load());
        if (!slots) continue;
        for (const ChunkSlot& slot : slots->slots) {
            delete slot.layers.load();
            delete slot.diagonals.load();
        }
    }
}

std::pair<int, int> TrueSurface::blocks(int level) const {
    const int cells = block_cells << level;
    return {divided_up(field_.grid.rows() - 1, cells), divided_up(field_.grid.columns() - 1, cells)};
}

std::optional<double> TrueSurface::post_h_m(int row, int column) const {
    const PostGrid& grid = field_.grid;
    float H_m = field_.H_at_post_m(row, column);
    if (is_void(H_m)) return std::nullopt;
    if (row == 0 || row == grid.rows() - 1 || column == grid.columns() - 1) {
        column = canonical_column(field_, row, column);
        H_m = field_.H_at_post_m(row, column);
    }
    const double H = static_cast<double>(H_m) * exaggeration_;
    if (grid.net) return H + field_.N_at_post_m(row, column);
    if (N_rows_.empty()) return H;
    return H + field_.undulation.at_m(N_rows_[static_cast<std::size_t>(row)],
                                      N_columns_[static_cast<std::size_t>(column)]);
}

void TrueSurface::row_h_m(int row, int first_column, std::span<double> h_m) const {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const PostGrid& grid = field_.grid;
    std::size_t i = 0;
    // But for those of the first row, the last, and the last column, posts are points of their own.
    if (row > 0 && row < grid.rows() - 1 && !grid.net && !N_rows_.empty()) {
        const std::size_t own =
            std::min(h_m.size(), static_cast<std::size_t>(std::max(0, grid.columns() - 1 - first_column)));
        std::vector<float> read(field_.posts ? own : 0);
        if (field_.posts) field_.posts->row_H_m(row, first_column, read);
        const float* const H_m =
            field_.posts
                ? read.data()
                : &field_.H_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns()) +
                              static_cast<std::size_t>(first_column)];
        const UndulationField::Between& N_row = N_rows_[static_cast<std::size_t>(row)];
        for (; i < own; ++i) {
            const auto column = static_cast<std::size_t>(first_column) + i;
            h_m[i] = is_void(H_m[i]) ? none
                                     : static_cast<double>(H_m[i]) * exaggeration_ +
                                           field_.undulation.at_m(N_row, N_columns_[column]);
        }
    }
    for (; i < h_m.size(); ++i) h_m[i] = post_h_m(row, first_column + static_cast<int>(i)).value_or(none);
}

std::optional<double> TrueSurface::h_m(double lat_deg, double lon_deg) const {
    return h_on_grid_m(
        field_.grid, [this](int row, int column) { return post_h_m(row, column); },
        [this](int row, int column) { return diagonal_at(row, column); }, lat_deg, lon_deg);
}

std::optional<double> TrueSurface::h_at_m(double row, double column) const {
    return h_at_row_column_m(
        field_.grid, [this](int r, int c) { return post_h_m(r, c); },
        [this](int r, int c) { return diagonal_at(r, c); }, row, column);
}

std::optional<TrueSurface::Slope> TrueSurface::slope_at(double row, double column) const {
    const PostGrid& grid = field_.grid;
    if (grid.rows() < 2 || grid.columns() < 2) return std::nullopt;
    const int north = std::clamp(static_cast<int>(std::floor(row)), 0, grid.rows() - 2);
    const int west = std::clamp(static_cast<int>(std::floor(column)), 0, grid.columns() - 2);
    const Diagonal diagonal = diagonal_at(north, west);
    const bool is_west = west_of_diagonal(diagonal, row - north, column - west) >= 0.0;
    std::array<std::array<double, 2>, 2> h_m{};
    for (const auto& [down, right] : cell_corners(diagonal, is_west)) {
        const auto post_m = post_h_m(north + down, west + right);
        if (!post_m) return std::nullopt;
        h_m[static_cast<std::size_t>(down)][static_cast<std::size_t>(right)] = *post_m;
    }
    const auto [unused, down_m, right_m] =
        cell_plane(diagonal, is_west, h_m[0][0], h_m[0][1], h_m[1][0], h_m[1][1]);
    if (grid.net) {
        const LatticeGeoreference::LatticeFrame local_frame = grid.net->local_frame_at(row, column);
        const double down = down_m / local_frame.row_m, right = right_m / local_frame.column_m;
        const double cosine = std::cos(local_frame.turn_rad), sine = std::sin(local_frame.turn_rad);
        return Slope{sine * right - cosine * down, cosine * right + sine * down};
    }
    const double lat_deg = std::clamp(grid.lat.at_deg(0) - row * grid.lat.spacing_deg(), -90.0, 90.0);
    const PostSpacing apart = post_spacing(grid, lat_deg);
    return Slope{-down_m / apart.row_m, right_m / apart.column_m};
}

// From the posts' H and the range of N alone: quick, and wide enough.
Layer TrueSurface::scanned_layer(int chunk_row, int chunk_column) const {
    const PostGrid& grid = field_.grid;
    const int last_row = std::min((chunk_row + 1) * chunk_cells, grid.rows() - 1);
    const int last_column = std::min((chunk_column + 1) * chunk_cells, grid.columns() - 1);
    float lowest = std::numeric_limits<float>::infinity(), highest = -lowest;
    for (int row = chunk_row * chunk_cells; row <= last_row; ++row) {
        const float* const posts =
            field_.H_m.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns());
        const int first_column = chunk_column * chunk_cells;
        take_into_range(posts + first_column, last_column - first_column + 1, lowest, highest);
    }
    // Posts that are one point are as high as one of them, which may be another chunk's.
    const auto take = [&](int row, int column) {
        if (is_void(field_.H_at_post_m(row, column))) return false;
        const float H_m = field_.H_at_post_m(row, canonical_column(field_, row, column));
        lowest = std::min(lowest, H_m);
        highest = std::max(highest, H_m);
        return true;
    };
    for (const int row : {0, grid.rows() - 1}) {
        if (row < chunk_row * chunk_cells || row > last_row) continue;
        int column = chunk_column * chunk_cells;
        while (column <= last_column && !take(row, column)) ++column;
    }
    for (int row = chunk_row * chunk_cells; last_column == grid.columns() - 1 && row <= last_row; ++row)
        take(row, last_column);
    if (lowest > highest) return no_layer;
    return {static_cast<double>(lowest) * exaggeration_, static_cast<double>(highest) * exaggeration_};
}

// Of posts that are not in memory, where they tell it. Posts that are one point are as high as one of them:
// of those nothing is known.
std::optional<Layer> TrueSurface::layer_of_source(int chunk_row, int chunk_column) const {
    const PostGrid& grid = field_.grid;
    const int first_row = chunk_row * chunk_cells, last_row = first_row + chunk_cells;
    const int first_column = chunk_column * chunk_cells, last_column = first_column + chunk_cells;
    if (grid.net || first_row == 0 || last_row >= grid.rows() - 1 || last_column >= grid.columns() - 1)
        return std::nullopt;
    const auto range = field_.posts->range_of_page(chunk_row, chunk_column);
    if (!range) return std::nullopt;
    const auto [lowest_N_m, highest_N_m] =
        field_.undulation.range_m(grid.lat.at_deg(first_row), grid.lat.at_deg(last_row),
                                  grid.lon.at_deg(first_column), grid.lon.at_deg(last_column));
    return Layer{range->lowest_H_m * exaggeration_ + static_cast<double>(lowest_N_m) - slack_m,
                 range->highest_H_m * exaggeration_ + static_cast<double>(highest_N_m) + slack_m};
}

void TrueSurface::measure_above(int threads) {
    // Of posts that are read when they are asked for, one layer holds all.
    if (field_.posts) return;
    const auto [down, across] = blocks(chunk_level);
    std::vector<Layer> chunks(static_cast<std::size_t>(down) * static_cast<std::size_t>(across));
    const int columns = across;
    in_parallel(down, threads, [&](int row) {
        for (int column = 0; column < columns; ++column) {
            Layer layer = scanned_layer(row, column);
            layer.lowest_h_m += N_range_m_.lowest_h_m - slack_m;
            layer.highest_h_m += N_range_m_.highest_h_m + slack_m;
            chunks[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column)] = layer;
        }
    });
    above_.push_back(std::move(chunks));
    for (int level = chunk_level + 1; level < levels_; ++level) {
        const auto [rows_below, columns_below] = blocks(level - 1);
        const auto [rows, columns_here] = blocks(level);
        std::vector<Layer> layers(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns_here),
                                  no_layer);
        for (int row = 0; row < rows_below; ++row) {
            for (int column = 0; column < columns_below; ++column) {
                Layer& layer =
                    layers[static_cast<std::size_t>(row / 2) * static_cast<std::size_t>(columns_here) +
                           static_cast<std::size_t>(column / 2)];
                layer = joined(
                    layer,
                    above_.back()[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_below) +
                                  static_cast<std::size_t>(column)]);
            }
        }
        above_.push_back(std::move(layers));
    }
}

TrueSurface::Chunk* TrueSurface::new_chunk(int chunk_row, int chunk_column) const {
    const PostGrid& grid = field_.grid;
    auto chunk = std::make_unique<Chunk>();
    // Who asks for layers asks for diagonals, too.
    static_cast<void>(chunk_diagonals(chunk_row, chunk_column));
    constexpr int side = 1 << chunk_level;
    const int first_row = chunk_row * chunk_cells, first_column = chunk_column * chunk_cells;
    const int rows = std::min(chunk_cells, grid.rows() - 1 - first_row) + 1;
    const int columns = std::min(chunk_cells, grid.columns() - 1 - first_column) + 1;
    std::vector<double> h_m(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
    const auto row_of = [&](int row) {
        return std::span(h_m).subspan(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns),
                                      static_cast<std::size_t>(columns));
    };
    for (int row = 0; row < rows; ++row) row_h_m(first_row + row, first_column, row_of(row));
    for (int i = 0; i < side * side; ++i) {
        const int north = i / side * block_cells, west = i % side * block_cells;
        Layer layer = no_layer;
        for (int row = north; row <= std::min(north + block_cells, rows - 1); ++row)
            for (int column = west; column <= std::min(west + block_cells, columns - 1); ++column)
                if (const double h = row_of(row)[static_cast<std::size_t>(column)]; !std::isnan(h))
                    layer = joined(layer, {h, h});
        // No cell of the grid begins there.
        const bool beyond = north >= rows - 1 || west >= columns - 1;
        chunk->put(0, beyond ? no_layer : layer);
    }
    for (int level = 1; level <= chunk_level; ++level) {
        const int here = 1 << (chunk_level - level);
        for (int i = 0; i < here * here; ++i) {
            const int row = 2 * (i / here), column = 2 * (i % here);
            chunk->put(level, joined(joined(chunk->at(level - 1, row, column),
                                            chunk->at(level - 1, row, column + 1)),
                                     joined(chunk->at(level - 1, row + 1, column),
                                            chunk->at(level - 1, row + 1, column + 1))));
        }
    }
    return chunk.release();
}

// Of the chunk's cells, by the posts around them.
TrueSurface::ChunkDiagonals* TrueSurface::new_chunk_diagonals(int chunk_row, int chunk_column) const {
    const PostGrid& grid = field_.grid;
    const int first_row = chunk_row * chunk_cells, first_column = chunk_column * chunk_cells;
    constexpr std::size_t row_bytes = ChunkDiagonals::row_bytes;
    auto diagonals = std::make_unique<ChunkDiagonals>();
    DiagonalRows rows(chunk_cells);
    for (int row = first_row - 1; row <= std::min(first_row + chunk_cells, grid.rows() - 1) + 1; ++row) {
        decisive_steps_of_row(field_, row, first_column - 1, masked_, rows.next());
        rows.take();
        const int cell_row = row - 2 - first_row;
        if (cell_row < 0 || cell_row >= chunk_cells) continue;
        rows.decide(
            std::span(diagonals->sw_ne).subspan(static_cast<std::size_t>(cell_row) * row_bytes, row_bytes));
    }
    return diagonals.release();
}

TrueSurface::ChunkSlot& TrueSurface::slot_of(int row, int column) const {
    ChunkRow& slots = kept_in(chunk_rows_[static_cast<std::size_t>(row)], [this] {
        return new ChunkRow(static_cast<std::size_t>(blocks(chunk_level).second));
    });
    return slots.slots[static_cast<std::size_t>(column)];
}

Diagonal TrueSurface::diagonal_at(int row, int column) const {
    // As the chunk knows it, where one looked at it before.
    const ChunkDiagonals* const known =
        slot_of(row / chunk_cells, column / chunk_cells).diagonals.load(std::memory_order_acquire);
    return known == nullptr ? cell_diagonal(field_, row, column, masked_) : known->at(row, column);
}

Diagonal TrueSurface::diagonal_of_many(int row, int column) const {
    return chunk_diagonals(row / chunk_cells, column / chunk_cells).at(row, column);
}

const TrueSurface::ChunkDiagonals& TrueSurface::chunk_diagonals(int row, int column) const {
    return kept_in(slot_of(row, column).diagonals, [&] { return new_chunk_diagonals(row, column); });
}

const TrueSurface::Chunk& TrueSurface::chunk(int row, int column) const {
    return kept_in(slot_of(row, column).layers, [&] { return new_chunk(row, column); });
}

Layer TrueSurface::layer(const Block& block) const {
    if (block.level < chunk_level) {
        const int in_chunk = chunk_level - block.level, mask = (1 << in_chunk) - 1;
        return chunk(block.row >> in_chunk, block.column >> in_chunk)
            .at(block.level, block.row & mask, block.column & mask);
    }
    if (above_.empty()) {
        if (block.level == chunk_level)
            if (const std::optional<Layer> known = layer_of_source(block.row, block.column)) return *known;
        const HeightRange range = height_range(field_);
        return {static_cast<double>(range.lowest_m) * exaggeration_ + N_range_m_.lowest_h_m - slack_m,
                static_cast<double>(range.highest_m) * exaggeration_ + N_range_m_.highest_h_m + slack_m};
    }
    const int across = blocks(block.level).second;
    return above_[static_cast<std::size_t>(block.level - chunk_level)]
                 [static_cast<std::size_t>(block.row) * static_cast<std::size_t>(across) +
                  static_cast<std::size_t>(block.column)];
}

}  // namespace oro
