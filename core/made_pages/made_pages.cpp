#include "core/made_pages/made_pages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>
#include <numbers>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/earth/culling.h"
#include "core/frame/picture_culling.h"
#include "core/lod/page_sums.h"
#include "core/made/made_heights.h"
#include "core/made_pages/measured_block.h"
#include "core/terrain/page_posts.h"

namespace oro {
namespace {

constexpr int page_side = static_cast<int>(gpu::meshlets_per_side);
constexpr int stride = static_cast<int>(gpu::height_stride);
constexpr int page_quads = static_cast<int>(gpu::page_quads);
// No radius of curvature of WGS84 is larger (that at a pole is, 6,399,593.7).
constexpr double largest_curvature_radius_m = 6'399'600.0;

// The terrain whose outermost posts are a grid's.
MadeTerrain terrain_on(const MadeTerrain& terrain, const PostGrid& grid) {
    MadeTerrain part = terrain;
    part.north = grid.lat.first;
    part.south = grid.lat.first - (grid.rows() - 1);
    part.west = grid.lon.first;
    part.east = grid.lon.first + (grid.columns() - 1);
    return part;
}

RegionShape shape_of(const MadeRegion& region) {
    const auto& N_m = region.undulation.N_m;
    const double lowest_N_m = N_m.empty() ? 0.0 : static_cast<double>(*std::ranges::min_element(N_m));
    const double spacing_m =
        radians_from_deg(region.grid.lat.spacing_deg()).rad * 1.01 * wgs84_a_m * std::numbers::sqrt2;
    return {occluder_below(std::min(0.0, made_step_m * region.terrain.low + lowest_N_m - 0.01), spacing_m),
            1.0};
}

// Blocks by the numbers of their pages: those of a region's pages that were for other pictures. Safe to ask
// from several threads.
class BlocksOfRegion {
  public:
    explicit BlocksOfRegion(UndulationField undulation) : undulation_(std::move(undulation)) {}
    // Whether they are those of ground with such undulation.
    [[nodiscard]] bool are_of(const UndulationField& undulation) const {
        return undulation.N_m == undulation_.N_m;
    }
    [[nodiscard]] std::shared_ptr<const MeasuredBlock> find(std::uint64_t number) const {
        const std::scoped_lock lock(mutex_);
        const auto found = blocks_.find(number);
        return found == blocks_.end() ? nullptr : found->second;
    }
    void keep(std::uint64_t number, std::shared_ptr<const MeasuredBlock> block) {
        const std::scoped_lock lock(mutex_);
        if (blocks_.size() >= most) blocks_.clear();
        blocks_[number] = std::move(block);
    }

  private:
    static constexpr std::size_t most = 1024;  // 64 MB
    UndulationField undulation_;
    mutable std::mutex mutex_;
    std::unordered_map<std::uint64_t, std::shared_ptr<const MeasuredBlock>> blocks_;
};

class MadePages : public RegionPages {
  public:
    MadePages(RegionFacts facts, MadeRegion region, std::span<const FrameView> pictures,
              std::shared_ptr<BlocksOfRegion> known)
        : RegionPages(std::move(facts)),
          region_(std::move(region)),
          known_(std::move(known)),
          measured_to_(highest_measured_level(region_)) {
        for (const FrameView& picture : pictures)
            culling_.emplace_back(picture, this->facts().shape.occluder);
        double lowest_N_m = 0.0, highest_N_m = 0.0;
        for (const float N_m : region_.undulation.N_m) {
            lowest_N_m = std::min(lowest_N_m, static_cast<double>(N_m));
            highest_N_m = std::max(highest_N_m, static_cast<double>(N_m));
        }
        lowest_h_m_ = made_step_m * region_.terrain.low + lowest_N_m - 1.0;
        highest_h_m_ = made_step_m * region_.terrain.high + highest_N_m + 1.0;
    }

    [[nodiscard]] std::optional<PageBound> bound(const PageIndex& page) const override;
    // By the rule: to ask the records would be to measure all of a world.
    [[nodiscard]] std::optional<double> known_top_m() const override { return highest_h_m_; }

