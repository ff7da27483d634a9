#include "core/seam/mesh_pages.h"

#include <algorithm>
#include <glm/matrix.hpp>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

#include "core/base/parallel.h"
#include "core/packed/packed_heights.h"
#include "core/seam/mesh_casters.h"
#include "core/seam/mesh_node.h"
#include "core/seam/middle_plane.h"
#include "core/seam/seam_pages.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/node_box.h"
#include "core/terrain/page_on_net.h"

namespace oro {
namespace {

constexpr std::size_t nodes_a_page = gpu::meshlets_per_page;

// What a node is culled by.
struct NodeBounds {
    gpu::MeshletBounds bounds;
    gpu::uint box;
};

struct MeshPage {
    PageRecord record;
    std::vector<NodeBounds> nodes;
    std::vector<std::uint32_t> words;
};

NodeBounds bounds_of(const MeshNode& node, const PageSummary& summary) {
    const glm::dmat3 page_from_ecef = glm::transpose(summary.ecef_from_page);
    std::vector<glm::dvec3> points;
    for (const glm::dvec3& place : node.places_m)
        points.push_back(page_from_ecef * (place - summary.origin_ecef.m));
    NodeBounds around{bounds_around(points), 0};
    around.box = node_box(points, around.bounds, summary.origin.lat_deg);
    if (!node.has_last_half) around.box |= gpu::first_rows << gpu::halves_bit;
    return around;
}

Result<MeshPage> page_of(std::span<MeshNode> nodes, int number) {
    MeshPage page;
    PageSummary& summary = page.record.summary;
    summary.index = {0, number, 0};
    PointsAround around;
    summary.lowest_h_m = std::numeric_limits<double>::max();
    summary.highest_h_m = -summary.lowest_h_m;
    for (const MeshNode& node : nodes) {
        for (const glm::dvec3& place : node.places_m) around.hold(place);
        summary.lowest_h_m = std::min(summary.lowest_h_m, node.lowest_h_m);
        summary.highest_h_m = std::max(summary.highest_h_m, node.highest_h_m);
        summary.triangles += node.triangles;
    }
    set_page_around(around, summary);
    page.record.reach_m = summary.radius_m;
    page.record.horizon = summary.horizon;
    summary.meshlets = static_cast<std::uint32_t>(nodes.size());
    for (PageQuarter& quarter : page.record.quarters) quarter = {summary.centre_m, summary.radius_m, 0.0F};
    const LatticePoint origin = lattice_point(summary.origin_ecef.m);
    page.words.resize(nodes_a_page, 0);
    for (MeshNode& node : nodes) {
        ORO_CHECK(from_origin(origin.steps, node));
        page.words[page.nodes.size()] = static_cast<std::uint32_t>(page.words.size());
        page.words.insert(page.words.end(), node.words.begin(), node.words.end());
        page.nodes.push_back(bounds_of(node, summary));
    }
    return page;
}

class MeshPages : public RegionPages {
  public:
    MeshPages(RegionFacts facts, std::vector<MeshPage> pages, MeshCasters casters)
        : RegionPages(std::move(facts), 1), pages_(std::move(pages)), casters_(std::move(casters)) {}

    [[nodiscard]] Result<PageRecord> record(const PageIndex& page) const override {
        return PageRecord(pages_[static_cast<std::size_t>(page.column)].record);
    }
    Result<void> load(const PageIndex& page, gpu::PageBlock& block) const override;
    Result<void> load_words(const PageIndex& page, std::vector<std::uint32_t>& words) const override {
        words = pages_[static_cast<std::size_t>(page.column)].words;
        return {};
    }
    [[nodiscard]] PageContents contents() const override { return PageContents::meshes; }
    [[nodiscard]] const MeshCasters* mesh_casters() const override { return &casters_; }

