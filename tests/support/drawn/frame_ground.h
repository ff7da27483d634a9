// The ground of a frame's pages in double: for tests of what stands on it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/frame/frame_plan.h"
#include "core/frame/region_pages.h"

namespace oro::test {

// A place on the ground as the finest page of a frame has it.
struct FramePlace {
    glm::dvec3 view;                    // metres, view coordinates
    std::array<glm::dvec3, 3> corners;  // of the triangle, likewise
    glm::dvec3 normal;                  // of the smoothed surface there: east, north, up
    double least_share{1.0};            // of a corner: near 0 on an edge
};

// Answers as shaders/growth/growth.glsl and normal_at() of shaders/shade/surface.glsl do, from the same
// blocks of heights. The grid lies on latitudes and longitudes, and light goes straight.
class FrameGround {
  public:
    FrameGround(const RegionPages& pages, const GridPlan& plan, const Camera& camera)
        : pages_(pages),
          grid_(pages.facts().grid),
          eye_(camera.eye_ecef().m),
          view_from_ecef_(camera.view_from_ecef()) {
        for (const PageIndex& page : plan.page_indices) {
            kept_[page] = nullptr;
            coarsest_ = std::max(coarsest_, page.level);
        }
    }

    // Nothing beside the posts, and on a triangle with a void one.
    std::optional<FramePlace> at(double lat_deg, double lon_deg) {
        const PostNumber number{grid_.lat.index_at(lat_deg), grid_.column_at(lon_deg)};
        const int row = static_cast<int>(std::floor(number.row)),
                  column = static_cast<int>(std::floor(number.column));
        if (row < 0 || column < 0 || row >= grid_.rows() - 1 || column >= grid_.columns() - 1) return {};
        Kept* const page = finest(row, column);
        if (page == nullptr) return {};
        const int level = page->index.level, quads = static_cast<int>(gpu::page_quads);
        const auto along = [&](double post, int whole, int first, int last) {
            const int quad = std::clamp((whole - first) >> level, 0, quads - 1),
                      from = first + (quad << level);
            const int span = std::max(std::min(from + (1 << level), last) - from, 1);
            return std::pair(quad, std::clamp((post - from) / span, 0.0, 1.0));
        };
        const auto [quad_row, down] =
            along(number.row, row, (page->index.row * quads) << level, grid_.rows() - 1);
        const auto [quad_column, right] =
            along(number.column, column, (page->index.column * quads) << level, grid_.columns() - 1);
        return place_in(*page, quad_row, quad_column, down, right);
    }

  private:
    struct Kept {
        PageIndex index;
        gpu::PageBlock block;
        std::vector<std::optional<glm::dvec3>> posts;  // view coordinates, once they are asked for
    };
    static constexpr int posts_a_side = static_cast<int>(gpu::page_posts);

    Kept* finest(int row, int column) {
        for (int level = 0; level <= coarsest_; ++level) {
            const auto found = kept_.find({row >> (level + 7), column >> (level + 7), level});
            if (found == kept_.end()) continue;
            if (!found->second) {
                found->second = std::make_unique<Kept>();
                found->second->index = found->first;
                found->second->posts.resize(static_cast<std::size_t>(posts_a_side) * posts_a_side);
                EXPECT_TRUE(pages_.load(found->first, found->second->block).ok());
            }
            return found->second.get();
        }
        return nullptr;
    }

    static int height_steps(const Kept& page, int row, int column) {
        constexpr int stride = static_cast<int>(gpu::height_stride);
        return page.block.heights[(row + 1) * stride + column + 1];
    }
    [[nodiscard]] int region_post(const Kept& page, int number, int of_page, int last) const {
        return std::min(((of_page * static_cast<int>(gpu::page_quads) + number) << page.index.level), last);
    }
    // Of a page's post; nothing where it is void.
    const std::optional<glm::dvec3>& post(Kept& page, int row, int column) {
        auto& kept = page.posts[static_cast<std::size_t>(row * posts_a_side + column)];
        const int steps = height_steps(page, row, column);
        if (kept || steps == gpu::void_height) return kept;
        const double lat_deg = grid_.lat.at_deg(region_post(page, row, page.index.row, grid_.rows() - 1)),
                     lon_deg =
                         grid_.lon.at_deg(region_post(page, column, page.index.column, grid_.columns() - 1));
        const double h_m = steps * static_cast<double>(gpu::height_step_m);
        kept = view_from_ecef_ * (ecef_from_geodetic({lat_deg, lon_deg, h_m}).m - eye_);
        return kept;
    }