    [[nodiscard]] Result<PageRecord> record(const PageIndex& page) const override {
        const std::uint64_t number = number_of(page);
        {
            const std::scoped_lock lock(mutex_);
            const auto found = records_.find(number);
            if (found != records_.end()) return found->second;
        }
        auto block = std::make_unique<gpu::PageBlock>();
        const auto whole = std::make_unique<PyramidPage>();
        whole->summary = make_block(page, thread_count(), *block);
        std::copy(std::begin(block->meshlets), std::end(block->meshlets), whole->nodes.begin());
        sum_up_nodes(*whole);
        hold_pages_below(*whole);
        const std::scoped_lock lock(mutex_);
        if (records_.size() >= records_kept) records_.clear();
        records_.emplace(number, static_cast<const PageRecord&>(*whole));
        if (unloaded_.size() >= unloaded_kept) unloaded_.clear();
        unloaded_.emplace(number, std::move(block));
        return PageRecord(*whole);
    }

    Result<void> load(const PageIndex& page, gpu::PageBlock& block) const override {
        if (const auto made = take_unloaded(page))
            block = *made;
        else
            make_block(page, 1, block);
        return {};
    }

  private:
    static constexpr std::size_t records_kept = 65536;  // 40 MB
    static constexpr std::size_t blocks_kept = 1024;    // 64 MB
    static constexpr std::size_t unloaded_kept = 512;   // 42 MB
    // A block that more pictures may show is measured whole: asking all of them would take longer.
    static constexpr std::size_t most_pictures_asked = 256;

    [[nodiscard]] static std::uint64_t number_of(const PageIndex& page) {
        return static_cast<std::uint64_t>(page.level) << 48U | static_cast<std::uint64_t>(page.row) << 24U |
               static_cast<std::uint64_t>(page.column);
    }
    PageSummary make_block(const PageIndex& page, int threads, gpu::PageBlock& block) const;
    [[nodiscard]] std::unique_ptr<gpu::PageBlock> take_unloaded(const PageIndex& page) const;
    [[nodiscard]] PageElevations elevations(const PageIndex& page, int threads) const;
    [[nodiscard]] std::shared_ptr<const MeasuredBlock> measured_block(const PageIndex& page,
                                                                      int threads) const;
    void hold_pages_below(PyramidPage& page) const;
    [[nodiscard]] HorizonCone horizon_over(const Ecef& centre, double radius_m) const;
    // Ground between posts of a level, the last ones included, and half its angles.
    struct Ground {
        double north_deg, west_deg, half_lat_rad, half_lon_rad;
        [[nodiscard]] bool is_wide() const {
            return std::max(half_lat_rad, half_lon_rad) > 0.25 * std::numbers::pi;
        }
    };
    [[nodiscard]] Ground ground_of(int level, int row, int column, int quads) const;
    [[nodiscard]] double reach_of(const Ground& ground) const;
    [[nodiscard]] PageBound bound_between(const Ground& ground, double low_h_m, double high_h_m) const;
    // Of the pictures that the pages are for.
    using SomePictures = std::vector<const PictureCulling*>;
    [[nodiscard]] SomePictures pictures_of(const PageIndex& page) const;
    [[nodiscard]] bool may_show_node(const SomePictures& pictures, int level, int row, int column) const;
    [[nodiscard]] bool is_good_node(const SomePictures& pictures, int level, int row, int column,
                                    const MadeNode& node) const;
    [[nodiscard]] bool is_bad_node(const SomePictures& pictures, int level, int row, int column,
                                   double error_m) const;
    // Whether each of the pictures that may show a node, or one beside it, does as it is asked.
    template <class Asked>
    [[nodiscard]] bool in_all(const SomePictures& pictures, const PageBound& around,
                              const Asked& asked) const {
        // 3 times hold what is beside it where all nodes are as wide.
        const PageBound with_beside = wider(around, 3.5);
        return std::ranges::all_of(pictures, [&](const PictureCulling* picture) {
            return (pictures.size() > 1 && !picture->may_show(with_beside)) || asked(*picture);
        });
    }
    [[nodiscard]] PageBound wider(const PageBound& bound, double times) const;

