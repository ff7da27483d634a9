#include "apps/names/seen_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <tuple>
#include <utility>

#include "core/base/parallel.h"
#include "core/terrain/summit.h"

namespace oro {
namespace {

constexpr double hit_slack_m = 0.01;  // a hit so near the point is the point's own ground
constexpr double behind_all_m = 1e6;  // H counts for so much less than a prominence

double H_over(double h_m, double N_m, double exaggeration) {
    return (h_m - N_m) / exaggeration;
}

// By what the point tells itself, above the ellipsoid and not exaggerated; nothing where it tells none.
std::optional<double> own_h_m(const NamedPoint& point, double ground_h_m, double N_m) {
    switch (point.heights) {
        case HeightAbove::nothing:
            return std::nullopt;
        case HeightAbove::sea_level:
            return point.height_m + N_m;
        case HeightAbove::ellipsoid:
            return point.height_m;
        case HeightAbove::ground:
            return ground_h_m + point.height_m;
    }
    return std::nullopt;
}

}  // namespace

PointsInView::PointsInView(const TrueGround& ground, const Camera& camera, const WorldModel& model)
    : ground_(ground),
      camera_(camera),
      model_(model),
      view_from_ecef_(camera.view_from_ecef()),
      enu_from_ecef_(glm::transpose(ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg))),
      oracle_(ground, sight_of(model, camera.eye)) {}

PointsInView::PointsInView(const TrueGround& ground, const Camera& camera, const WorldModel& model,
                           const Cylinder& around)
    : PointsInView(ground, camera, model) {
    around_ = around;
}

glm::dvec3 PointsInView::view_m(const Geodetic& point) const {
    return view_from_ecef_ * model_offset_m(model_, camera_.eye, point);
}

glm::dvec2 PointsInView::projected_px(const glm::dvec3& view_m) const {
    const glm::dvec2 tangent = glm::dvec2(view_m.x, -view_m.y) / -view_m.z;
    return 0.5 * glm::dvec2(camera_.width_px, camera_.height_px) *
           (1.0 + tangent / camera_.half_fov_tangent());
}

std::optional<glm::dvec2> PointsInView::place_px(const Geodetic& point) const {
    if (around_) return around_->place_px(enu_from_ecef_ * model_offset_m(model_, camera_.eye, point));
    const glm::dvec3 in_view_m = view_m(point);
    if (in_view_m.z >= -near_plane_m) return std::nullopt;
    return projected_px(in_view_m);
}

bool PointsInView::sees(const Geodetic& point, double above_m) const {
    const glm::dvec3 offset_m =
        model_offset_m(model_, camera_.eye, {point.lat_deg, point.lon_deg, point.h_m + above_m});
    const double distance_m = glm::length(offset_m);
    if (distance_m <= hit_slack_m) return true;
    const auto hit = oracle_.first_hit(offset_m / distance_m, distance_m);
    return !hit || hit->distance_m >= distance_m - hit_slack_m;
}

void PointsInView::put_at(const Geodetic& place, SeenPoint& point) const {
    constexpr glm::dvec2 nowhere(-1.0);
    point.place = place;
    point.place_px = place_px(place).value_or(nowhere);
    point.distance_m = glm::length(model_offset_m(model_, camera_.eye, place));
}

bool PointsInView::in_picture(const SeenPoint& point) const {
    const glm::dvec2 at = point.place_px;
    if (around_) return around_->holds(at);
    return at.x >= 0.0 && at.y >= 0.0 && at.x < camera_.width_px && at.y < camera_.height_px;
}

std::optional<Geodetic> PointsInView::summit_near(const Geodetic& place) const {
    const TrueSurface& surface =
        ground_.surface(ground_.data_grid_at(place.lat_deg, place.lon_deg).value_or(0));
    return highest_post_near(surface.field().grid, place,
                             [&](int row, int column) { return surface.post_h_m(row, column); });
}