    std::optional<FramePlace> place_in(Kept& page, int row, int column, double down, double right) {
        constexpr int side = static_cast<int>(gpu::meshlet_quads),
                      a_side = static_cast<int>(gpu::meshlets_per_side);
        const int meshlet = row / side * a_side + column / side, quad = row % side * side + column % side;
        const bool sw_ne = (page.block.sw_ne[meshlet * 2 + quad / 32] >> (quad % 32) & 1U) != 0;
        const bool east = sw_ne ? down + right > 1.0 : right > down;
        struct Corner {
            int row, column;
            double share;
        };
        std::array<Corner, 3> corners{};
        if (sw_ne && east)
            corners = {{{row + 1, column, 1.0 - right},
                        {row + 1, column + 1, down + right - 1.0},
                        {row, column + 1, 1.0 - down}}};
        else if (sw_ne)
            corners = {
                {{row, column, 1.0 - down - right}, {row + 1, column, down}, {row, column + 1, right}}};
        else if (east)
            corners = {
                {{row, column, 1.0 - right}, {row + 1, column + 1, down}, {row, column + 1, right - down}}};
        else
            corners = {
                {{row, column, 1.0 - down}, {row + 1, column, down - right}, {row + 1, column + 1, right}}};
        FramePlace place{glm::dvec3(0.0), {}, normal_in(page, row, column, down, right)};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& corner = post(page, corners[i].row, corners[i].column);
            if (!corner) return {};
            place.corners[i] = *corner;
            place.view += corners[i].share * *corner;
            place.least_share = std::min(place.least_share, corners[i].share);
        }
        return place;
    }

    // Of posts that all have heights.
    [[nodiscard]] glm::dvec3 normal_in(const Kept& page, int row, int column, double down,
                                       double right) const {
        const int last_row = grid_.rows() - 1, last_column = grid_.columns() - 1;
        const auto slope_of = [&](int at_row, int at_column) {
            const auto step = [&](int change_row, int change_column) {
                const int rows = region_post(page, at_row + change_row, page.index.row, last_row) -
                                 region_post(page, at_row - change_row, page.index.row, last_row),
                          columns =
                              region_post(page, at_column + change_column, page.index.column, last_column) -
                              region_post(page, at_column - change_column, page.index.column, last_column);
                const double rise =
                    static_cast<double>(height_steps(page, at_row + change_row, at_column + change_column)) -
                    height_steps(page, at_row - change_row, at_column - change_column);
                return rise * static_cast<double>(gpu::height_step_m) / std::max(rows + columns, 1);
            };
            return glm::dvec2(step(1, 0), step(0, 1));
        };
        const auto mixed = [](const glm::dvec2& one, const glm::dvec2& other, double share) {
            return one + share * (other - one);
        };
        const glm::dvec2 slope =
            mixed(mixed(slope_of(row, column), slope_of(row, column + 1), right),
                  mixed(slope_of(row + 1, column), slope_of(row + 1, column + 1), right), down);
        const double lat_deg = grid_.lat.at_deg(region_post(page, row, page.index.row, last_row));
        const double column_m =
            std::cos(lat_deg * 0.017453292519943295) * static_cast<double>(page.block.column_spacing_m);
        return glm::normalize(
            glm::dvec3(-slope.y / column_m, slope.x / static_cast<double>(page.block.row_spacing_m), 1.0));
    }

    const RegionPages& pages_;
    const PostGrid& grid_;
    glm::dvec3 eye_;
    glm::dmat3 view_from_ecef_;
    std::map<PageIndex, std::unique_ptr<Kept>> kept_;
    int coarsest_{};
};

}  // namespace oro::test
