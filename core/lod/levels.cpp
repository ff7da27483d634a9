#include "core/lod/levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace oro {
namespace {

constexpr int side = static_cast<int>(gpu::meshlets_per_side);

// A picture's choice among the nodes of pages.
class Choice {
  public:
    Choice(const PyramidPages& all, const Camera& camera, const Tile& tile, double tau_px)
        : pages_(all),
          view_(level_view(camera, tau_px)),
          view_from_ecef_(camera.view_from_ecef()),
          eye_(camera.eye_ecef()),
          planes_(frustum_planes_view(projection_of_tile(camera, tile))),
          horizon_(horizon_eye(all.shape().occluder, eye_)) {}

    NodeSelection select() {
        const int top = pages_.levels() - 1;
        std::vector<PageIndex> pages;
        if (pages_.grid(top).pages().count() > 0) pages.push_back({0, 0, top});
        for (int level = top; level >= 0; --level) {
            std::vector<PageIndex> below;
            for (const PageIndex& page : pages) visit(page, below);
            std::sort(below.begin(), below.end(), [](const PageIndex& a, const PageIndex& b) {
                return a.row != b.row ? a.row < b.row : a.column < b.column;
            });
            pages = std::move(below);
        }
        return std::move(selection_);
    }

  private:
    [[nodiscard]] bool acceptable(int level_number, int row, int column) const;
    [[nodiscard]] bool acceptable_throughout(const PyramidPage& page) const;
    [[nodiscard]] std::uint32_t edges_to_coarser(int level_number, int row, int column) const;
    bool hidden(const PyramidPage& page);
    void visit(const PageIndex& index, std::vector<PageIndex>& below);

    const PyramidPages& pages_;
    LevelView view_;
    glm::dmat3 view_from_ecef_;
    Ecef eye_;
    std::array<Plane, 5> planes_;
    HorizonEye horizon_;
    NodeSelection selection_;
};

// By the GPU's steps: the page's frame rounded to float, then the node's centre in it.
bool Choice::acceptable(int level_number, int row, int column) const {
    if (level_number >= pages_.levels()) return false;
    const PyramidPage& whole = pages_.page_of_node(level_number, row, column);
    const PageSummary& page = whole.summary;
    const gpu::MeshletBounds& node = whole.node(row, column);
    const gpu::mat3 view_from_page(view_from_ecef_ * page.ecef_from_page);
    const gpu::vec3 origin_view(view_from_ecef_ * (page.origin_ecef.m - eye_.m));
    return gpu::node_acceptable(static_cast<gpu::uint>(level_number), node,
                                view_from_page * node.centre + origin_view, view_.pixels_per_tangent,
                                view_.corner_tangent, view_.tau_px);
}

bool Choice::acceptable_throughout(const PyramidPage& page) const {
    const PageSummary& summary = page.summary;
    if (summary.largest_error_m >= gpu::unfit_error_m) return false;
    const glm::dvec3 centre_view =
        view_from_ecef_ * (summary.origin_ecef.m + summary.ecef_from_page * summary.centre_m - eye_.m);
    return gpu::projected_error_px(gpu::vec3(centre_view), static_cast<float>(summary.lod_radius_m),
                                   summary.largest_error_m, view_.pixels_per_tangent,
                                   view_.corner_tangent) <= view_.tau_px;
}

// What is drawn beyond an edge is coarser when it may be: when the neighbour's parent is acceptable.
std::uint32_t Choice::edges_to_coarser(int level_number, int row, int column) const {
    const LevelGrid& grid = pages_.grid(level_number);
    const int columns = grid.column.nodes();
    const auto coarser = [&](int other_row, int other_column) {
        if (other_row < 0 || other_row >= grid.row.nodes()) return false;
        if (other_column < 0 || other_column >= columns) {
            if (!pages_.wraps_longitude()) return false;
            other_column = (other_column + columns) % columns;
        }
        return acceptable(level_number + 1, other_row / 2, other_column / 2);
    };
    return (coarser(row - 1, column) ? gpu::edge_north : 0U) |
           (coarser(row, column + 1) ? gpu::edge_east : 0U) |
           (coarser(row + 1, column) ? gpu::edge_south : 0U) |
           (coarser(row, column - 1) ? gpu::edge_west : 0U);
}

bool Choice::hidden(const PyramidPage& page) {
    if (page.reach_m < 0.0) return true;
    const PageSummary& summary = page.summary;
    const glm::dvec3 centre_view =
        view_from_ecef_ * (summary.origin_ecef.m + summary.ecef_from_page * summary.centre_m - eye_.m);
    if (beyond_frustum(planes_, centre_view, page.reach_m)) {
        ++selection_.pages_beyond_frustum;
        return true;
    }
    if (beyond_horizon(horizon_, page.horizon)) {
        ++selection_.pages_beyond_horizon;
        return true;
    }
    return false;
}

void Choice::visit(const PageIndex& index, std::vector<PageIndex>& below) {
    const PyramidPage& page = pages_.page(index);
    if (hidden(page)) return;
    ++selection_.pages_seen;
    std::array<bool, 4> descend{};
    for (int i = 0; i < side * side; ++i) {
        const gpu::MeshletBounds& node = page.nodes[static_cast<std::size_t>(i)];
        const int row = index.row * side + i / side;
        const int column = index.column * side + i % side;
        if (acceptable(index.level, row, column)) {
            if (!acceptable(index.level + 1, row / 2, column / 2))
                selection_.nodes.push_back(
                    {index.level, row, column, edges_to_coarser(index.level, row, column)});
        } else if (node.radius >= 0.0F || node.error_m > 0.0F) {
            const int quarter = i / side / (side / 2) * 2 + i % side / (side / 2);
            descend[static_cast<std::size_t>(quarter)] = true;
        }
    }
    if (index.level == 0 || acceptable_throughout(page)) return;
    const PageLayout layout = pages_.grid(index.level - 1).pages();
    for (int i = 0; i < 4; ++i) {
        const PageIndex child{2 * index.row + i / 2, 2 * index.column + i % 2, index.level - 1};
        if (descend[static_cast<std::size_t>(i)] && child.row < layout.rows && child.column < layout.columns)
            below.push_back(child);
    }
}

}  // namespace

LevelView level_view(const Camera& camera, double tau_px) {
    const glm::dvec2 tangent = camera.half_fov_tangent();
    const double width = tangent.x * (1.0 + 2.0 / camera.width_px);
    const double height = tangent.y * (1.0 + 2.0 / camera.height_px);
    return {static_cast<float>(0.5 * camera.height_px / tangent.y * (1.0 + 1.0e-6)),
            static_cast<float>(std::hypot(width, height)), static_cast<float>(tau_px)};
}

NodeSelection select_nodes(const PyramidPages& pages, const Camera& camera, const Tile& tile, double tau_px) {
    return Choice(pages, camera, tile, tau_px).select();
}

NodeSelection select_nodes(const LevelPyramid& pyramid, const Camera& camera, const Tile& tile,
                           double tau_px) {
    return select_nodes(PagesOfPyramid(pyramid), camera, tile, tau_px);
}

}  // namespace oro
