#include "core/cluster_frame/cluster_frame.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "core/frame/frame_tables.h"

namespace oro {
namespace {

constexpr std::size_t ahead = 12;

// All of it that is drawn by.
void prefetch_reach(const ClusterReach* reach) {
#if defined(__GNUC__)
    constexpr std::size_t cache_line = 64;
    for (std::size_t at = 0; at < sizeof(ClusterReach); at += cache_line)
        __builtin_prefetch(reinterpret_cast<const char*>(reach) + at);
#else
    static_cast<void>(reach);
#endif
}

// The pages of a plan by where they are: a table of each level, from its first row and column in the plan to
// its last.
class PagesOfPlan {
  public:
    explicit PagesOfPlan(const GridPlan& plan) {
        for (const PageIndex& index : plan.page_indices) {
            if (levels_.size() <= static_cast<std::size_t>(index.level))
                levels_.resize(static_cast<std::size_t>(index.level) + 1);
            Level& level = levels_[static_cast<std::size_t>(index.level)];
            level.north = std::min(level.north, index.row);
            level.south = std::max(level.south, index.row);
            level.west = std::min(level.west, index.column);
            level.east = std::max(level.east, index.column);
        }
        for (Level& level : levels_)
            if (level.south >= level.north)
                level.numbers.resize(static_cast<std::size_t>(level.south - level.north + 1) *
                                         static_cast<std::size_t>(level.columns()),
                                     gpu::no_page);
        for (std::size_t i = 0; i < plan.page_indices.size(); ++i) {
            const PageIndex& index = plan.page_indices[i];
            Level& level = levels_[static_cast<std::size_t>(index.level)];
            level.numbers[level.place(index.row, index.column)] = static_cast<std::uint32_t>(i);
        }
    }
    // The finest that covers all of a cluster, or no_page.
    [[nodiscard]] std::uint32_t over(const ClusterReach& cluster) const {
        constexpr int quads = static_cast<int>(gpu::page_quads);
        // What ends on a page's last post lies in it.
        int north = cluster.first_row / quads, west = cluster.first_column / quads;
        int south = std::max(cluster.first_row, cluster.last_row - 1) / quads;
        int east = std::max(cluster.first_column, cluster.last_column - 1) / quads;
        for (const Level& level : levels_) {
            if (south == north && east == west && north >= level.north && north <= level.south &&
                west >= level.west && west <= level.east) {
                const std::uint32_t number = level.numbers[level.place(north, west)];
                if (number != gpu::no_page) return number;
            }
            north >>= 1;
            south >>= 1;
            west >>= 1;
            east >>= 1;
        }
        return gpu::no_page;
    }

  private:
    struct Level {
        int north{std::numeric_limits<int>::max()}, south{-1};
        int west{std::numeric_limits<int>::max()}, east{-1};
        std::vector<std::uint32_t> numbers;  // row by row
        [[nodiscard]] int columns() const { return east - west + 1; }
        [[nodiscard]] std::size_t place(int row, int column) const {
            return static_cast<std::size_t>(row - north) * static_cast<std::size_t>(columns()) +
                   static_cast<std::size_t>(column - west);
        }
    };
    std::vector<Level> levels_;
};

}  // namespace

void draw_clusters(const PostGrid& grid, std::span<const ResidentCluster> clusters, const ClusterOffer& offer,
                   const Camera& camera, GridPlan& plan, KeptAngles* kept) {
    plan.clusters.on = true;
    const PagesOfPlan pages(plan);
    std::vector<FrameTables::Span> rows, columns;
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    const Ecef eye = camera.eye_ecef();
    plan.clusters.drawn.reserve(clusters.size());
    plan.clusters.boxes.reserve(clusters.size());
    rows.reserve(clusters.size());
    columns.reserve(clusters.size());
    for (std::size_t i = 0; i < clusters.size(); ++i) {
        const ResidentCluster& cluster = clusters[i];
        // Reaches lie anywhere in memory: those of the next clusters are on their way.
        if (i + ahead < clusters.size()) prefetch_reach(clusters[i + ahead].reach);
        const ClusterReach& reach = *cluster.reach;
        const std::uint32_t page = pages.over(reach);
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
        rows.push_back({reach.first_row, reach.last_row});
        columns.push_back({reach.first_column, reach.last_column});
        plan.clusters.boxes.push_back(
            {gpu::vec3(view_from_ecef * (reach.centre.m - eye.m)), reach.half_axes_m});
    }
    plan.clusters.asked = offer.asked;
    plan.constants.cut.rule = offer.rule;
    plan.constants.cut.in_cut = static_cast<gpu::uint>(plan.clusters.in_cut);
    plan.constants.clusters.on = 1;
    plan.constants.clusters.count = static_cast<gpu::uint>(plan.clusters.drawn.size());
    plan.constants.clusters.rows = static_cast<gpu::uint>(plan.row_terms.size());
    plan.constants.clusters.columns = static_cast<gpu::uint>(plan.column_terms.size());
    FrameTables tables(grid, camera.eye, Earth::ellipsoid, kept);
    tables.place_spans(rows, columns);
    const auto append = [](auto& to, const auto& more) { to.insert(to.end(), more.begin(), more.end()); };
    append(plan.row_terms, tables.take_rows());
    append(plan.column_terms, tables.take_columns());
}

}  // namespace oro