    MadeRegion region_;
    std::vector<PictureCulling> culling_;  // of each picture
    std::shared_ptr<BlocksOfRegion> known_;
    int measured_to_;
    double lowest_h_m_{}, highest_h_m_{};  // of any post
    mutable std::mutex mutex_;
    mutable std::mutex measuring_;  // one block at a time: it takes all threads
    mutable std::unordered_map<std::uint64_t, PageRecord> records_;
    mutable std::unordered_map<std::uint64_t, std::shared_ptr<const MeasuredBlock>> blocks_;
    // Of pages whose record was asked for and that nobody has loaded yet: made once for both.
    mutable std::unordered_map<std::uint64_t, std::unique_ptr<gpu::PageBlock>> unloaded_;
};

std::unique_ptr<gpu::PageBlock> MadePages::take_unloaded(const PageIndex& page) const {
    const std::scoped_lock lock(mutex_);
    auto found = unloaded_.extract(number_of(page));
    return found ? std::move(found.mapped()) : nullptr;
}

PageElevations MadePages::elevations(const PageIndex& page, int threads) const {
    const PagePosts posts(facts().grid, page);
    std::array<int, gpu::height_stride> of_region = posts.region_columns();
    // The post after a last column that is the first one (PageElevations).
    const LevelAxis& across = posts.level().column;
    const int after = across.quads + 1 - posts.first_column();
    if (wraps_longitude() && after < stride - 1)
        of_region[static_cast<std::size_t>(after + 1)] = across.region_post(1);
    std::vector<MadeColumn> columns;
    for (const int column : of_region)
        columns.push_back(
            made_column(region_.terrain.west + std::max(0, column), region_.terrain.posts_per_deg));
    PageElevations elevations;
    in_parallel(stride, threads, [&](int i) {
        const std::span<float> H_m =
            std::span(elevations.H_m).subspan(static_cast<std::size_t>(i * stride), gpu::height_stride);
        const int row = posts.region_row(i - 1);
        std::ranges::fill(H_m, void_height_m);
        if (row < 0) return;
        std::array<float, gpu::height_stride> made{};
        made_posts_of_row(region_, row, columns, made);
        for (std::size_t j = 0; j < H_m.size(); ++j)
            if (of_region[j] >= 0) H_m[j] = made[j];
    });
    return elevations;
}

std::shared_ptr<const MeasuredBlock> MadePages::measured_block(const PageIndex& page, int threads) const {
    const int top = block_top(page.level), up = top - page.level;
    const PageIndex of_top{page.row >> up, page.column >> up, top};
    const std::uint64_t number = number_of(of_top);
    const auto known = [&]() -> std::shared_ptr<const MeasuredBlock> {
        const std::scoped_lock lock(mutex_);
        const auto found = blocks_.find(number);
        return found == blocks_.end() ? nullptr : found->second;
    };
    if (auto there = known()) return there;
    const std::scoped_lock measuring(measuring_);
    if (auto there = known()) return there;
    const SomePictures pictures = pictures_of(of_top);
    const BlockPicture picture{
        [&](int row, int column) { return may_show_node(pictures, top, row, column); },
        [&](int row, int column, double error_m) { return is_bad_node(pictures, top, row, column, error_m); },
        [&](int row, int column, const MadeNode& node) {
            return is_good_node(pictures, top, row, column, node);
        }};
    const bool is_for_any = culling_.empty() || pictures.size() > most_pictures_asked;
    const auto before = known_->find(number);
    auto made = std::make_shared<const MeasuredBlock>(region_, of_top, std::max(threads, thread_count()),
                                                      is_for_any ? nullptr : &picture, before.get());
    known_->keep(number, made);
    const std::scoped_lock lock(mutex_);
    if (blocks_.size() >= blocks_kept) blocks_.clear();
    blocks_.emplace(number, made);
    return made;
}

PageSummary MadePages::make_block(const PageIndex& page, int threads, gpu::PageBlock& block) const {
    const auto made = std::make_unique<PageElevations>(elevations(page, threads));
    const auto heights =
        std::make_unique<PageHeights>(page_heights(facts().grid, region_.undulation, 1.0, *made, page));
    const PageSummary summary = build_page(facts().grid, facts().shape, *heights, page, block);
    if (page.level == 0) {
        for (gpu::MeshletBounds& node : block.meshlets) node.lod_radius = node.radius;
        return summary;
    }
    const bool is_measured = page.level <= measured_to_;
    const auto measured = is_measured ? measured_block(page, threads) : nullptr;
    const MadeNode unmeasured = unmeasured_node(region_, page.level);
    for (int i = 0; i < page_side * page_side; ++i) {
        gpu::MeshletBounds& node = block.meshlets[i];
        if (node.radius < 0.0F) continue;
        const MadeNode known = is_measured ? measured->node(page.level, page.row * page_side + i / page_side,
                                                            page.column * page_side + i % page_side)
                                           : unmeasured;
        node.error_m = known.error_m;
        node.lod_radius = std::max(known.lod_radius_m, node.radius);
    }
    return summary;
}

// What all pages below a page lie in, by what they can be at most.
void MadePages::hold_pages_below(PyramidPage& page) const {
    PageSummary& summary = page.summary;
    page.reach_m = -1.0;
    page.horizon = {glm::normalize(facts().shape.occluder.scaled(summary.origin_ecef)), 0.0};
    if (summary.triangles == 0) return;
    const double off_m = page.summary.index.level == 0
                             ? 0.0
                             : region_.bounds()[static_cast<std::size_t>(summary.index.level)].drawn.cut;
    page.reach_m = summary.radius_m + off_m;
    if (page.summary.index.level == 0) {
        page.horizon = summary.horizon;
        return;
    }
    page.horizon =
        horizon_over({summary.origin_ecef.m + summary.ecef_from_page * summary.centre_m}, page.reach_m);
}

// Of all of a sphere, as high as ground can be.
HorizonCone MadePages::horizon_over(const Ecef& middle, double radius_m) const {
    const HorizonOccluder& occluder = facts().shape.occluder;
    const glm::dvec3 centre = occluder.scaled(middle);
    const double smallest_axis_m = std::min(occluder.radii_m.x, occluder.radii_m.z);
    const double across = 1.001 * radius_m / smallest_axis_m;
    const double depth_m = wgs84_a_m - occluder.radii_m.x;
    const double highest = 1.001 * (highest_h_m_ + depth_m) / smallest_axis_m;
    const double to_centre = glm::length(centre);
    return {glm::normalize(centre), across < to_centre
                                        ? std::asin(across / to_centre) +
                                              std::atan(std::sqrt(std::max(0.0, highest * (2.0 + highest))))
                                        : 4.0};
}

MadePages::Ground MadePages::ground_of(int level, int row, int column, int quads) const {
    const LevelGrid posts = level_grid(facts().grid, level);
    const PostGrid& grid = facts().grid;
    const double north_deg = grid.lat.at_deg(posts.row.region_post(row * quads));
    const double south_deg = grid.lat.at_deg(posts.row.region_post((row + 1) * quads));
    const double west_deg = grid.lon.at_deg(posts.column.region_post(column * quads));
    const double east_deg = grid.lon.at_deg(posts.column.region_post((column + 1) * quads));
    return {north_deg, west_deg, radians_from_deg(0.5 * (north_deg - south_deg)).rad,
            radians_from_deg(0.5 * (east_deg - west_deg)).rad};
}

// How far places of one height are from the middle. Two are at most as far apart as the largest radius of
// curvature times their difference in latitude, and in longitude times the distance from the axis; the chords
// are shorter.
double MadePages::reach_of(const Ground& ground) const {
    const double south_deg = ground.north_deg - 2.0 * deg_from_radians(Radians(ground.half_lat_rad));
    const double nearest_equator_deg = south_deg > 0.0 ? south_deg : std::max(0.0, -ground.north_deg);
    const double radius_m = largest_curvature_radius_m + highest_h_m_;
    const double from_axis_m = radius_m * std::cos(radians_from_deg(nearest_equator_deg).rad);
    return std::hypot(radius_m * ground.half_lat_rad, from_axis_m * ground.half_lon_rad);
}

// A sphere around all places over some ground between two heights.
PageBound MadePages::bound_between(const Ground& ground, double low_h_m, double high_h_m) const {
    PageBound bound;
    bound.centre = ecef_from_geodetic({ground.north_deg - deg_from_radians(Radians(ground.half_lat_rad)),
                                       ground.west_deg + deg_from_radians(Radians(ground.half_lon_rad)),
                                       0.5 * (low_h_m + high_h_m)});
    bound.radius_m = reach_of(ground) + 0.5 * (high_h_m - low_h_m) + 1.0;
    bound.horizon = horizon_over(bound.centre, bound.radius_m);
    return bound;
}

// Between the lowest and the highest h there may be.
std::optional<PageBound> MadePages::bound(const PageIndex& page) const {
    const Ground ground = ground_of(page.level, page.row, page.column, page_quads);
    if (ground.is_wide()) return std::nullopt;
    return bound_between(ground, lowest_h_m_, highest_h_m_);
}

// A bound of what is beside some ground, too, so many times as wide.
PageBound MadePages::wider(const PageBound& bound, double times) const {
    PageBound all = bound;
    all.radius_m *= times;
    all.horizon = horizon_over(all.centre, all.radius_m);
    return all;
}

// Those that may show a page, or the nodes beside it.
MadePages::SomePictures MadePages::pictures_of(const PageIndex& page) const {
    const Ground ground = ground_of(page.level, page.row, page.column, page_quads);
    const PageBound bound =
        ground.is_wide() ? PageBound{} : wider(bound_between(ground, lowest_h_m_, highest_h_m_), 1.5);
    SomePictures pictures;
    for (const PictureCulling& culling : culling_)
        if (ground.is_wide() || culling.may_show(bound)) pictures.push_back(&culling);
    return pictures;
}

// In slices that are no higher than wide, so that little is asked for that is not over the node.
bool MadePages::may_show_node(const SomePictures& pictures, int level, int row, int column) const {
    const Ground ground = ground_of(level, row, column, static_cast<int>(gpu::meshlet_quads));
    if (ground.is_wide()) return true;
    const double height_m = highest_h_m_ - lowest_h_m_;
    const int slices = std::clamp(static_cast<int>(std::ceil(height_m / reach_of(ground))), 1, 16);
    for (int i = 0; i < slices; ++i) {
        const PageBound slice = bound_between(ground, lowest_h_m_ + height_m * i / slices,
                                              lowest_h_m_ + height_m * (i + 1) / slices);
        for (const PictureCulling* const picture : pictures)
            if (picture->may_show(slice)) return true;
    }
    return false;
}

bool MadePages::is_bad_node(const SomePictures& pictures, int level, int row, int column,
                            double error_m) const {
    const Ground ground = ground_of(level, row, column, static_cast<int>(gpu::meshlet_quads));
    if (ground.is_wide()) return false;
    const PageBound around = bound_between(ground, lowest_h_m_, highest_h_m_);
    return in_all(pictures, around,
                  [&](const PictureCulling& picture) { return picture.fails_tau(around, error_m); });
}

bool MadePages::is_good_node(const SomePictures& pictures, int level, int row, int column,
                             const MadeNode& node) const {
    const Ground ground = ground_of(level, row, column, static_cast<int>(gpu::meshlet_quads));
    if (ground.is_wide()) return false;
    const PageBound around = bound_between(ground, lowest_h_m_, highest_h_m_);
    // The node's sphere has its middle somewhere in this one.
    PageBound with_sphere = around;
    with_sphere.radius_m += static_cast<double>(node.lod_radius_m);
    return in_all(pictures, around, [&](const PictureCulling& picture) {
        return picture.keeps_tau(with_sphere, static_cast<double>(node.error_m));
    });
}

}  // namespace

bool makes_pages(const MadeTerrain& terrain) {
    return terrain.kind == MadeKind::fbm;
}

// Tiles of posts, each in the place that its number gives it.
struct MadePostSource::Tiles {
    static constexpr int side = 128;
    static constexpr std::size_t places = 1024;
    struct Tile {
        std::int64_t number{-1};
        std::vector<float> H_m;
    };
    MadeRegion region;
    std::mutex mutex;
    std::vector<Tile> tiles{places};
    std::shared_ptr<BlocksOfRegion> blocks;

