#include "core/sight/viewshed.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <mutex>
#include <numbers>
#include <utility>

#include "core/base/parallel.h"
#include "core/sight/horizon_sector.h"
#include "core/sight/mesh_silhouette.h"
#include "core/sight/swept_posts.h"
#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

// Ranges of azimuths are counted in 64ths of a turn, so that they are the same however many sectors there
// are.
constexpr int most_sectors = 64;
constexpr double infinite = std::numeric_limits<double>::infinity();

// Posts of a sector by their distance, and those of its neighbours whose edges reach into it.
struct Entry {
    int row;
    int column_and_visit;
    [[nodiscard]] int column() const { return column_and_visit / 2; }
    [[nodiscard]] bool visits() const { return column_and_visit % 2 != 0; }  // is another sector's
};

// So many that threads end at about the same time. Each takes posts of its neighbours, so not more than that.
int sectors_for(int threads) {
    return std::clamp(static_cast<int>(std::bit_ceil(8U * static_cast<unsigned>(std::max(threads, 1)))), 8,
                      most_sectors);
}

class Sweep {
  public:
    // footing: what targets stand on; null: the surface.
    Sweep(const TrueSurface& surface, const TrueSurface* footing, const ViewshedRequest& request,
          const GridPart& window)
        : surface_(surface),
          request_(request),
          window_(window),
          footing_(footing),
          target_m_(std::max(request.target_m, least_above_m)),
          observer_(surface, request.eye, request.air),
          plane_(surface, observer_, window, request.threads),
          sectors_(sectors_for(request.threads)) {
        const Geodetic& eye = request.eye;
        const double radius_m = gaussian_radius_m(eye.lat_deg);
        centre_m_ = radius_m + eye.h_m;
        reach_tangent_ = std::tan(request.radius_m / radius_m);
    }

    Viewshed result(const ViewshedProgress& progress);

  private:
    struct Shells {
        std::unique_ptr<Entry[]> entries;
        std::vector<std::size_t> begins;  // of each sector's each shell, and the end
        int count{};
        double width_m{};
    };
    void sort_posts();
    static constexpr std::uint32_t visits_before = 1, visits_after = 2, visits_all = 4, visit_bits = 3;
    static constexpr std::uint32_t no_slot = ~0U;
    [[nodiscard]] std::uint32_t slot_of(const PlanePost& post) const;
    template <class Take>
    void for_entries(std::uint32_t slot_and_visits, const Take& take) const;
    void sweep_sector(int sector, Viewshed& viewshed, std::size_t& asked) const;
    [[nodiscard]] double target_over_surface_m(const Entry& entry) const;
    // What a sector's sweep fills, and its targets that are hidden without a doubt, a shell at a time.
    struct SectorResult {
        Viewshed& viewshed;
        HiddenTargets hidden;
        std::size_t asked;
    };
    void look_at(const Entry& entry, const SweptPosts::Post& swept, const HorizonSector& sector,
                 double shell_m, SectorResult& result) const;
    [[nodiscard]] std::optional<float> deficit_over_surface_m(const Entry& entry,
                                                              const SweptPosts::Post& swept,
                                                              const HorizonSector& sector, double shell_m,
                                                              HiddenTargets::Target& hidden,
                                                              std::size_t& asked) const;
    [[nodiscard]] bool walk(std::int64_t from, const PlanePost& target, double until_m,
                            Horizon& horizon) const;
    [[nodiscard]] bool in_reach(const PlanePost& post) const;
    // By how much the azimuth's number differs, at most, between a post and its neighbours. It grows by at
    // most 1 a radian; an angle is at most half of pi times its sine, and 1.05 times it where that is small.
    [[nodiscard]] double azimuth_reach(const PlanePost& post) const {
        const double sine = plane_.longest_edge_m() / std::max(post.distance_m, 1.0e-9);
        return sine < 0.25 ? 1.05 * sine : 4.0 * sine;
    }
    void add_edges(std::int64_t number, HorizonSector& sector) const;
    [[nodiscard]] float ask_oracle(const Entry& entry, double target_m, double rise_m,
                                   std::size_t& asked) const;

    const TrueSurface& surface_;
    const ViewshedRequest& request_;
    GridPart window_;
    const TrueSurface* footing_;
    double target_m_;  // over what targets stand on
    Observer observer_;
    EyePlane plane_;
    Shells shells_;
    int sectors_;
    int ranges_{};
    double centre_m_{};       // from the eye down to the centre of curvature
    double reach_tangent_{};  // of the radius as an angle there
};

