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
#include "core/frame/cast_map.h"
#include "core/frame/picture_culling.h"
#include "core/lod/page_sums.h"
#include "core/made/made_ground.h"
#include "core/made/made_heights.h"
#include "core/made_pages/coarse_ground.h"
#include "core/made_pages/measured_block.h"
#include "core/made_pages/steps_of_maker.h"
#include "core/made_pages/visible_ground.h"
#include "core/terrain/page_posts.h"

namespace oro {
namespace {

thread_local std::uint64_t blocks_measured = 0;

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

RegionFacts facts_of(const HeightField& field, const MadeRegion& region) {
    const auto quads = [](int posts) { return static_cast<std::uint64_t>(posts - 1); };
    return {field.grid, field.undulation, shape_of(region),
            2 * quads(field.grid.rows()) * quads(field.grid.columns())};
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
    // measured_to: a level; of coarser ones nothing is measured.
    MadePages(RegionFacts facts, MadeRegion region, const KnownPictures& pictures,
              std::shared_ptr<BlocksOfRegion> known, int measured_to)
        : RegionPages(std::move(facts)),
          region_(std::move(region)),
          coarse_ground_(region_),
          has_coarse_ground_(CoarseGround::level < static_cast<int>(region_.bounds().size())),
          known_(std::move(known)),
          measured_to_(measured_to) {
        double lowest_N_m = 0.0, highest_N_m = 0.0;
        for (const float N_m : region_.undulation.N_m) {
            lowest_N_m = std::min(lowest_N_m, static_cast<double>(N_m));
            highest_N_m = std::max(highest_N_m, static_cast<double>(N_m));
        }
        lowest_h_m_ = made_step_m * region_.terrain.low + lowest_N_m - 1.0;
        highest_h_m_ = made_step_m * region_.terrain.high + highest_N_m + 1.0;
        const std::vector<FrameView>& views = pictures.views;
        for (const FrameView& picture : views)
            pictures_.push_back({PictureCulling(picture, this->facts().shape.occluder), nullptr});
        if (views.size() <= most_pictures_looked_into)
            for (std::size_t i = 0; i < views.size(); ++i)
                pictures_[i].ground = VisibleGround::of(coarse_ground_, views[i], pictures_[i].culling,
                                                        lowest_h_m_, highest_h_m_, thread_count());
        if (pictures.light.sun_enu) map_casters(views, *pictures.light.sun_enu);
    }

    void make_posts_by(std::shared_ptr<MadePostMaker> maker) { region_.maker = std::move(maker); }
    [[nodiscard]] std::optional<PageBound> bound(const PageIndex& page) const override;
    // By the rule: to ask the records would be to measure all of a world.
    [[nodiscard]] std::optional<HeightBounds> known_heights() const override {
        return HeightBounds{lowest_h_m_, highest_h_m_};
    }
    [[nodiscard]] const CastMap* cast_map() const override { return cast_map_ ? &*cast_map_ : nullptr; }

    [[nodiscard]] Result<PageRecord> record(const PageIndex& page) const override {
        const std::uint64_t number = number_of(page);
        {
            const std::scoped_lock lock(mutex_);
            const auto found = records_.find(number);
            if (found != records_.end()) return found->second;
        }
        return make_record(page, thread_count());
    }

    [[nodiscard]] bool knows_record(const PageIndex& page) const override {
        const std::scoped_lock lock(mutex_);
        return records_.contains(number_of(page));
    }

    Result<void> load(const PageIndex& page, gpu::PageBlock& block) const override {
        if (!knows_record(page)) make_record(page, 1);
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
    // A block that more pictures may show is measured whole: asking all of them would take longer. And of
    // more than so many it is not asked what ground hides of others.
    static constexpr std::size_t most_pictures_asked = 256, most_pictures_looked_into = 16;

    [[nodiscard]] static std::uint64_t number_of(const PageIndex& page) {
        return static_cast<std::uint64_t>(page.level) << 48U | static_cast<std::uint64_t>(page.row) << 24U |
               static_cast<std::uint64_t>(page.column);
    }
    PageRecord make_record(const PageIndex& page, int threads) const;
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
    struct Picture {
        PictureCulling culling;
        std::unique_ptr<VisibleGround> ground;  // null: whatever is in its frustum
    };
    using SomePictures = std::vector<const Picture*>;
    // Ground that is seen, by its first post and posts along a side, and what may cast on it.
    struct LitGround {
        std::int64_t row, column, posts;
        double error_m, most_error_m;  // that casters may have, for light that rises a metre on a metre
        double farthest_m;             // from the eye
        double lowest_h_m;
    };
    void find_lit_in_frustum(const PictureCulling& culling, const Ecef& eye, double error_per_m,
                             const PageIndex& node, std::vector<LitGround>& lit) const;
    [[nodiscard]] std::vector<LitGround> lit_ground(const Picture& picture, const FrameView& view) const;
    void map_casters(std::span<const FrameView> pictures, const glm::dvec3& sun_enu);
    [[nodiscard]] CastMap::Window window_of_casters(const CastCells& cells, std::span<const LitGround> lit,
                                                    const glm::dvec3& sun_enu) const;
    [[nodiscard]] CastMap::Need need_of_casters(int level, int row, int column) const;
    [[nodiscard]] bool may_cast_node(int level, int row, int column) const;
    // Whether an error is more than any light over the node allows.
    [[nodiscard]] bool fails_casters(int level, int row, int column, double error_m) const;
    static constexpr double most_cast_cells = 4.0e6;  // 200 MB
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
        return std::ranges::all_of(pictures, [&](const Picture* picture) {
            return (pictures.size() > 1 && !picture->culling.may_show(with_beside)) ||
                   asked(picture->culling);
        });
    }
    [[nodiscard]] PageBound wider(const PageBound& bound, double times) const;

    MadeRegion region_;
    CoarseGround coarse_ground_;
    bool has_coarse_ground_;
    std::vector<Picture> pictures_;
    std::optional<CastCells> cast_cells_;
    std::optional<CastMap> cast_map_;
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

// The page's record and its block, both kept.
PageRecord MadePages::make_record(const PageIndex& page, int threads) const {
    auto block = std::make_unique<gpu::PageBlock>();
    const auto whole = std::make_unique<PyramidPage>();
    whole->summary = make_block(page, threads, *block);
    std::copy(std::begin(block->meshlets), std::end(block->meshlets), whole->nodes.begin());
    sum_up_nodes(*whole);
    hold_pages_below(*whole);
    const std::uint64_t number = number_of(page);
    const std::scoped_lock lock(mutex_);
    if (records_.size() >= records_kept) records_.clear();
    records_.emplace(number, static_cast<const PageRecord&>(*whole));
    if (unloaded_.size() >= unloaded_kept) unloaded_.clear();
    unloaded_.emplace(number, std::move(block));
    return PageRecord(*whole);
}

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
    std::array<int, gpu::height_stride> rows{};
    for (int i = 0; i < stride; ++i) rows[static_cast<std::size_t>(i)] = std::max(0, posts.region_row(i - 1));
    const std::optional<MadeSteps> by_maker = steps_of_maker(region_, rows, columns, no_coarse_octaves);
    in_parallel(stride, by_maker ? 1 : threads, [&](int i) {
        const std::span<float> H_m =
            std::span(elevations.H_m).subspan(static_cast<std::size_t>(i * stride), gpu::height_stride);
        const int row = posts.region_row(i - 1);
        std::ranges::fill(H_m, void_height_m);
        if (row < 0) return;
        std::array<float, gpu::height_stride> made{};
        if (by_maker)
            std::ranges::transform(by_maker->all.subspan(static_cast<std::size_t>(i * stride), made.size()),
                                   made.begin(), [](std::int32_t step) {
                                       return static_cast<float>(static_cast<double>(step) * made_step_m);
                                   });
        else
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
    BlockPicture picture{
        [&](int row, int column) { return may_show_node(pictures, top, row, column); },
        [&](int row, int column, double error_m) { return is_bad_node(pictures, top, row, column, error_m); },
        [&](int row, int column, const MadeNode& node) {
            return is_good_node(pictures, top, row, column, node);
        },
        {}};
    if (cast_map_) picture.may_cast = [&](int row, int column) { return may_cast_node(top, row, column); };
    ++blocks_measured;
    const bool is_for_any = pictures_.empty() || pictures.size() > most_pictures_asked;
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
    for (const Picture& picture : pictures_)
        if (ground.is_wide() || picture.culling.may_show(bound)) pictures.push_back(&picture);
    return pictures;
}

// In slices that are no higher than wide, so that little is asked for that is not over the node.
bool MadePages::may_show_node(const SomePictures& pictures, int level, int row, int column) const {
    const Ground ground = ground_of(level, row, column, static_cast<int>(gpu::meshlet_quads));
    if (ground.is_wide()) return true;
    SomePictures showing;
    for (const Picture* const picture : pictures)
        if (!picture->ground || picture->ground->may_show(level, row, column)) showing.push_back(picture);
    const double height_m = highest_h_m_ - lowest_h_m_;
    const int slices = std::clamp(static_cast<int>(std::ceil(height_m / reach_of(ground))), 1, 16);
    for (int i = 0; i < slices; ++i) {
        const PageBound slice = bound_between(ground, lowest_h_m_ + height_m * i / slices,
                                              lowest_h_m_ + height_m * (i + 1) / slices);
        for (const Picture* const picture : showing)
            if (picture->culling.may_show(slice)) return true;
    }
    return false;
}

bool MadePages::is_bad_node(const SomePictures& pictures, int level, int row, int column,
                            double error_m) const {
    const Ground ground = ground_of(level, row, column, static_cast<int>(gpu::meshlet_quads));
    if (ground.is_wide()) return false;
    if (cast_map_ && may_cast_node(level, row, column) && !fails_casters(level, row, column, error_m))
        return false;
    const PageBound around = bound_between(ground, lowest_h_m_, highest_h_m_);
    return in_all(pictures, around,
                  [&](const PictureCulling& picture) { return picture.fails_tau(around, error_m); });
}

// What a picture shows where nothing is known of what hides what: all in its frustum, in nodes that are small
// beside their distance.
void MadePages::find_lit_in_frustum(const PictureCulling& culling, const Ecef& eye, double error_per_m,
                                    const PageIndex& node, std::vector<LitGround>& lit) const {
    const LevelGrid all = level_grid(facts().grid, node.level);
    if (node.row >= all.row.nodes() || node.column >= all.column.nodes()) return;
    const Ground ground = ground_of(node.level, node.row, node.column, static_cast<int>(gpu::meshlet_quads));
    bool is_small = node.level <= 3;
    if (!ground.is_wide()) {
        const PageBound bound = bound_between(ground, lowest_h_m_, highest_h_m_);
        if (!culling.may_show(bound)) return;
        const double away_m = glm::distance(bound.centre.m, eye.m);
        is_small = is_small || away_m > 5.0 * bound.radius_m;
        const std::int64_t posts = std::int64_t{gpu::meshlet_quads} << node.level;
        if (is_small) {
            lit.push_back({node.row * posts, node.column * posts, posts,
                           error_per_m * std::max(0.5, away_m - bound.radius_m),
                           error_per_m * (away_m + bound.radius_m), away_m + bound.radius_m, lowest_h_m_});
            return;
        }
    }
    if (is_small) return;
    for (int i = 0; i < 4; ++i)
        find_lit_in_frustum(culling, eye, error_per_m,
                            {2 * node.row + i / 2, 2 * node.column + i % 2, node.level - 1}, lit);
}

std::vector<MadePages::LitGround> MadePages::lit_ground(const Picture& picture, const FrameView& view) const {
    std::vector<LitGround> lit;
    const double error_per_m =
        caster_error_per_metre(level_view(view.camera, view.tau_px).pixels_per_tangent);
    if (!picture.ground) {
        const int top = levels() - 1;
        const LevelGrid all = level_grid(facts().grid, top);
        for (int row = 0; row < all.row.nodes(); ++row)
            for (int column = 0; column < all.column.nodes(); ++column)
                find_lit_in_frustum(picture.culling, view.camera.eye_ecef(), error_per_m, {row, column, top},
                                    lit);
        return lit;
    }
    constexpr std::int64_t posts = std::int64_t{gpu::meshlet_quads} << 3;
    for (const VisibleGround::Node& node : picture.ground->nodes())
        lit.push_back({node.row * posts, node.column * posts, posts, error_per_m * node.nearest_m,
                       error_per_m * node.farthest_m, node.farthest_m, node.lowest_h_m});
    return lit;
}

// A map of what all pictures need: they have one eye, so light goes the same way in each.
void MadePages::map_casters(std::span<const FrameView> pictures, const glm::dvec3& sun_enu) {
    if (pictures.empty()) return;
    std::vector<LitGround> lit;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const std::vector<LitGround> more = lit_ground(pictures_[i], pictures[i]);
        lit.insert(lit.end(), more.begin(), more.end());
    }
    const Geodetic& eye = pictures.front().camera.eye;
    CastMap::Window window;
    for (int level = 0; level < levels(); ++level) {
        cast_cells_.emplace(*this, level);
        window = window_of_casters(*cast_cells_, lit, sun_enu);
        if (static_cast<double>(window.rows) * window.columns <= most_cast_cells) break;
    }
    cast_map_.emplace(*this, *cast_cells_, ecef_from_enu(eye.lat_deg, eye.lon_deg) * sun_enu, highest_h_m_,
                      window);
    for (const LitGround& ground : lit)
        cast_map_->receive(cast_map_->patch(ground.row, ground.column, ground.posts), 0.999 * ground.error_m,
                           1.001 * ground.most_error_m, ground.lowest_h_m - 1.0);
    cast_map_->cast();
}

// All that is lit, and as far towards the sun as light may pass ground.
CastMap::Window MadePages::window_of_casters(const CastCells& cells, std::span<const LitGround> lit,
                                             const glm::dvec3& sun_enu) const {
    int north = std::numeric_limits<int>::max(), south = -1, west = north, east = -1;
    double farthest_m = 0.0;
    const auto cell = [&](std::int64_t post, int count) {
        return static_cast<int>(std::min<std::int64_t>(post / cells.posts(), count - 1));
    };
    const PageLayout& all = cells.layout();
    for (const LitGround& ground : lit) {
        north = std::min(north, cell(ground.row, all.rows));
        south = std::max(south, cell(ground.row + ground.posts - 1, all.rows));
        west = std::min(west, cell(ground.column, all.columns));
        east = std::max(east, cell(ground.column + ground.posts - 1, all.columns));
        farthest_m = std::max(farthest_m, ground.farthest_m);
    }
    if (south < 0) return {};
    return CastMap::window_of(cells, {north, west, south - north + 1, east - west + 1}, sun_enu, farthest_m,
                              lowest_h_m_, highest_h_m_);
}

CastMap::Need MadePages::need_of_casters(int level, int row, int column) const {
    const std::int64_t posts = std::int64_t{gpu::meshlet_quads} << level;
    return cast_map_->need(cast_map_->patch(row * posts, column * posts, posts));
}

bool MadePages::may_cast_node(int level, int row, int column) const {
    const CastMap::Need need = need_of_casters(level, row, column);
    return need.low_m <= highest_h_m_ && (level > 6 || coarse_ground_.highest_m(level, row, column) >=
                                                           static_cast<float>(need.low_m) - 2.0F);
}

bool MadePages::fails_casters(int level, int row, int column, double error_m) const {
    return error_m > 1.01 * need_of_casters(level, row, column).most_error_m;
}

bool MadePages::is_good_node(const SomePictures& pictures, int level, int row, int column,
                             const MadeNode& node) const {
    const Ground ground = ground_of(level, row, column, static_cast<int>(gpu::meshlet_quads));
    if (ground.is_wide()) return false;
    // What is too coarse for light whatever it is may be any bound that is, too.
    if (cast_map_ && may_cast_node(level, row, column) &&
        static_cast<double>(node.error_m) > 0.99 * need_of_casters(level, row, column).error_m &&
        !fails_casters(level, row, column,
                       least_error_m(region_, {row / page_side, column / page_side, level})))
        return false;
    const PageBound around = bound_between(ground, lowest_h_m_, highest_h_m_);
    // The node's sphere has its middle somewhere in this one.
    PageBound with_sphere = around;
    with_sphere.radius_m += static_cast<double>(node.lod_radius_m);
    return in_all(pictures, around, [&](const PictureCulling& picture) {
        return picture.keeps_tau(with_sphere, static_cast<double>(node.error_m));
    });
}

std::unique_ptr<RegionPages> pages_measured_to(int level, const HeightField& field, MadeRegion region,
                                               const KnownPictures& pictures,
                                               std::shared_ptr<BlocksOfRegion> known) {
    RegionFacts facts = facts_of(field, region);
    auto ground = std::make_shared<const MadeGround>(
        MadeGround{region.rule, region.terrain.posts_per_deg, region.terrain.north, region.terrain.west});
    auto pages =
        std::make_unique<MadePages>(std::move(facts), std::move(region), pictures, std::move(known), level);
    pages->set_made_ground(std::move(ground));
    return pages;
}

}  // namespace

std::uint64_t blocks_measured_here() {
    return blocks_measured;
}

bool makes_pages(const MadeTerrain& terrain) {
    return terrain.kind == MadeKind::fbm || terrain.kind == MadeKind::ridged;
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

    // Of pages of level 0 by their numbers; 16 MB are kept.
    static constexpr std::size_t ranges_kept = 262'144;
    std::mutex ranges_mutex;
    std::unordered_map<std::uint64_t, PostSource::Range> ranges;

    std::optional<PostSource::Range> range_of_page(int row, int column) {
        if (CoarseGround::level >= static_cast<int>(region.bounds().size())) return std::nullopt;
        const std::uint64_t number =
            static_cast<std::uint64_t>(row) << 32U | static_cast<std::uint32_t>(column);
        {
            const std::scoped_lock lock(ranges_mutex);
            if (const auto known = ranges.find(number); known != ranges.end()) return known->second;
        }
        const CoarseGround::Tile tile = CoarseGround(region).tile(row, column);
        PostSource::Range range{1.0e9, -1.0e9};
        for (std::size_t post = 0; post < tile.coarse_m.size(); ++post) {
            range.lowest_H_m = std::min(range.lowest_H_m, static_cast<double>(tile.low_m(post)));
            range.highest_H_m = std::max(range.highest_H_m, static_cast<double>(tile.high_m(post)));
        }
        const std::scoped_lock lock(ranges_mutex);
        if (ranges.size() >= ranges_kept) ranges.clear();
        ranges.emplace(number, range);
        return range;
    }

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
    tiles_->region = made_region(terrain_, grid, {});
}
MadePostSource::~MadePostSource() = default;

float MadePostSource::H_m(int row, int column) const {
    const std::scoped_lock lock(tiles_->mutex);
    return tiles_->at(row, column)
        .H_m[static_cast<std::size_t>(row % Tiles::side * Tiles::side + column % Tiles::side)];
}

// Who asks for one row asks for the next: places of columns, which take as long as the noise, are kept.
void MadePostSource::row_H_m(int row, int first_column, std::span<float> H_m) const {
    struct Columns {
        std::int64_t first{}, posts_per_deg{};
        std::vector<MadeColumn> places;
    };
    static thread_local Columns kept;
    const std::int64_t first = terrain_.west + first_column;
    const auto end = first + static_cast<std::int64_t>(H_m.size());
    if (kept.posts_per_deg != terrain_.posts_per_deg || first < kept.first ||
        end > kept.first + static_cast<std::int64_t>(kept.places.size())) {
        constexpr int more = 2;  // diagonals look as far beyond 128 cells
        kept = {first - more, terrain_.posts_per_deg, {}};
        for (std::int64_t post = first - more; post < end + more; ++post)
            kept.places.push_back(made_column(post, terrain_.posts_per_deg));
    }
    made_posts_of_row(tiles_->region, row,
                      std::span<const MadeColumn>(kept.places)
                          .subspan(static_cast<std::size_t>(first - kept.first), H_m.size()),
                      H_m);
}

std::optional<PostSource::Range> MadePostSource::range_of_page(int page_row, int page_column) const {
    return tiles_->range_of_page(page_row, page_column);
}

std::unique_ptr<RegionPages> MadePostSource::pages(const HeightField& field,
                                                   const KnownPictures& pictures) const {
    MadeRegion region = made_region(terrain_, field.grid, field.undulation);
    const int measured_to = highest_measured_level(region);
    return pages_measured_to(measured_to, field, std::move(region), pictures,
                             tiles_->blocks_of(field.undulation));
}

std::unique_ptr<RegionPages> MadePostSource::pages_by_bounds(const HeightField& field) const {
    return pages_measured_to(0, field, made_region(terrain_, field.grid, field.undulation), {},
                             tiles_->blocks_of(field.undulation));
}

void make_posts_by(RegionPages& pages, std::shared_ptr<MadePostMaker> maker) {
    if (auto* const made = dynamic_cast<MadePages*>(&pages)) made->make_posts_by(std::move(maker));
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
