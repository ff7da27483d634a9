#include "core/seam/seam_pages.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <iterator>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/seam/middle_plane.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/node_box.h"
#include "core/terrain/page_on_net.h"

namespace oro {
namespace {

constexpr int posts = static_cast<int>(gpu::page_posts);
constexpr int quads_a_page = seam_quads * seam_quads;

struct PagePost {
    int row, column;
};

std::size_t meshlet_of(const PagePost& post) {
    constexpr int quads_across = static_cast<int>(gpu::meshlet_quads);
    return static_cast<std::size_t>(post.row / quads_across * static_cast<int>(gpu::meshlets_per_side) +
                                    post.column / quads_across);
}

// A quad's posts from its first, and what stands in the posts after it.
constexpr std::array<std::array<int, 2>, 4> corner_posts{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
constexpr std::array<std::array<int, 2>, 5> vector_posts{{{0, 2}, {1, 2}, {2, 0}, {2, 1}, {2, 2}}};

// The first post of each quad of a page. Quads that follow each other are in one meshlet, so that meshlets
// are small.
std::array<PagePost, quads_a_page> posts_of_quads() {
    std::array<PagePost, quads_a_page> first;
    for (int number = 0; number < quads_a_page; ++number)
        first[static_cast<std::size_t>(number)] = {number / seam_quads * seam_stride,
                                                   number % seam_quads * seam_stride};
    std::ranges::stable_sort(first, {}, meshlet_of);
    return first;
}
const std::array<PagePost, quads_a_page> first_posts = posts_of_quads();

// As a page holds it: north-west, south-west, south-east, north-east, this one missing of a piece.
struct SeamQuad {
    std::array<SeamCorner, 4> corners;
    int count{};
    std::array<glm::dvec3, 5> vectors{};  // seam.glsl
};

SeamQuad quad_of(const SeamPiece& piece) {
    SeamQuad quad;
    quad.count = 3;
    for (std::size_t i = 0; i < 3; ++i) {
        quad.corners[i] = piece.corners[i];
        quad.vectors[i] = piece.corners[i].normal;
    }
    return quad;
}

// A skirt's upright part, whose top reaches upwards, and what reaches down and to both sides from its foot:
// seen along the upright part, its top is its foot, and the higher ground's edge is beside it.
constexpr std::size_t quads_a_skirt = 3;
std::array<SeamQuad, quads_a_skirt> quads_of(const SeamSkirt& skirt) {
    const glm::dvec3 still(0.0);
    const auto from_foot = [&](const glm::dvec3& reach) -> SeamQuad {
        return {{skirt.foot[0], skirt.foot[0], skirt.foot[1], skirt.foot[1]},
                4,
                {skirt.foot[0].normal, skirt.foot[1].normal, still, still, reach}};
    };
    return {{{{skirt.top[0], skirt.foot[0], skirt.foot[1], skirt.top[1]},
              4,
              {skirt.top[0].normal, skirt.top[1].normal, still, skirt.up, still}},
             from_foot(0.5 * skirt.side - skirt.up),
             from_foot(-0.5 * skirt.side - skirt.up)}};
}

template <class Visit>
void for_each_corner(const std::vector<SeamQuad>& quads, const Visit& visit) {
    for (const SeamQuad& quad : quads)
        for (int i = 0; i < quad.count; ++i) visit(quad.corners[static_cast<std::size_t>(i)]);
}

class SeamPages : public RegionPages {
  public:
    SeamPages(RegionFacts facts, std::vector<SeamQuad> quads, std::size_t pieces)
        : RegionPages(std::move(facts), 1),
          quads_(std::move(quads)),
          piece_pages_(pages_for(pieces)),
          pieces_(pieces) {
        const std::size_t count = piece_pages_ + pages_for(quads_.size() - pieces_);
        for (std::size_t i = 0; i < count; ++i) records_.push_back(record_of(static_cast<int>(i)));
    }
    static std::size_t pages_for(std::size_t quads) {
        return (quads + quads_a_page - 1) / static_cast<std::size_t>(quads_a_page);
    }

    [[nodiscard]] Result<PageRecord> record(const PageIndex& page) const override {
        return PageRecord(records_[static_cast<std::size_t>(page.column)]);
    }
    Result<void> load(const PageIndex& page, gpu::PageBlock& block) const override;
    Result<void> load_places(const PageIndex& page, const gpu::PageBlock& block,
                             gpu::PagePlaces& places) const override;
    [[nodiscard]] PageContents contents() const override { return PageContents::seam; }
    [[nodiscard]] bool is_skirt(const PageIndex& page) const override {
        return static_cast<std::size_t>(page.column) >= piece_pages_;
    }

  private:
    [[nodiscard]] std::span<const SeamQuad> quads_on(int page) const {
        const auto number = static_cast<std::size_t>(page);
        const bool closes = number >= piece_pages_;
        const std::size_t begin =
            closes ? pieces_ + (number - piece_pages_) * quads_a_page : number * quads_a_page;
        const std::size_t end = std::min(begin + quads_a_page, closes ? quads_.size() : pieces_);
        return std::span(quads_).subspan(begin, end - begin);
    }
    [[nodiscard]] PageRecord record_of(int page) const;

    std::vector<SeamQuad> quads_;
    std::size_t piece_pages_, pieces_;
    std::vector<PageRecord> records_;
};

PageRecord SeamPages::record_of(int page) const {
    PageRecord record;
    PageSummary& summary = record.summary;
    summary.index = {0, page, 0};
    const std::span<const SeamQuad> quads = quads_on(page);
    PointsAround around;
    summary.lowest_h_m = std::numeric_limits<double>::max();
    summary.highest_h_m = -summary.lowest_h_m;
    for (const SeamQuad& quad : quads) {
        for (int i = 0; i < quad.count; ++i) {
            const SeamCorner& corner = quad.corners[static_cast<std::size_t>(i)];
            around.hold(corner.at.m);
            summary.lowest_h_m = std::min(summary.lowest_h_m, corner.h_m);
            summary.highest_h_m = std::max(summary.highest_h_m, corner.h_m);
        }
        summary.triangles += static_cast<std::uint32_t>(quad.count - 2);
    }
    set_page_around(around, summary);
    record.reach_m = summary.radius_m;
    record.horizon = summary.horizon;
    summary.meshlets = gpu::meshlets_per_page;
    for (PageQuarter& quarter : record.quarters) quarter = {summary.centre_m, summary.radius_m, 0.0F};
    return record;
}

Result<void> SeamPages::load(const PageIndex& page, gpu::PageBlock& block) const {
    const PageSummary& summary = records_[static_cast<std::size_t>(page.column)].summary;
    std::fill(std::begin(block.heights), std::end(block.heights), gpu::void_height);
    std::fill(std::begin(block.boxes), std::end(block.boxes), 0U);
    std::fill(std::begin(block.sw_ne), std::end(block.sw_ne), 0U);
    std::vector<std::vector<glm::dvec3>> points(gpu::meshlets_per_page);
    const glm::dmat3 page_from_ecef = glm::transpose(summary.ecef_from_page);
    const std::span<const SeamQuad> quads = quads_on(page.column);
    for (std::size_t number = 0; number < quads.size(); ++number) {
        const SeamQuad& quad = quads[number];
        const auto [row, column] = first_posts[number];
        const std::size_t meshlet = meshlet_of(first_posts[number]);
        for (std::size_t i = 0; i < static_cast<std::size_t>(quad.count); ++i) {
            const int post = (row + corner_posts[i][0] + 1) * static_cast<int>(gpu::height_stride) + column +
                             corner_posts[i][1] + 1;
            block.heights[post] = height_steps(quad.corners[i].h_m);
            points[meshlet].push_back(page_from_ecef * (quad.corners[i].at.m - summary.origin_ecef.m));
        }
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        gpu::MeshletBounds& bounds = block.meshlets[i];
        bounds = bounds_around(points[i]);
        // Asked of pieces alone: skirts reach out of it.
        if (!points[i].empty()) block.boxes[i] = node_box(points[i], bounds, summary.origin.lat_deg);
    }
    set_spacing(facts().grid, summary, block);
    return {};
}

Result<void> SeamPages::load_places(const PageIndex& page, const gpu::PageBlock&,
                                    gpu::PagePlaces& places) const {
    const LatticePoint origin =
        lattice_point(records_[static_cast<std::size_t>(page.column)].summary.origin_ecef.m);
    std::fill(std::begin(places.steps), std::end(places.steps), 0);
    const std::span<const SeamQuad> quads = quads_on(page.column);
    for (std::size_t number = 0; number < quads.size(); ++number) {
        const SeamQuad& quad = quads[number];
        const auto [row, column] = first_posts[number];
        const auto put = [&, row = row, column = column](const std::array<int, 2>& post, std::size_t axis,
                                                         std::int64_t steps) {
            places.steps[static_cast<std::size_t>((row + post[0]) * posts + column + post[1]) * 3 + axis] =
                static_cast<std::int32_t>(steps);
        };
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(quad.count); ++i) {
                const std::int64_t steps =
                    lattice_point(quad.corners[i].at.m).steps[axis] - origin.steps[axis];
                if (std::abs(steps) >= std::int64_t{1} << 31U)
                    return Error{ErrorKind::failed, "grids drawn together",
                                 "their seam reaches more than 1,048 km from the middle of one page"};
                put(corner_posts[i], axis, steps);
            }
            for (std::size_t i = 0; i < quad.vectors.size(); ++i)
                put(vector_posts[i], axis,
                    std::llround(quad.vectors[i][static_cast<int>(axis)] *
                                 static_cast<double>(gpu::seam_unit)));
        }
    }
    return {};
}

std::vector<SeamQuad> sorted(const std::vector<SeamQuad>& quads, const MiddlePlane& plane) {
    std::vector<glm::dvec2> shares;
    for (const SeamQuad& quad : quads) shares.push_back(plane.share(quad.corners[0]));
    std::vector<SeamQuad> in_order;
    for (const std::uint32_t number : order_of_places(shares)) in_order.push_back(quads[number]);
    return in_order;
}

}  // namespace

