#include "geo/tilesets/ground_model.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <optional>
#include <unordered_map>

#include "core/frame/lazy_pyramid.h"
#include "core/lod/levels_gpu.h"
#include "core/terrain/cell_diagonal.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/page_posts.h"
#include "geo/tilesets/post_place.h"
#include "geo/tilesets/tile_bounds.h"

namespace oro {
namespace {

constexpr int node_side = static_cast<int>(gpu::meshlets_per_side);
constexpr int node_quads = static_cast<int>(gpu::meshlet_quads);

// Goes from the coarsest page down and takes the nodes that are good enough.
class ModelBuilder {
  public:
    ModelBuilder(const RegionPages& pages, double largest_error_m)
        : pages_(pages),
          pyramid_(pages),
          grid_(pages.facts().grid),
          largest_error_m_(largest_error_m),
          block_(std::make_unique<gpu::PageBlock>()) {
        const PostPlace middle = grid_.place_at(0.5 * (grid_.rows() - 1), 0.5 * (grid_.columns() - 1));
        model_.origin = {middle.lat_deg, normalised_lon_deg(middle.lon_deg), 0.0};
        origin_m_ = ecef_from_geodetic(model_.origin).m;
        enu_from_ecef_ = glm::transpose(ecef_from_enu(model_.origin.lat_deg, model_.origin.lon_deg));
    }
    Result<GroundModel> build();

  private:
    [[nodiscard]] bool acceptable(int level, int row, int column) const;
    [[nodiscard]] std::uint32_t edges_to_coarser(int level, int row, int column) const;
    Result<void> visit(const PageIndex& page);
    void add_node(const PageIndex& page, const PagePosts& posts, int row, int column);
    [[nodiscard]] std::optional<glm::dvec3> place(const PagePosts& posts, int row, int column) const;
    [[nodiscard]] bool is_there(const PagePosts& posts, int row, int column) const {
        return steps_at(row, column) != void_height_steps && posts.region_post(row, column);
    }
    // Of a post of the loaded page, -1 .. 129.
    [[nodiscard]] std::int32_t steps_at(int row, int column) const {
        return block_->heights[(row + 1) * static_cast<int>(gpu::height_stride) + column + 1];
    }
    std::uint32_t vertex(const PagePosts& posts, int level, int row, int column);