  private:
    std::vector<MeshPage> pages_;
    MeshCasters casters_;
};

Result<void> MeshPages::load(const PageIndex& index, gpu::PageBlock& block) const {
    const MeshPage& page = pages_[static_cast<std::size_t>(index.column)];
    std::fill(std::begin(block.meshlets), std::end(block.meshlets), bounds_around({}));
    std::fill(std::begin(block.boxes), std::end(block.boxes), 0U);
    std::fill(std::begin(block.sw_ne), std::end(block.sw_ne), 0U);
    for (std::size_t i = 0; i < page.nodes.size(); ++i) {
        block.meshlets[i] = page.nodes[i].bounds;
        block.boxes[i] = page.nodes[i].box;
    }
    set_spacing(facts().grid, page.record.summary, block);
    return {};
}

bool share_a_corner(const SeamPiece& one, const SeamPiece& other) {
    for (const SeamCorner& corner : one.corners)
        for (const SeamCorner& there : other.corners)
            if (corner.at.m == there.at.m) return true;
    return false;
}

// Where each run of pieces begins that follow each other and hang together, a house say, and where the last
// ends: they stay together, so that a node has few vertices.
std::vector<std::size_t> runs_of(const std::vector<const SeamPiece*>& pieces) {
    constexpr std::size_t longest = 16;
    std::vector<std::size_t> first{0};
    for (std::size_t i = 1; i < pieces.size(); ++i) {
        bool hangs = false;
        for (std::size_t k = i; !hangs && k-- > first.back();) hangs = share_a_corner(*pieces[i], *pieces[k]);
        if (!hangs || i - first.back() == longest) first.push_back(i);
    }
    first.push_back(pieces.size());
    return first;
}

// The nodes of all pieces in the order of their places, made by several threads: with the same result by any
// number of them.
Result<std::vector<MeshNode>> nodes_of(const std::vector<const SeamPiece*>& pieces,
                                       const MiddlePlane& plane) {
    const std::vector<std::size_t> runs = runs_of(pieces);
    std::vector<glm::dvec2> shares;
    for (std::size_t i = 0; i + 1 < runs.size(); ++i)
        shares.push_back(plane.share(pieces[runs[i]]->corners[0]));
    std::vector<SeamPiece> sorted;
    sorted.reserve(pieces.size());
    for (const std::uint32_t run : order_of_places(shares))
        for (std::size_t i = runs[run]; i < runs[run + 1]; ++i) sorted.push_back(*pieces[i]);
    constexpr std::size_t at_a_time = 16384;
    const std::size_t parts = (sorted.size() + at_a_time - 1) / at_a_time;
    std::vector<Result<std::vector<MeshNode>>> made(parts, std::vector<MeshNode>());
    in_parallel(static_cast<int>(parts), thread_count(), [&](int part) {
        const std::size_t first = static_cast<std::size_t>(part) * at_a_time;
        made[static_cast<std::size_t>(part)] =
            mesh_nodes(std::span(sorted).subspan(first, std::min(at_a_time, sorted.size() - first)));
    });
    std::vector<MeshNode> nodes;
    for (Result<std::vector<MeshNode>>& one : made) {
        ORO_TRY(std::vector<MeshNode> more, std::move(one));
        std::ranges::move(more, std::back_inserter(nodes));
    }
    return nodes;
}

// How many nodes of those that follow go into the next page.
std::size_t nodes_of_page(std::span<const MeshNode> nodes) {
    std::size_t words = nodes_a_page, count = 0;
    while (count < std::min(nodes.size(), nodes_a_page)) {
        words += nodes[count].words.size();
        if (count > 0 && words > packed_words_max) break;
        ++count;
    }
    return count;
}

}  // namespace

Result<std::unique_ptr<RegionPages>> mesh_pages(const Seam& seam, const UndulationField& undulation,
                                                const RegionShape& shape) {
    std::vector<const SeamPiece*> of_meshes;
    std::vector<const SeamCorner*> corners;
    for (const SeamPiece& piece : seam.pieces) {
        if (!piece.two_sided) continue;
        of_meshes.push_back(&piece);
        for (const SeamCorner& corner : piece.corners) corners.push_back(&corner);
    }
    if (of_meshes.empty()) return std::unique_ptr<RegionPages>();
    ORO_TRY(const MiddlePlane plane, middle_plane_of(corners, "meshes"));
    ORO_TRY(std::vector<MeshNode> nodes, nodes_of(of_meshes, plane));
    std::vector<MeshPage> pages;
    for (std::span<MeshNode> left(nodes); !left.empty();) {
        const std::size_t count = nodes_of_page(left);
        ORO_TRY(MeshPage page, page_of(left.first(count), static_cast<int>(pages.size())));
        pages.push_back(std::move(page));
        left = left.subspan(count);
    }
    ORO_TRY(PostGrid grid, grid_over(plane, static_cast<int>(pages.size())));
    HeightField field;
    field.grid = grid;
    field.undulation = undulation;
    field.N_of_posts_m = N_of_net_m(*grid.net, undulation, thread_count());
    RegionFacts facts{std::move(grid), drawn_undulation(field), shape, of_meshes.size()};
    return std::unique_ptr<RegionPages>(
        std::make_unique<MeshPages>(std::move(facts), std::move(pages), mesh_casters_of(seam)));
}

Result<std::vector<std::unique_ptr<RegionPages>>> pages_beside(const Seam& seam,
                                                               const UndulationField& undulation,
                                                               const RegionShape& shape) {
    std::vector<std::unique_ptr<RegionPages>> all;
    ORO_TRY(std::unique_ptr<RegionPages> between, seam_pages(seam, undulation, shape));
    if (between) all.push_back(std::move(between));
    ORO_TRY(std::unique_ptr<RegionPages> meshes, mesh_pages(seam, undulation, shape));
    if (meshes) all.push_back(std::move(meshes));
    return all;
}

}  // namespace oro