Result<std::unique_ptr<RegionPages>> seam_pages(const Seam& seam, const UndulationField& undulation,
                                                const RegionShape& shape) {
    std::vector<SeamQuad> pieces, skirts;
    for (const SeamPiece& piece : seam.pieces)
        if (!piece.two_sided) pieces.push_back(quad_of(piece));
    for (const SeamSkirt& skirt : seam.skirts) std::ranges::copy(quads_of(skirt), std::back_inserter(skirts));
    if (pieces.empty() && skirts.empty()) return std::unique_ptr<RegionPages>();
    std::vector<const SeamCorner*> corners;
    const auto add = [&](const SeamCorner& corner) { corners.push_back(&corner); };
    for_each_corner(pieces, add);
    for_each_corner(skirts, add);
    ORO_TRY(const MiddlePlane plane, middle_plane_of(corners, "grids drawn together"));
    std::vector<SeamQuad> all = sorted(pieces, plane);
    const std::size_t first_skirt = all.size();
    std::ranges::copy(sorted(skirts, plane), std::back_inserter(all));
    const std::size_t pages = SeamPages::pages_for(first_skirt) + SeamPages::pages_for(skirts.size());
    ORO_TRY(PostGrid grid, grid_over(plane, static_cast<int>(pages)));
    HeightField field;
    field.grid = grid;
    field.undulation = undulation;
    field.N_of_posts_m = N_of_net_m(*grid.net, undulation, thread_count());
    std::uint64_t triangles = 0;
    for (const SeamQuad& quad : all) triangles += static_cast<std::uint64_t>(quad.count - 2);
    RegionFacts facts{std::move(grid), drawn_undulation(field), shape, triangles};
    return std::unique_ptr<RegionPages>(
        std::make_unique<SeamPages>(std::move(facts), std::move(all), first_skirt));
}

}  // namespace oro
