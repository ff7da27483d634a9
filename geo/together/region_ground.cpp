#include "geo/together/region_ground.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/baked/file_pages.h"
#include "core/base/parallel.h"
#include "core/streamed_mesh/streamed_mesh.h"
#include "geo/together/baked_meshes.h"
#include "geo/together/cut_regions.h"
#include "geo/together/mesh_surface.h"
#include "geo/together/streamed_triangles.h"

namespace oro {
namespace {

// A point of a seam on the true surface of its grid.
Geodetic true_point(const TrueSurface& surface, const SeamPoint& point) {
    double row = 0.0, column = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        row += point.shares[i] * point.posts[i].row;
        column += point.shares[i] * point.posts[i].column;
    }
    const PostGrid& grid = surface.field().grid;
    const PostPlace place = grid.place_at(row, column);
    Geodetic there{place.lat_deg, normalised_lon_deg(place.lon_deg), 0.0};
    // By its own posts: at a rim a rounded row may be one of another triangle, or of none.
    for (std::size_t i = 0; i < 3; ++i) {
        if (point.shares[i] == 0.0) continue;
        there.h_m +=
            point.shares[i] * surface.post_h_m(point.posts[i].row, point.posts[i].column).value_or(0.0);
    }
    return there;
}

// From one surface's rim to the other's: two triangles, or where the surfaces change places between the ends
// one on either side of where they meet.
void add_step(const std::array<Geodetic, 2>& one, const std::array<double, 2>& other_h_m,
              std::vector<SurfaceTriangle>& pieces) {
    const double begin_m = other_h_m[0] - one[0].h_m, end_m = other_h_m[1] - one[1].h_m;
    constexpr double least_m = 1.0e-6;
    if (std::abs(begin_m) < least_m && std::abs(end_m) < least_m) return;
    const auto at_other = [&](std::size_t end) {
        return Geodetic{one[end].lat_deg, one[end].lon_deg, other_h_m[end]};
    };
    if (begin_m * end_m >= 0.0) {
        pieces.push_back({{one[0], one[1], at_other(1)}});
        pieces.push_back({{one[0], at_other(1), at_other(0)}});
        return;
    }
    const double share = begin_m / (begin_m - end_m);
    const Geodetic middle{
        std::lerp(one[0].lat_deg, one[1].lat_deg, share),
        normalised_lon_deg(one[0].lon_deg + share * std::remainder(one[1].lon_deg - one[0].lon_deg, 360.0)),
        std::lerp(one[0].h_m, one[1].h_m, share)};
    pieces.push_back({{one[0], middle, at_other(0)}});
    pieces.push_back({{one[1], at_other(1), middle}});
}

// The steps along what was cut out of one grid. surfaces: by what a SeamPoint counts.
void add_steps(const GridClip& cut, const std::vector<const TrueSurface*>& surfaces,
               std::vector<SurfaceTriangle>& pieces) {
    for (const SeamWall& wall : cut.walls) {
        std::array<Geodetic, 2> along{};
        std::array<double, 2> over_h_m{};
        for (std::size_t end = 0; end < 2; ++end) {
            along[end] = true_point(*surfaces[wall.cut[end].grid], wall.cut[end]);
            over_h_m[end] = true_point(*surfaces[wall.over[end].grid], wall.over[end]).h_m;
        }
        add_step(along, over_h_m, pieces);
    }
}

}  // namespace

Result<std::unique_ptr<const RegionGround>> RegionGround::of(const Region& region, const RegionCuts& cuts,
                                                             double exaggeration, GroundHeights heights) {
    std::unique_ptr<RegionGround> made(new RegionGround(region));
    std::vector<TrueGround::Grid> grids;
    for (const RegionGrid& one : region.grids) {
        const HeightField* field = &one.field;
        if (heights == GroundHeights::true_ones && one.file) {
            ORO_TRY(HeightField in_memory, field_in_memory(*one.file));
            field = &made->fields_.emplace_back(std::move(in_memory));
        } else if (heights == GroundHeights::true_ones && !one.geoid_left_out.N_m.empty()) {
            HeightField& lifted = made->fields_.emplace_back(one.field);
            lifted.undulation = one.geoid_left_out;
            lifted.N_of_posts_m = one.N_of_posts_left_out_m;
            field = &lifted;
        }
        // Cells beside what is cut out are split as they are drawn, without it.
        const std::size_t number = grids.size();
        const std::vector<char>* masked = nullptr;
        if (number < cuts.grids.size() &&
            std::ranges::find(cuts.grids[number].masked_posts, 1) != cuts.grids[number].masked_posts.end())
            masked = &made->masked_.emplace_back(cuts.grids[number].masked_posts);
        grids.push_back({&made->surfaces_.emplace_back(*field, exaggeration, thread_count(), masked),
                         one.rank, one.detail.has_value()});
    }
    auto beside = std::make_shared<GroundBeside>();
    for (std::size_t i = 0; i < cuts.grids.size(); ++i) {
        std::vector<const TrueSurface*> surfaces{grids[i].surface};
        for (const RegionGrid* const finer : finer_than(region, region.grids[i]))
            surfaces.push_back(grids[static_cast<std::size_t>(finer - region.grids.data())].surface);
        add_steps(cuts.grids[i], surfaces, beside->pieces);
    }
    for (const GapBridge& bridge : cuts.bridges) {
        SurfaceTriangle piece;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& [grid, post] = bridge.posts[i];
            piece.corners[i] = true_point(*grids[grid].surface, {0, {post, post, post}, {1.0, 0.0, 0.0}});
        }
        beside->pieces.push_back(piece);
    }
    if (region.meshes)
        for (std::uint32_t i = 0; i < region.meshes->size(); ++i) {
            const PlacedMesh& mesh = (*region.meshes)[i];
            const UndulationField& undulation = grids.front().surface->field().undulation;
            if (is_drawn_as_streamed(mesh, undulation, exaggeration)) {
                beside->meshes.emplace_back(true_triangles_of_streamed(mesh, undulation), i + 1,
                                            thread_count(), StreamedMesh::usual_bytes);
                continue;
            }
            PlacedMesh read;
            if (mesh.streamed()) {
                ORO_TRY(read, read_whole_mesh(mesh, region.grids.front().field.undulation));
            }
            beside->meshes.emplace_back(
                true_triangles(mesh.streamed() ? read : mesh, undulation, exaggeration), i + 1,
                thread_count());
            add_rim_walls(mesh, undulation, exaggeration, i + 1, beside->pieces);
        }
    made->ground_.emplace(std::move(grids), std::move(beside));
    return std::unique_ptr<const RegionGround>(std::move(made));
}

Result<std::unique_ptr<const RegionGround>> RegionGround::of(const Region& region, double exaggeration,
                                                             GroundHeights heights) {
    ORO_TRY(const RegionCuts cuts, cut_regions(region));
    return of(region, cuts, exaggeration, heights);
}

}  // namespace oro
