#include "core/cluster_frame/cluster_frame.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "core/frame/frame_tables.h"

namespace oro {
namespace {

// The pages of a plan by where they are.
class PagesOfPlan {
  public:
    explicit PagesOfPlan(const GridPlan& plan) {
        for (std::size_t i = 0; i < plan.page_indices.size(); ++i) {
            const PageIndex& index = plan.page_indices[i];
            numbers_[{index.level, index.row, index.column}] = static_cast<std::uint32_t>(i);
            top_ = std::max(top_, index.level);
        }
    }
    // The finest that covers all of a cluster, or no_page.
    [[nodiscard]] std::uint32_t over(const ResidentCluster& cluster) const {
        constexpr int quads = static_cast<int>(gpu::page_quads);
        // What ends on a page's last post lies in it.
        const std::int32_t last_row = std::max(cluster.first_row, cluster.last_row - 1);
        const std::int32_t last_column = std::max(cluster.first_column, cluster.last_column - 1);
        for (int level = 0; level <= top_; ++level) {
            const int row = (cluster.first_row / quads) >> level;
            const int column = (cluster.first_column / quads) >> level;
            if ((last_row / quads) >> level != row || (last_column / quads) >> level != column) continue;
            const auto found = numbers_.find({level, row, column});
            if (found != numbers_.end()) return found->second;
        }
        return gpu::no_page;
    }

  private:
    std::map<std::tuple<int, int, int>, std::uint32_t> numbers_;
    int top_{0};
};

}  // namespace

void draw_clusters(const PostGrid& grid, std::span<const ResidentCluster> clusters, const ClusterOffer& offer,
                   const Camera& camera, GridPlan& plan) {
    plan.clusters.on = true;
    const PagesOfPlan pages(plan);
    std::vector<FrameTables::Span> rows, columns;
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    const Ecef eye = camera.eye_ecef();
    for (std::size_t i = 0; i < clusters.size(); ++i) {
        const ResidentCluster& cluster = clusters[i];
        const std::uint32_t page = pages.over(cluster);
        if (page == gpu::no_page) continue;
        plan.clusters.drawn.push_back(
            {{static_cast<gpu::uint>(cluster.address), static_cast<gpu::uint>(cluster.address >> 32U)},
             page,
             cluster.counts,
             cluster.offered.cluster,
             cluster.offered.group,
             cluster.offered.made_by,
             cluster.offered.used_by});
        if (i < offer.in_cut) plan.clusters.in_cut = plan.clusters.drawn.size();
        rows.push_back({cluster.first_row, cluster.last_row});
        columns.push_back({cluster.first_column, cluster.last_column});
        plan.clusters.boxes.push_back(
            {gpu::vec3(view_from_ecef * (cluster.centre.m - eye.m)), cluster.half_axes_m});
    }
    plan.clusters.asked = offer.asked;
    plan.constants.cut.rule = offer.rule;
    plan.constants.cut.in_cut = static_cast<gpu::uint>(plan.clusters.in_cut);
    plan.constants.clusters.on = 1;
    plan.constants.clusters.count = static_cast<gpu::uint>(plan.clusters.drawn.size());
    plan.constants.clusters.rows = static_cast<gpu::uint>(plan.row_terms.size());
    plan.constants.clusters.columns = static_cast<gpu::uint>(plan.column_terms.size());
    FrameTables tables(grid, camera.eye);
    tables.place_spans(rows, columns);
    const auto append = [](auto& to, const auto& more) { to.insert(to.end(), more.begin(), more.end()); };
    append(plan.row_terms, tables.take_rows());
    append(plan.column_terms, tables.take_columns());
}

}  // namespace oro
