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
#include "core/net/lattice_georeference.h"
#include "core/seam/mesh_casters.h"
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

// So many steps of a page's places as a colour's 24 bits count; exact.
double steps_of_colour(VertexColour colour) {
    const std::uint32_t code =
        colour.red | std::uint32_t{colour.green} << 8U | std::uint32_t{colour.blue} << 16U;
    return static_cast<double>(code) / static_cast<double>(gpu::seam_unit);
}

SeamQuad quad_of(const SeamPiece& piece) {
    SeamQuad quad;
    quad.count = 3;
    for (std::size_t i = 0; i < 3; ++i) {
        quad.corners[i] = piece.corners[i];
        quad.vectors[i] = piece.corners[i].normal;
    }
    if (piece.two_sided)
        quad.vectors[3] = {1.0, static_cast<double>(piece.look) / gpu::mesh_looks,
                           static_cast<double>(piece.tone)};
    if (piece.look == gpu::mesh_look_coloured)
        for (std::size_t i = 0; i < 3; ++i)
            quad.vectors[4][static_cast<int>(i)] = steps_of_colour(piece.colours[i]);
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

// The plane that touches the Earth's normals in the middle of a seam.
struct MiddlePlane {
    glm::dvec3 middle, east, north;
    glm::dvec2 low{1.0e30}, high{-1.0e30};

    [[nodiscard]] glm::dvec2 at(const glm::dvec3& normal) const {
        return glm::dvec2(glm::dot(normal, east), glm::dot(normal, north)) / glm::dot(normal, middle);
    }
    [[nodiscard]] glm::dvec3 normal(const glm::dvec2& point) const {
        return glm::normalize(middle + point.x * east + point.y * north);
    }
};

glm::dvec3 up_at(const SeamCorner& corner) {
    // Heights are small beside the Earth: what is missing is made up for by the slack around.
    return glm::normalize(corner.at.m / glm::dvec3(1.0, 1.0, 1.0 - wgs84_e2));
}

template <class Visit>
void for_each_corner(const std::vector<SeamQuad>& quads, const Visit& visit) {
    for (const SeamQuad& quad : quads)
        for (int i = 0; i < quad.count; ++i) visit(quad.corners[static_cast<std::size_t>(i)]);
}

Result<MiddlePlane> plane_of(const std::vector<SeamQuad>& quads) {
    MiddlePlane plane;
    glm::dvec3 sum(0.0);
    for_each_corner(quads, [&](const SeamCorner& corner) { sum += up_at(corner); });
    plane.middle = glm::normalize(sum);
    const glm::dvec3 pole =
        std::abs(plane.middle.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
    plane.east = glm::normalize(glm::cross(pole, plane.middle));
    plane.north = glm::cross(plane.middle, plane.east);
    bool near = glm::length(sum) > 0.0;
    for_each_corner(quads, [&](const SeamCorner& corner) {
        near = near && glm::dot(up_at(corner), plane.middle) > 0.86;
        const glm::dvec2 point = plane.at(up_at(corner));
        plane.low = glm::min(plane.low, point);
        plane.high = glm::max(plane.high, point);
    });
    if (!near)
        return Error{ErrorKind::failed, "grids drawn together",
                     "their seam reaches over more than 60 degrees"};
    constexpr double slack = 1.0e-5;  // 60 m
    plane.low -= slack;
    plane.high += slack;
    return plane;
}

// A net over the seam, whose posts stand for nothing: it says where in the region a place is.
Result<PostGrid> grid_over(const MiddlePlane& plane, int pages) {
    const int columns = pages * static_cast<int>(gpu::page_quads) + 1;
    ORO_TRY(std::shared_ptr<const LatticeGeoreference> net,
            LatticeGeoreference::fit(
                posts, columns,
                [&](std::span<const PostNumber> asked, std::span<PostPlace> places) -> Result<void> {
                    for (std::size_t i = 0; i < asked.size(); ++i) {
                        const glm::dvec2 share(asked[i].column / (columns - 1.0),
                                               1.0 - asked[i].row / (posts - 1.0));
                        places[i] =
                            place_of_normal(plane.normal(plane.low + share * (plane.high - plane.low)));
                    }
                    return {};
                }));
    return grid_on_net(std::move(net));
}

class SeamPages : public RegionPages {
  public:
    SeamPages(RegionFacts facts, std::vector<SeamQuad> quads, std::size_t pieces, MeshCasters casters)
        : RegionPages(std::move(facts), 1),
          casters_(std::move(casters)),
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
    [[nodiscard]] bool is_seam() const override { return true; }
    [[nodiscard]] const MeshCasters* mesh_casters() const override {
        return casters_.nodes.empty() ? nullptr : &casters_;
    }
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

    MeshCasters casters_;
    std::vector<SeamQuad> quads_;
    std::size_t piece_pages_, pieces_;
    std::vector<PageRecord> records_;
};

// A sphere around points, with slack for their rounding.
struct Around {
    glm::dvec3 low{std::numeric_limits<double>::max()}, high{-std::numeric_limits<double>::max()};
    void hold(const glm::dvec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    [[nodiscard]] glm::dvec3 centre() const { return 0.5 * (low + high); }
    [[nodiscard]] double radius() const {
        return 0.5 * glm::length(high - low) + 1.0e-2 + 1.0e-6 * glm::length(high);
    }
};

PageRecord SeamPages::record_of(int page) const {
    PageRecord record;
    PageSummary& summary = record.summary;
    summary.index = {0, page, 0};
    const std::span<const SeamQuad> quads = quads_on(page);
    Around around;
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
    const PostPlace middle = place_of_normal(up_at({Ecef{around.centre()}, 0.0, {}}));
    summary.origin = {middle.lat_deg, middle.lon_deg, 0.5 * (summary.lowest_h_m + summary.highest_h_m)};
    set_page_frame(summary);
    summary.centre_m = glm::dvec3(
        glm::vec3(glm::transpose(summary.ecef_from_page) * (around.centre() - summary.origin_ecef.m)));
    summary.radius_m = summary.lod_radius_m = record.reach_m = around.radius();
    // Never behind the horizon: closers reach out of what bounds them.
    summary.horizon = record.horizon = {glm::normalize(around.centre()), 4.0};
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
        Around around;
        for (const glm::dvec3& point : points[i]) around.hold(point);
        const bool there = !points[i].empty();
        const auto radius = there ? static_cast<float>(around.radius()) : -1.0F;
        gpu::MeshletBounds& bounds = block.meshlets[i];
        bounds = {there ? gpu::vec3(around.centre()) : gpu::vec3(0.0F),
                  radius,
                  gpu::vec3(0.0F),
                  4.0F,
                  0.0F,
                  radius};
        // Asked of pieces alone: skirts reach out of it.
        if (there) block.boxes[i] = node_box(points[i], bounds, summary.origin.lat_deg);
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
        const auto put = [&](const std::array<int, 2>& post, std::size_t axis, std::int64_t steps) {
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

// Neighbours on the ground near each other in the list, so that pages and meshlets are small.
template <class Item, class Place>
void sort_by_place(std::vector<Item>& items, const Place& place) {
    std::vector<std::pair<std::uint64_t, std::size_t>> order;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const glm::dvec2 share = glm::clamp(place(items[i]), 0.0, 1.0);
        const auto x = static_cast<std::uint64_t>(share.x * 65535.0),
                   y = static_cast<std::uint64_t>(share.y * 65535.0);
        std::uint64_t key = 0;  // bits of both in turn
        for (unsigned bit = 0; bit < 16; ++bit)
            key |= (x >> bit & 1U) << (2 * bit) | (y >> bit & 1U) << (2 * bit + 1);
        order.emplace_back(key, i);
    }
    std::sort(order.begin(), order.end());
    std::vector<Item> sorted;
    sorted.reserve(items.size());
    for (const auto& [key, i] : order) sorted.push_back(items[i]);
    items = std::move(sorted);
}

}  // namespace

Result<std::unique_ptr<RegionPages>> seam_pages(const Seam& seam, const UndulationField& undulation,
                                                const RegionShape& shape) {
    std::vector<SeamQuad> pieces, skirts;
    for (const SeamPiece& piece : seam.pieces) pieces.push_back(quad_of(piece));
    for (const SeamSkirt& skirt : seam.skirts) std::ranges::copy(quads_of(skirt), std::back_inserter(skirts));
    std::vector<SeamQuad> all = pieces;
    all.insert(all.end(), skirts.begin(), skirts.end());
    ORO_TRY(const MiddlePlane plane, plane_of(all));
    const auto place = [&](const SeamQuad& quad) {
        return (plane.at(up_at(quad.corners[0])) - plane.low) / (plane.high - plane.low);
    };
    sort_by_place(pieces, place);
    sort_by_place(skirts, place);
    const std::size_t first_skirt = pieces.size();
    const std::size_t pages = SeamPages::pages_for(first_skirt) + SeamPages::pages_for(skirts.size());
    all = std::move(pieces);
    all.insert(all.end(), skirts.begin(), skirts.end());
    ORO_TRY(PostGrid grid, grid_over(plane, static_cast<int>(pages)));
    HeightField field;
    field.grid = grid;
    field.undulation = undulation;
    field.N_of_posts_m = N_of_net_m(*grid.net, undulation, thread_count());
    std::uint64_t triangles = 0;
    for (const SeamQuad& quad : all) triangles += static_cast<std::uint64_t>(quad.count - 2);
    RegionFacts facts{std::move(grid), drawn_undulation(field), shape, triangles};
    return std::unique_ptr<RegionPages>(std::make_unique<SeamPages>(
        std::move(facts), std::move(all), first_skirt, mesh_casters_of(seam.pieces)));
}

}  // namespace oro