// Over the ground: the angle at the centre of curvature below the eye.
bool Sweep::in_reach(const PlanePost& post) const {
    const double across2 = post.distance_m * post.distance_m;
    const double most_m = (centre_m_ + post.z - plane_.bend_per_m() * across2) * reach_tangent_;
    return across2 <= most_m * most_m;
}

// Where a post goes: the number of its own sector's shell, and who it visits.
std::uint32_t Sweep::slot_of(const PlanePost& post) const {
    if (std::isnan(post.z) || !in_reach(post)) return no_slot;
    const int shell = std::min(static_cast<int>(post.distance_m / shells_.width_m), shells_.count - 1);
    const double place = azimuth_number(post) * (0.25 * sectors_);
    const int own = static_cast<int>(place) % sectors_;
    const double reach = azimuth_reach(post) * (0.25 * sectors_);
    const std::uint32_t visits = reach >= 1.0 ? visits_all
                                              : (place - own < reach ? visits_before : 0U) |
                                                    (own + 1 - place < reach ? visits_after : 0U);
    return static_cast<std::uint32_t>(own * shells_.count + shell) << visit_bits | visits;
}

// take(slot, is_visit) for each entry that comes of a post.
template <class Take>
void Sweep::for_entries(std::uint32_t slot_and_visits, const Take& take) const {
    const int slot = static_cast<int>(slot_and_visits >> visit_bits), count = shells_.count;
    const int all = sectors_ * count;
    take(slot, false);
    if ((slot_and_visits & visits_all) != 0) {
        for (int other = slot % count; other < all; other += count) {
            if (other != slot) take(other, true);
        }
        return;
    }
    if ((slot_and_visits & visits_before) != 0) take(slot < count ? slot + all - count : slot - count, true);
    if ((slot_and_visits & visits_after) != 0)
        take(slot + count < all ? slot + count : slot + count - all, true);
}

void Sweep::sort_posts() {
    // So narrow that few edges cross a shell's own, which are not in the sectors' horizons yet.
    shells_.width_m = std::max(0.25 * plane_.longest_edge_m(), request_.radius_m / 4.0e5);
    shells_.count = static_cast<int>(1.1 * request_.radius_m / shells_.width_m) + 2;
    // Edges that a shell's own horizon does not hold yet come so near a post of it, and are one edge long.
    plane_.bound_tangents(1.01 * (shells_.width_m + 2.0 * plane_.longest_edge_m()), request_.threads);
    const auto slots = static_cast<std::size_t>(sectors_) * static_cast<std::size_t>(shells_.count);
    const auto columns = static_cast<std::size_t>(window_.columns);
    std::vector<std::uint32_t> slot_of_post(static_cast<std::size_t>(window_.rows) * columns);
    // Each part of the rows first counts its posts, then puts them behind those of the parts before it.
    const int parts = std::clamp(request_.threads, 1, window_.rows);
    std::vector<std::vector<std::size_t>> next(static_cast<std::size_t>(parts),
                                               std::vector<std::size_t>(slots, 0));
    const auto posts_of_part = [&](int part, const auto& take) {
        const auto first = [&](int number) {
            return static_cast<int>(static_cast<std::int64_t>(window_.rows) * number / parts);
        };
        std::size_t post = static_cast<std::size_t>(first(part)) * columns;
        for (int row = first(part); row < first(part + 1); ++row)
            for (int column = 0; column < window_.columns; ++column, ++post)
                take(row, column, slot_of_post[post]);
    };
    in_parallel(parts, request_.threads, [&](int part) {
        std::vector<std::size_t>& counts = next[static_cast<std::size_t>(part)];
        posts_of_part(part, [&](int row, int column, std::uint32_t& slot) {
            slot = slot_of(plane_.post(plane_.number(row, column)));
            if (slot == no_slot) return;
            for_entries(slot, [&](int in, bool) { ++counts[static_cast<std::size_t>(in)]; });
        });
    });
    shells_.begins.assign(slots + 1, 0);
    std::size_t sum = 0;
    for (std::size_t i = 0; i < slots; ++i) {
        shells_.begins[i] = sum;
        for (std::vector<std::size_t>& of_part : next) sum += std::exchange(of_part[i], sum);
    }
    shells_.begins[slots] = sum;
    shells_.entries = std::make_unique_for_overwrite<Entry[]>(sum);
    in_parallel(parts, request_.threads, [&](int part) {
        std::vector<std::size_t>& ends = next[static_cast<std::size_t>(part)];
        posts_of_part(part, [&](int row, int column, std::uint32_t slot) {
            if (slot == no_slot) return;
            for_entries(slot, [&](int in, bool visits) {
                shells_.entries[ends[static_cast<std::size_t>(in)]++] = {row, 2 * column + (visits ? 1 : 0)};
            });
        });
    });
}