    std::shared_ptr<BlocksOfRegion> blocks_of(const UndulationField& undulation) {
        const std::scoped_lock lock(mutex);
        if (!blocks || !blocks->are_of(undulation)) blocks = std::make_shared<BlocksOfRegion>(undulation);
        return blocks;
    }

    const Tile& at(int row, int column) {
        const std::int64_t tile_row = row / side, tile_column = column / side;
        const std::int64_t across = (region.grid.columns() + side - 1) / side;
        const std::int64_t number = tile_row * across + tile_column;
        Tile& tile = tiles[static_cast<std::size_t>(tile_row * 32 + tile_column % 32) % places];
        if (tile.number != number) make(tile_row, tile_column, number, tile);
        return tile;
    }
    void make(std::int64_t tile_row, std::int64_t tile_column, std::int64_t number, Tile& tile) const {
        tile.number = number;
        tile.H_m.resize(std::size_t{side} * side);
        const auto first_row = static_cast<int>(tile_row * side),
                   first_column = static_cast<int>(tile_column * side);
        std::vector<MadeColumn> columns;
        for (int i = 0; i < std::min(side, region.grid.columns() - first_column); ++i)
            columns.push_back(
                made_column(region.terrain.west + first_column + i, region.terrain.posts_per_deg));
        for (int i = 0; i < std::min(side, region.grid.rows() - first_row); ++i)
            made_posts_of_row(
                region, first_row + i, columns,
                std::span(tile.H_m).subspan(static_cast<std::size_t>(i * side), columns.size()));
    }
};

MadePostSource::MadePostSource(const MadeTerrain& terrain, const PostGrid& grid)
    : terrain_(terrain_on(terrain, grid)), tiles_(std::make_unique<Tiles>()) {
    tiles_->region.terrain = terrain_;
    tiles_->region.rule = made_rule(terrain_);
    tiles_->region.grid = grid;
}
MadePostSource::~MadePostSource() = default;

float MadePostSource::H_m(int row, int column) const {
    const std::scoped_lock lock(tiles_->mutex);
    return tiles_->at(row, column)
        .H_m[static_cast<std::size_t>(row % Tiles::side * Tiles::side + column % Tiles::side)];
}

std::unique_ptr<RegionPages> MadePostSource::pages(const HeightField& field,
                                                   std::span<const FrameView> pictures) const {
    MadeRegion region = made_region(terrain_, field.grid, field.undulation);
    const auto quads = [](int posts) { return static_cast<std::uint64_t>(posts - 1); };
    RegionFacts facts{field.grid, field.undulation, shape_of(region),
                      2 * quads(field.grid.rows()) * quads(field.grid.columns())};
    return std::make_unique<MadePages>(std::move(facts), std::move(region), pictures,
                                       tiles_->blocks_of(field.undulation));
}

HeightField made_field(const MadeTerrain& terrain, const PostGrid& grid, const UndulationField& undulation) {
    HeightField field;
    field.grid = grid;
    field.undulation = undulation;
    field.range = HeightRange{static_cast<float>(made_step_m * terrain.low),
                              static_cast<float>(made_step_m * terrain.high), 0};
    field.posts = std::make_shared<MadePostSource>(terrain, grid);
    return field;
}

const MadePostSource* made_posts_of(const HeightField& field) {
    return dynamic_cast<const MadePostSource*>(field.posts.get());
}

}  // namespace oro