bool PointsInView::sees_or_moves(SeenPoint& point) const {
    if (sees(point.place, seen_above_m)) return true;
    if (!point.may_move) return false;
    const auto summit = summit_near(point.place);
    if (!summit || !sees(*summit, seen_above_m)) return false;
    put_at(*summit, point);
    point.is_moved = true;
    return in_picture(point);
}

std::optional<SeenPoint> PointsInView::placed(const NamedPoint& point, PointCounts& counts) const {
    const auto ground_h_m = ground_.h_m(point.lat_deg, point.lon_deg);
    if (!ground_h_m) {
        ++counts.beyond_data;
        return std::nullopt;
    }
    const double N_m = ground_.N_m(point.lat_deg, point.lon_deg), exaggeration = ground_.exaggeration(),
                 ground_H_m = H_over(*ground_h_m, N_m, exaggeration);
    SeenPoint seen;
    seen.name = point.name;
    seen.lat_deg = point.lat_deg;
    seen.lon_deg = point.lon_deg;
    seen.H_m = ground_H_m;
    if (canopy_m_) seen.H_m -= canopy_m_({point.lat_deg, point.lon_deg, 0.0});
    double h_m = *ground_h_m;
    const auto tell = [&](double H_m) { seen.H_m = H_m; };
    const double most_off_m = std::max(most_off_ground_m, most_off_ground_share * std::abs(ground_H_m));
    if (const auto own = own_h_m(point, ground_H_m + N_m, N_m)) {
        const double H_m = *own - N_m, above_m = H_m - ground_H_m;
        const bool stands_there = above_m >= 0.0 && above_m <= highest_above_ground_m;
        if (stands_there) h_m = H_m * exaggeration + N_m;
        if (stands_there || std::abs(above_m) <= most_off_m) tell(H_m);
    }
    if (point.stated_H_m && std::abs(*point.stated_H_m - ground_H_m) <= most_off_m) tell(*point.stated_H_m);
    put_at({seen.lat_deg, seen.lon_deg, h_m}, seen);
    if (!in_picture(seen)) {
        ++counts.outside;
        return std::nullopt;
    }
    seen.may_move = point.may_be_summit;
    seen.rank = point.prominence_m ? *point.prominence_m : seen.H_m - behind_all_m;
    return seen;
}

std::vector<SeenPoint> PointsInView::seen(const std::vector<NamedPoint>& points, PointCounts& counts) const {
    std::vector<SeenPoint> all;
    for (const NamedPoint& point : points) {
        if (auto one = placed(point, counts)) all.push_back(std::move(*one));
    }
    std::vector<char> is_seen(all.size());
    in_parallel(static_cast<int>(all.size()), thread_count(), [&](int number) {
        const auto i = static_cast<std::size_t>(number);
        is_seen[i] = sees_or_moves(all[i]) ? 1 : 0;
    });
    std::vector<SeenPoint> seen;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (is_seen[i] != 0)
            seen.push_back(std::move(all[i]));
        else
            ++counts.hidden;
    }
    std::ranges::stable_sort(seen, [](const SeenPoint& a, const SeenPoint& b) {
        return std::tie(b.rank, a.distance_m, a.name, a.lat_deg, a.lon_deg) <
               std::tie(a.rank, b.distance_m, b.name, b.lat_deg, b.lon_deg);
    });
    return seen;
}

std::string note_of_no_name(const PointCounts& counts, std::size_t without_letters,
                            std::size_t without_room) {
    const std::array<std::pair<std::size_t, const char*>, 5> reasons{
        {{static_cast<std::size_t>(counts.hidden), "hidden behind the ground"},
         {static_cast<std::size_t>(counts.outside), "outside of the view"},
         {static_cast<std::size_t>(counts.beyond_data), "beyond the data"},
         {without_letters, "with letters that the font has not"},
         {without_room, "without room"}}};
    std::string note;
    for (const auto& [count, why] : reasons)
        if (count > 0)
            note += (note.empty() ? "of the names none shows: " : ", ") + std::to_string(count) + " " + why;
    return note;
}

}  // namespace oro