// Those to nearer posts, each once: it is the farther post's.
void Sweep::add_edges(std::int64_t number, HorizonSector& sector) const {
    const PlanePost& post = plane_.post(number);
    const double own2 = along(post, post);
    const EyePlane::Neighbours next = plane_.neighbours(number);
    for (int i = 0; i < next.count; ++i) {
        const auto neighbour = [&](int of) {
            return next.numbers[static_cast<std::size_t>(of % next.count)];
        };
        const std::int64_t other = neighbour(i);
        const PlanePost& its = plane_.post(other);
        const double its2 = along(its, its);
        if (!(its2 < own2 || (its2 == own2 && other < number))) continue;
        const bool before = std::isnan(plane_.post(neighbour(i + next.count - 1)).z);
        const bool after = std::isnan(plane_.post(neighbour(i + 1)).z);
        // An edge of no triangle is no ground.
        if (!(before && after)) sector.add_edge(number, other, before != after);
    }
}

// From a post towards the eye, in a target's direction, triangle by triangle, until all edges beyond are
// nearer than `until_m`. False where the net ends on the way, or a line of sight runs along an edge.
bool Sweep::walk(std::int64_t from, const PlanePost& target, double until_m, Horizon& horizon) const {
    const double length2 = along(target, target), length_m = target.distance_m;
    const EyePlane::Neighbours next = plane_.neighbours(from);
    std::int64_t before = from, left = -1, right = -1;
    double of_left = 0.0, of_right = 0.0;  // each the other's turn from the line: a weight
    double turn_one = 0.0, turn_two = turn(target, plane_.post(next.numbers[0]));
    for (int i = 0; i < next.count; ++i) {
        const std::int64_t one = next.numbers[static_cast<std::size_t>(i)],
                           two = next.numbers[static_cast<std::size_t>((i + 1) % next.count)];
        turn_one = turn_two;
        turn_two = turn(target, plane_.post(two));
        if (!(turn_one * turn_two <= 0.0)) continue;
        const double size = std::abs(turn_one) + std::abs(turn_two);
        const double at = along(plane_.post(one), target) * std::abs(turn_two) +
                          along(plane_.post(two), target) * std::abs(turn_one);
        if (!(at < length2 * size)) continue;
        left = turn_one > turn_two ? one : two;
        right = turn_one > turn_two ? two : one;
        of_left = std::max(turn_one, turn_two);
        of_right = -std::min(turn_one, turn_two);
        break;
    }
    if (left < 0) return false;
    const double last_m = until_m - plane_.longest_edge_m();
    for (;;) {
        const PlanePost &a = plane_.post(left), &b = plane_.post(right);
        const double sum = of_left + of_right;
        if (!(sum > 0.0)) return false;
        const double distance_m =
            (along(a, target) * of_right + along(b, target) * of_left) / (sum * length_m);
        if (distance_m <= 0.0) return true;
        const std::int64_t after = plane_.beyond(left, right, before);
        const PlanePost& third = plane_.post(after);
        const double height_m = (a.z * of_right + b.z * of_left) / sum + plane_.bulge_m(a, b, of_left / sum);
        const bool none_before = std::isnan(plane_.post(before).z), none_after = std::isnan(third.z);
        if (!std::isnan(height_m) && !(none_before && none_after)) {
            horizon.add(height_m, distance_m, plane_.error_m());
            horizon.has_rim |= none_before != none_after;
        }
        if (distance_m < last_m) return true;
        const double turned = turn(target, third);
        if (std::isnan(turned)) return false;
        if (turned > 0.0) {
            before = left;
            left = after;
            of_left = turned;
        } else {
            before = right;
            right = after;
            of_right = -turned;
        }
    }
}

// The column of a grid's own posts that a window's column is.
int own_column(const PostGrid& grid, int column) {
    if (!grid.wraps_longitude()) return column;
    const int turn_columns = grid.columns() - 1;
    return ((column % turn_columns) + turn_columns) % turn_columns;
}

