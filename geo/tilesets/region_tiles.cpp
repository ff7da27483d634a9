#include "geo/tilesets/region_tiles.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "geo/meshes/placed_mesh.h"
#include "geo/together/cut_regions.h"

namespace oro {
namespace {

std::size_t number_of(const PostGrid& grid, int row, int column) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns()) +
           static_cast<std::size_t>(column);
}

// The field without the posts that are masked.
HeightField without(const HeightField& field, const std::vector<char>& masked) {
    HeightField cut = field;
    cut.posts = nullptr;
    cut.range.reset();
    cut.H_m.resize(field.grid.post_count());
    for (int row = 0; row < field.grid.rows(); ++row)
        for (int column = 0; column < field.grid.columns(); ++column) {
            const std::size_t number = number_of(field.grid, row, column);
            cut.H_m[number] = masked[number] != 0 ? void_height_m : field.H_at_post_m(row, column);
        }
    return cut;
}

// The posts of each grid that touch what is between grids.
class PostsBeside {
  public:
    explicit PostsBeside(const Region& region) : region_(region), marks_(region.grids.size()) {}

    void add(const RegionCuts& cuts) {
        for (std::size_t i = 0; i < cuts.grids.size(); ++i) add(cuts.grids[i], i);
        for (const GapBridge& bridge : cuts.bridges)
            for (const BridgePost& post : bridge.posts) mark(post.grid, post.post);
    }
    [[nodiscard]] std::vector<char> take(std::size_t grid) { return std::move(marks_[grid]); }

  private:
    void mark(std::size_t grid, const GridPost& post) {
        const PostGrid& posts = region_.grids[grid].field.grid;
        std::vector<char>& marks = marks_[grid];
        if (marks.empty()) marks.resize(posts.post_count());
        marks[number_of(posts, post.row, post.column)] = 1;
    }
    // clip: what is cut out of a grid; its points count that grid and then the finer ones.
    void add(const GridClip& clip, std::size_t grid) {
        std::vector<std::size_t> numbers{grid};
        for (const RegionGrid* const finer : finer_than(region_, region_.grids[grid]))
            numbers.push_back(static_cast<std::size_t>(finer - region_.grids.data()));
        const auto add_point = [&](const SeamPoint& point) {
            for (std::size_t i = 0; i < point.posts.size(); ++i)
                if (point.shares[i] > 0.0) mark(numbers[point.grid], point.posts[i]);
        };
        for (const SeamTriangle& piece : clip.ground)
            for (const SeamPoint& point : piece.points) add_point(point);
        for (const SeamWall& wall : clip.walls)
            for (std::size_t end = 0; end < 2; ++end) {
                add_point(wall.cut[end]);
                add_point(wall.over[end]);
            }
        if (!clip.masked_posts.empty()) mark_around(clip.masked_posts, grid);
    }
    // Splinters of ground are not there: so posts next to those that are left out are marked, too.
    void mark_around(const std::vector<char>& masked, std::size_t grid) {
        const PostGrid& posts = region_.grids[grid].field.grid;
        for (int row = 0; row < posts.rows(); ++row)
            for (int column = 0; column < posts.columns(); ++column) {
                if (masked[number_of(posts, row, column)] == 0) continue;
                for (int r = std::max(0, row - 1); r <= std::min(posts.rows() - 1, row + 1); ++r)
                    for (int c = std::max(0, column - 1); c <= std::min(posts.columns() - 1, column + 1); ++c)
                        mark(grid, {r, c});
            }
    }

    const Region& region_;
    std::vector<std::vector<char>> marks_;
};

// What is cut out of one grid alone, and then the bridges by the grid of their first post.
void add_between(const Region& region, RegionCuts& cuts, std::vector<TilesetBetween>& between) {
    const std::vector<PlacedMesh> no_meshes;
    const std::vector<GapBridge> bridges = std::exchange(cuts.bridges, {});
    std::vector<GridClip> clips(cuts.grids.size());
    for (std::size_t i = 0; i < clips.size(); ++i) {
        clips[i].ground = std::exchange(cuts.grids[i].ground, {});
        clips[i].walls = std::exchange(cuts.grids[i].walls, {});
    }
    const auto add = [&](std::size_t grid) {
        Seam seam = seam_between(region, cuts, 1.0, &no_meshes);
        if (!seam.empty()) between.push_back({std::move(seam), grid});
    };
    for (std::size_t i = 0; i < clips.size(); ++i) {
        cuts.grids[i].ground = std::move(clips[i].ground);
        cuts.grids[i].walls = std::move(clips[i].walls);
        add(i);
        cuts.grids[i].ground.clear();
        cuts.grids[i].walls.clear();
    }
    std::map<std::size_t, std::vector<GapBridge>> of_grids;
    for (const GapBridge& bridge : bridges) of_grids[bridge.posts[0].grid].push_back(bridge);
    for (auto& [grid, some] : of_grids) {
        cuts.bridges = std::move(some);
        add(grid);
    }
}

}  // namespace

Result<std::unique_ptr<RegionTiles>> RegionTiles::of(const Region& region, int threads) {
    std::unique_ptr<RegionTiles> made(new RegionTiles);
    const bool alone = region.grids.size() == 1;
    RegionCuts cuts;
    PostsBeside beside(region);
    if (!alone) {
        ORO_TRY(cuts, cut_regions(region));
        beside.add(cuts);
    }
    for (std::size_t i = 0; i < region.grids.size(); ++i) {
        const RegionGrid& grid = region.grids[i];
        std::optional<HeightField>& cut = made->cut_.emplace_back();
        if (!alone && std::ranges::find(cuts.grids[i].masked_posts, 1) != cuts.grids[i].masked_posts.end())
            cut = without(grid.field, cuts.grids[i].masked_posts);
        TilesetGrid& one = made->ground.grids.emplace_back();
        one.posts = &grid.field.grid;
        if (!alone) one.name = std::to_string(i + 1);
        one.beside = beside.take(i);
        one.ground = [&grid, &cut, threads] {
            return cut ? ClusteredGround::of(*cut, nullptr, threads)
                       : ClusteredGround::of(grid.field, grid.clusters.get(), threads);
        };
    }
    if (!alone) add_between(region, cuts, made->ground.between);
    ORO_CHECK(region.health());
    return made;
}

}  // namespace oro