    const RegionPages& pages_;
    LazyPyramid pyramid_;
    const PostGrid& grid_;
    double largest_error_m_;
    std::unique_ptr<gpu::PageBlock> block_;
    GroundModel model_;
    glm::dvec3 origin_m_{};
    glm::dmat3 enu_from_ecef_{};
    std::unordered_map<std::uint64_t, std::uint32_t> numbers_;  // of vertices, by post of the region
    double certified_m_{}, farthest_m_{}, lowest_h_m_{1.0e9}, highest_h_m_{-1.0e9};
};

bool ModelBuilder::acceptable(int level, int row, int column) const {
    if (level >= pyramid_.levels()) return false;
    const gpu::MeshletBounds& node = pyramid_.page_of_node(level, row, column).node(row, column);
    return node.radius >= 0.0F && (level == 0 || static_cast<double>(node.error_m) <= largest_error_m_);
}

// What lies beyond an edge is coarser where it may be.
std::uint32_t ModelBuilder::edges_to_coarser(int level, int row, int column) const {
    const LevelGrid& grid = pyramid_.grid(level);
    const int columns = grid.column.nodes();
    const auto coarser = [&](int other_row, int other_column) {
        if (other_row < 0 || other_row >= grid.row.nodes()) return false;
        if (other_column < 0 || other_column >= columns) {
            if (!pyramid_.wraps_longitude()) return false;
            other_column = (other_column + columns) % columns;
        }
        return acceptable(level + 1, other_row / 2, other_column / 2);
    };
    return (coarser(row - 1, column) ? gpu::edge_north : 0U) |
           (coarser(row, column + 1) ? gpu::edge_east : 0U) |
           (coarser(row + 1, column) ? gpu::edge_south : 0U) |
           (coarser(row, column - 1) ? gpu::edge_west : 0U);
}

// By rows and columns of the page, -1 .. 129. Less the origin, in its frame.
std::optional<glm::dvec3> ModelBuilder::place(const PagePosts& posts, int row, int column) const {
    if (!is_there(posts, row, column)) return std::nullopt;
    const std::int32_t steps = steps_at(row, column);
    const std::optional<PageIndex> post = posts.region_post(row, column);
    return enu_from_ecef_ *
           (ecef_above(post_up(grid_, post->row, post->column), steps * height_step_m) - origin_m_);
}

std::uint32_t ModelBuilder::vertex(const PagePosts& posts, int level, int row, int column) {
    const PageIndex post = *posts.region_post(row, column);
    const std::uint64_t key =
        static_cast<std::uint64_t>(post.row) << 32U | static_cast<std::uint32_t>(post.column);
    const auto [entry, is_new] = numbers_.try_emplace(key, static_cast<std::uint32_t>(numbers_.size()));
    if (!is_new) return entry->second;
    const glm::dvec3 own = *place(posts, row, column);
    const auto between = [&](int from_row, int from_column, int to_row, int to_column) {
        return place(posts, to_row, to_column).value_or(own) -
               place(posts, from_row, from_column).value_or(own);
    };
    const glm::dvec3 normal =
        glm::cross(between(row, column - 1, row, column + 1), between(row + 1, column, row - 1, column));
    const glm::dvec3 up = glm::length(normal) > 0.0 ? glm::normalize(normal)
                                                    : enu_from_ecef_ * post_up(grid_, post.row, post.column);
    model_.positions_m.emplace_back(own.x, own.z, -own.y);
    model_.normals.emplace_back(up.x, up.z, -up.y);
    model_.posts.push_back({post.row, post.column, level});
    farthest_m_ = std::max(farthest_m_, glm::length(own));
    const double h_m = steps_at(row, column) * height_step_m;
    lowest_h_m_ = std::min(lowest_h_m_, h_m);
    highest_h_m_ = std::max(highest_h_m_, h_m);
    return entry->second;
}

// row, column: of the node in its page.
void ModelBuilder::add_node(const PageIndex& page, const PagePosts& posts, int row, int column) {
    const LevelGrid& level = pyramid_.grid(page.level);
    const int node_row = page.row * node_side + row, node_column = page.column * node_side + column;
    const std::uint32_t edges = edges_to_coarser(page.level, node_row, node_column);
    const glm::uvec2 cells(static_cast<unsigned>(level.row.quads_of_node(node_row)),
                           static_cast<unsigned>(level.column.quads_of_node(node_column)));
    const unsigned words = 2U * static_cast<unsigned>(row * node_side + column);
    for (unsigned i = 0; i < cells.x; ++i) {
        for (unsigned j = 0; j < cells.y; ++j) {
            const unsigned cell = i * static_cast<unsigned>(node_quads) + j;
            const bool sw_ne = (block_->sw_ne[words + cell / 32U] >> (cell % 32U) & 1U) != 0;
            const Diagonal diagonal =
                gpu::drawn_sw_ne(sw_ne, {i, j}, cells, edges) ? Diagonal::sw_ne : Diagonal::nw_se;
            for (const bool west : {true, false}) {
                std::array<glm::uvec2, 3> at{};
                bool whole = true;
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto [down, right] = cell_corners(diagonal, west)[k];
                    at[k] = gpu::stitched_post(
                        {i + static_cast<unsigned>(down), j + static_cast<unsigned>(right)}, cells, edges);
                    whole = whole && is_there(posts, row * node_quads + static_cast<int>(at[k].x),
                                              column * node_quads + static_cast<int>(at[k].y));
                }
                if (!whole || at[0] == at[1] || at[1] == at[2] || at[0] == at[2]) continue;
                for (const glm::uvec2& post : at)
                    model_.indices.push_back(vertex(posts, page.level,
                                                    row * node_quads + static_cast<int>(post.x),
                                                    column * node_quads + static_cast<int>(post.y)));
            }
        }
    }
}

Result<void> ModelBuilder::visit(const PageIndex& page) {
    const PyramidPage& all = pyramid_.page(page);
    const PagePosts posts(grid_, page);
    std::array<bool, 4> descend{};
    bool loaded = false;
    for (int i = 0; i < node_side * node_side; ++i) {
        const gpu::MeshletBounds& node = all.nodes[static_cast<std::size_t>(i)];
        const int row = page.row * node_side + i / node_side,
                  column = page.column * node_side + i % node_side;
        if (acceptable(page.level, row, column)) {
            if (acceptable(page.level + 1, row / 2, column / 2)) continue;
            if (!loaded) ORO_CHECK(pages_.load(page, *block_));
            loaded = true;
            if (page.level > 0) certified_m_ = std::max(certified_m_, static_cast<double>(node.error_m));
            add_node(page, posts, i / node_side, i % node_side);
        } else if (node.radius >= 0.0F || node.error_m > 0.0F) {
            descend[static_cast<std::size_t>(i / node_side / (node_side / 2) * 2 +
                                             i % node_side / (node_side / 2))] = true;
        }
    }
    if (model_.indices.size() / 3 > most_model_triangles)
        return Error{ErrorKind::usage, "--max-error",
                     "takes more than 20,000,000 triangles: give a larger one, or a part with --bbox"};
    for (int i = 0; page.level > 0 && i < 4; ++i) {
        const PageIndex child{2 * page.row + i / 2, 2 * page.column + i % 2, page.level - 1};
        const PageLayout layout = pages_.layout(child.level);
        if (descend[static_cast<std::size_t>(i)] && child.row < layout.rows && child.column < layout.columns)
            ORO_CHECK(visit(child));
    }
    return {};
}

Result<GroundModel> ModelBuilder::build() {
    ORO_CHECK(visit({0, 0, pyramid_.levels() - 1}));
    ORO_CHECK(pyramid_.health());
    if (model_.indices.empty())
        return Error{ErrorKind::no_data, "region", "no triangle has a height at each corner"};
    // Three coordinates that are half a unit of float's last place off.
    constexpr double float_share = 0x1.0p-24;
    const double sag_m = flat_triangle_sag_m(grid_, 1.0, 1.0, highest_h_m_ + certified_m_,
                                             highest_h_m_ - lowest_h_m_ + 2.0 * certified_m_);
    model_.error_m = certified_m_ + sag_m + 0.5 * height_step_m + float_share * farthest_m_;
    return std::move(model_);
}

}  // namespace

Result<GroundModel> ground_model(const RegionPages& pages, double largest_error_m) {
    return ModelBuilder(pages, largest_error_m).build();
}

}  // namespace oro