// Height of a post's target over the surface that hides; of one that stands within that, below 0.
double Sweep::target_over_surface_m(const Entry& entry) const {
    if (!footing_) return target_m_;
    const int row = window_.first_row + entry.row;
    const int column = own_column(surface_.field().grid, window_.first_column + entry.column());
    const std::optional<double> top_m = surface_.post_h_m(row, column),
                                foot_m = footing_->post_h_m(row, column);
    return top_m && foot_m ? target_m_ - (*top_m - *foot_m) : target_m_;
}

// A target within the surface would have to be out of it at least, and then as high as is seen.
void Sweep::look_at(const Entry& entry, const SweptPosts::Post& swept, const HorizonSector& sector,
                    double shell_m, SectorResult& result) const {
    const double over_m = target_over_surface_m(entry), target_m = std::max(over_m, least_above_m);
    const std::size_t cell = static_cast<std::size_t>(entry.row) * static_cast<std::size_t>(window_.columns) +
                             static_cast<std::size_t>(entry.column());
    HiddenTargets::Target hidden{cell, 0.0, 0.0, 0.0, 0.0, 0.0, target_m, target_m - over_m};
    const std::optional<float> missed_m =
        deficit_over_surface_m(entry, swept, sector, shell_m, hidden, result.asked);
    if (!missed_m)
        result.hidden.add(hidden);
    else
        result.viewshed.clearance_deficit_m[cell] =
            over_m < target_m ? *missed_m + static_cast<float>(target_m - over_m) : *missed_m;
}

float Sweep::ask_oracle(const Entry& entry, double target_m, double rise_m, std::size_t& asked) const {
    ++asked;
    const int row = window_.first_row + entry.row;
    const int column = window_.first_column + entry.column();
    const Geodetic target = target_over_post(surface_, row, column, target_m);
    if (observer_.sees(target)) return 0.0F;
    constexpr double certain_rise_m = 1.0e-4;
    if (rise_m > certain_rise_m) return static_cast<float>(rise_m);
    const std::optional<double> by_m = observer_.clearance_deficit_m(target);
    return by_m ? std::max(static_cast<float>(*by_m), std::numeric_limits<float>::min())
                : std::numeric_limits<float>::infinity();
}

// Nothing where `hidden`, which is then filled, has all that the deficit follows from.
std::optional<float> Sweep::deficit_over_surface_m(const Entry& entry, const SweptPosts::Post& swept,
                                                   const HorizonSector& sector, double shell_m,
                                                   HiddenTargets::Target& hidden, std::size_t& asked) const {
    const int row = entry.row, column = entry.column();
    const std::int64_t number = plane_.number(row, column);
    const PlanePost& post = plane_.post(number);
    const double s_m = post.distance_m, target_m = hidden.target_m;
    Horizon horizon;
    bool known = s_m > 1.0e-3 && sector.horizon(post, swept.range, horizon);
    if (!known) {
        horizon = {};
        known = s_m > 1.0e-3 && walk(number, post, 0.0, horizon);
    } else if (horizon.has_rim || !(horizon.lowest > swept.most_tangent)) {
        // Of what the sector's horizon does not hold yet something may be higher.
        known = walk(number, post, shell_m, horizon);
    }
    const bool in_doubt = !known;
    if (in_doubt) {
        // Along an edge, maybe: then a hair's breadth beside it. The oracle has the last word.
        constexpr double aside = 1.0e-9;
        const PlanePost aside_post{post.x - aside * post.y, post.y + aside * post.x, post.z, s_m,
                                   post.tangent};
        horizon = {};
        if (!(s_m > 1.0e-3 && walk(number, aside_post, 0.0, horizon)))
            return ask_oracle(entry, target_m, -1.0, asked);
    }
    // The target, and how it moves as it is raised along the ellipsoid's normal there.
    const double up_s = swept.up_s, up_z = swept.up_z, bend = plane_.bend_per_m();
    const double ground_z_m = post.z - bend * s_m * s_m;
    const auto needed_m = [&](double tangent) {
        return needed_height_m(ground_z_m, s_m, up_s, up_z, bend, tangent);
    };
    if (horizon.tangent == Horizon::none) return in_doubt ? ask_oracle(entry, target_m, -1.0, asked) : 0.0F;
    const auto rise_m = [&] { return needed_m(horizon.tangent) - target_m; };
    if (in_doubt) return ask_oracle(entry, target_m, rise_m(), asked);
    // What a target's own way up turns from the line of sight, and what is rounded.
    const double slack_m = 1.0e-5 + 1.0e-9 * s_m + 10.0 * swept.aside * target_m;
    // Without a division: whether a line at a tangent runs higher over the post than so, and well so.
    const auto is_over = [&](double tangent, double t_m) {
        const double there_m = s_m + t_m * up_s;
        const double over_line_m = ground_z_m + t_m * up_z + bend * there_m * there_m - tangent * there_m;
        return over_line_m < -0.1 * slack_m && up_z + (2.0 * bend * there_m - tangent) * up_s > 0.5;
    };
    // Below ground that ends a line may run free.
    if (!horizon.has_rim && is_over(horizon.lowest, target_m + slack_m)) {
        hidden = {hidden.cell, ground_z_m, s_m, up_s, up_z, horizon.tangent, target_m, hidden.further_m};
        return std::nullopt;
    }
    if (needed_m(horizon.highest) - target_m < -slack_m) return 0.0F;
    if (!horizon.has_rim && needed_m(horizon.lowest) - target_m > slack_m)
        return static_cast<float>(rise_m());
    return ask_oracle(entry, target_m, rise_m(), asked);
}

void Sweep::sweep_sector(int sector, Viewshed& viewshed, std::size_t& asked) const {
    const int each = ranges_ / sectors_;
    HorizonSector horizon(plane_, ranges_, sector * each, each);
    SweptPosts posts(plane_, ranges_, sector * each, each);
    SectorResult result{viewshed, {}, 0};
    const std::size_t* const begins =
        shells_.begins.data() + static_cast<std::size_t>(sector) * static_cast<std::size_t>(shells_.count);
    for (int shell = 0; shell < shells_.count && !request_.stop.stop_requested(); ++shell) {
        const Entry* const from = shells_.entries.get() + begins[shell];
        const Entry* const to = shells_.entries.get() + begins[shell + 1];
        posts.clear();
        for (const Entry* entry = from; entry != to; ++entry) {
            // Posts of a shell lie in many rows: those that follow are fetched meanwhile.
            constexpr std::ptrdiff_t ahead = 12;
            if (to - entry > ahead) plane_.fetch(plane_.number(entry[ahead].row, entry[ahead].column()));
            posts.add(
                plane_.number(entry->row, entry->column()),
                entry->visits() ? glm::dvec3(0.0, 0.0, 1.0) : plane_.normal(entry->row, entry->column()));
        }
        posts.measure();
        result.hidden.clear();
        for (const Entry* entry = from; entry != to; ++entry)
            if (!entry->visits())
                look_at(*entry, posts.at(static_cast<std::size_t>(entry - from)), horizon,
                        shell * shells_.width_m, result);
        result.hidden.write(plane_.bend_per_m(), viewshed.clearance_deficit_m);
        for (const Entry* entry = from; entry != to; ++entry) {
            const SweptPosts::Post post = posts.at(static_cast<std::size_t>(entry - from));
            // Most ground lies below what is nearer: then no edge of the post is looked at. (Near posts that
            // have no height, where ground ends, there is no such bound.)
            if (post.most_tangent < infinite &&
                horizon.is_above(post.first_range, post.last_range, post.most_tangent))
                continue;
            add_edges(plane_.number(entry->row, entry->column()), horizon);
        }
    }
    asked = result.asked;
}

Viewshed Sweep::result(const ViewshedProgress& progress) {
    Viewshed viewshed{window_, {}, 0};
    viewshed.clearance_deficit_m.assign(
        static_cast<std::size_t>(window_.rows) * static_cast<std::size_t>(window_.columns),
        Viewshed::unknown);
    sort_posts();
    // Ranges about as wide as posts are apart at the rim.
    const double around = 4.0 * request_.radius_m / plane_.longest_edge_m();
    ranges_ = most_sectors * std::clamp(static_cast<int>(8.0 * around / most_sectors), 4, 1 << 14);
    std::mutex telling;
    int done = 0;
    std::atomic<std::size_t> asked{0};
    in_parallel(sectors_, request_.threads, [&](int sector) {
        std::size_t own = 0;
        sweep_sector(sector, viewshed, own);
        asked += own;
        const std::lock_guard lock(telling);
        if (progress) progress(static_cast<double>(++done) / sectors_);
    });
    viewshed.asked = asked;
    return viewshed;
}

// Whether another grid, or a step along its rim, may come between the eye and a target.
bool others_reach(const TrueGround& ground, std::size_t grid, const ViewshedRequest& request) {
    for (std::size_t other = 0; other < ground.grids(); ++other) {
        if (other == grid) continue;
        const GridPart window =
            window_around(ground.surface(other).field().grid, request.eye, request.radius_m);
        if (window.rows > 0 && window.columns > 0) return true;
    }
    return false;
}

// The circle around an eye: as Viewshed of one grid has it, an angle at the centre of curvature.
class Reach {
  public:
    explicit Reach(const ViewshedRequest& request)
        : enu_(ecef_from_enu(request.eye.lat_deg, request.eye.lon_deg)),
          eye_m_(ecef_from_geodetic(request.eye).m) {
        const double radius_m = gaussian_radius_m(request.eye.lat_deg);
        centre_m_ = radius_m + request.eye.h_m;
        tangent_ = std::tan(request.radius_m / radius_m);
    }
    [[nodiscard]] bool holds(const Geodetic& place) const {
        const glm::dvec3 way = glm::transpose(enu_) * (ecef_from_geodetic(place).m - eye_m_);
        const double below_m = centre_m_ + way.z;
        return below_m > 0.0 && std::hypot(way.x, way.y) <= below_m * tangent_;
    }

  private:
    glm::dmat3 enu_;
    glm::dvec3 eye_m_;
    double centre_m_;
    double tangent_;
};

float clearance_deficit_to_m(const Observer& observer, const Geodetic& target) {
    const std::optional<double> by_m = observer.clearance_deficit_m(target);
    return by_m ? static_cast<float>(*by_m) : std::numeric_limits<float>::infinity();
}

// What a sweep over the terrain alone is corrected by.
struct PastMeshes {
    const TrueGround& ground;
    const TrueGround& footing;
    const ViewshedRequest& request;
    const TrueSurface& surface;

    // Where a post's target stands on a top, that; else where the sweep has it.
    [[nodiscard]] std::optional<Geodetic> target_on_top(const Geodetic& on_ground) const {
        if (!request.top_h_m) return std::nullopt;
        const std::optional<double> top_m = request.top_h_m(on_ground.lat_deg, on_ground.lon_deg);
        const double above_m = std::max(request.target_m, least_above_m);
        if (!top_m || *top_m + above_m <= on_ground.h_m) return std::nullopt;
        return Geodetic{on_ground.lat_deg, on_ground.lon_deg, *top_m + above_m};
    }
};

void ask_meshes(const PastMeshes& past, Viewshed& viewshed) {
    const Sight sight = sight_from(past.request.eye, past.request.air);
    const MeshSilhouette silhouette(past.ground, sight);
    if (!silhouette.any()) return;
    const Observer observer(past.ground, past.request.eye, past.request.air);
    const GridPart& window = viewshed.window;
    std::atomic<std::size_t> asked{0};
    in_parallel(window.rows, past.request.threads, [&](int number) {
        if (past.request.stop.stop_requested()) return;
        const int row = window.first_row + number;
        for (int column = window.first_column; column < window.first_column + window.columns; ++column) {
            float& missed_m = viewshed.clearance_deficit_m[window.number(row, column)];
            if (missed_m == Viewshed::unknown || std::isinf(missed_m)) continue;
            Geodetic target = target_over_post(past.surface, row, column, past.request.target_m);
            if (past.request.footing != nullptr)
                if (const auto ground_m = past.footing.h_m(target.lat_deg, target.lon_deg))
                    target.h_m = *ground_m + std::max(past.request.target_m, least_above_m);
            const std::optional<Geodetic> on_top = past.target_on_top(target);
            Geodetic seen = target;  // at the height where terrain alone lets it be seen
            seen.h_m += static_cast<double>(missed_m);
            if (!on_top && !silhouette.may_hide(seen)) continue;
            missed_m = clearance_deficit_to_m(observer, on_top.value_or(target));
            ++asked;
        }
    });
    viewshed.asked += asked;
}

}  // namespace

Geodetic target_over_post(const TrueSurface& surface, int row, int column, double target_m) {
    const PostGrid& grid = surface.field().grid;
    if (grid.net) {
        const PostPlace place = grid.net->place_at(row, column);
        return {place.lat_deg, place.lon_deg,
                surface.post_h_m(row, column).value_or(0.0) + std::max(target_m, least_above_m)};
    }
    const double lat_deg = row_lat_deg(grid, row);
    const double lon_deg = normalised_lon_deg(grid.lon.at_deg(column));
    const std::optional<double> ground_m = surface.post_h_m(row, own_column(grid, column));
    return {lat_deg, lon_deg, ground_m.value_or(0.0) + std::max(target_m, least_above_m)};
}

std::optional<std::size_t> grid_of_most(const TrueGround& ground, const std::vector<Geodetic>& eyes,
                                        double radius_m) {
    constexpr int bearings = 64, rings = 24;
    // First what a grid has of the places, then what of it is seen: of two that hold all the finer.
    std::vector<std::pair<int, int>> held(ground.grids());
    for (const Geodetic& eye : eyes) {
        const glm::dmat3 enu = ecef_from_enu(eye.lat_deg, eye.lon_deg);
        for (int i = 0; i < bearings * rings; ++i) {
            // Rings of the same area, turned so that they do not line up with a grid.
            const double angle =
                radius_m / wgs84_a_m * std::sqrt((static_cast<double>(i / bearings) + 0.5) / rings);
            const double bearing = 2.0 * std::numbers::pi * (i % bearings) / bearings + 0.1 * (i / bearings);
            const PostPlace place =
                place_of_normal(std::cos(angle) * enu[2] +
                                std::sin(angle) * (std::cos(bearing) * enu[1] + std::sin(bearing) * enu[0]));
            // Of one grid it is enough to know that it has any.
            if (held.size() == 1 && held[0].first > 0) return 0;
            for (std::size_t grid = 0; grid < held.size(); ++grid)
                held[grid].first += ground.surface(grid).h_m(place.lat_deg, place.lon_deg).has_value();
            if (const auto shown = ground.grid_at(place.lat_deg, place.lon_deg)) ++held[*shown].second;
        }
    }
    const auto most = std::ranges::max_element(held);
    if (most->first == 0) return std::nullopt;
    return static_cast<std::size_t>(most - held.begin());
}

Viewshed viewshed(const TrueGround& ground, std::size_t grid, const ViewshedRequest& request,
                  const ViewshedProgress& progress) {
    const TrueSurface& surface = ground.surface(grid);
    Viewshed viewshed{window_around(surface.field().grid, request.eye, request.radius_m), {}, 0};
    const GridPart& window = viewshed.window;
    if (window.rows < 1 || window.columns < 1) return {};
    // A sweep takes 0.4 microseconds a post (docs/commands/viewshed.md), where a line of sight asks the
    // oracle.
    const TrueGround& footing = request.footing ? *request.footing : ground;
    const TrueSurface* const stood_on = request.footing ? &footing.surface(grid) : nullptr;
    if (!others_reach(ground, grid, request)) {
        viewshed = Sweep(surface, stood_on, request, window).result(progress);
        ask_meshes({ground, footing, request, surface}, viewshed);
        return viewshed;
    }
    viewshed.clearance_deficit_m.assign(
        static_cast<std::size_t>(window.rows) * static_cast<std::size_t>(window.columns), Viewshed::unknown);
    const Observer observer(ground, request.eye, request.air);
    const Reach reach(request);
    std::mutex telling;
    int done = 0;
    in_parallel(window.rows, request.threads, [&](int number) {
        std::size_t asked = 0;
        if (request.stop.stop_requested()) return;
        const int row = window.first_row + number;
        for (int column = window.first_column; column < window.first_column + window.columns; ++column) {
            Geodetic target = target_over_post(surface, row, column, 0.0);
            const std::optional<double> ground_m = footing.h_m(target.lat_deg, target.lon_deg);
            if (!ground_m) continue;
            target.h_m = *ground_m;
            if (!reach.holds(target)) continue;
            if (request.top_h_m)
                target.h_m = std::max(target.h_m,
                                      request.top_h_m(target.lat_deg, target.lon_deg).value_or(target.h_m));
            target.h_m += std::max(request.target_m, least_above_m);
            viewshed.clearance_deficit_m[window.number(row, column)] =
                clearance_deficit_to_m(observer, target);
            ++asked;
        }
        const std::lock_guard lock(telling);
        viewshed.asked += asked;
        if (progress) progress(static_cast<double>(++done) / window.rows);
    });
    return viewshed;
}

}  // namespace oro
