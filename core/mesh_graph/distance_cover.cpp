#include "core/mesh_graph/distance_cover.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/mesh_graph/mesh_ground.h"

namespace oro {
namespace {

// A polygon so small is as far as its middle, and its radius more.
constexpr double smallest_radius_m = 1.0e-4;
constexpr int most_cuts_deep = 200;
// Of 12 corners a polygon has at most, a cut adds one.
constexpr std::size_t most_corners_to_cut = 10;

}  // namespace

double DistanceCover::accepted_m() const {
    return std::max(1.02 * found_m_, found_m_ + 0.001);
}

int DistanceCover::user_of(std::uint32_t place) const {
    return users_.empty() ? 0 : users_[set_.number(place)];
}

// Of the nearest triangle; and of the ground, where that is not near enough.
DistanceCover::Corner DistanceCover::exact_corner(const glm::dvec3& at, std::uint32_t hint) const {
    const NearestTriangles::Near nearest = set_.nearest(at, hint);
    Corner exact{at, nearest.distance2, nearest.place, true};
    const double enough2 = accepted_m() * accepted_m();
    if (ground_ == nullptr || exact.distance2 <= enough2) return exact;
    const NearestTriangles::Near below =
        ground_->within(at, enough2, exact.distance2, NearestTriangles::nothing);
    if (below.place != NearestTriangles::nothing) exact.ground2 = below.distance2;
    return exact;
}

// Any triangle that is near enough will do where there is no ground: mostly a neighbour's.
DistanceCover::Corner DistanceCover::corner(const glm::dvec3& at, std::uint32_t hint) const {
    if (ground_ != nullptr) return exact_corner(at, hint);
    const double accepted = accepted_m();
    const NearestTriangles::Near near =
        set_.within(at, accepted * accepted, std::numeric_limits<double>::infinity(), hint);
    return {at, near.distance2, near.place, false};
}

// A corner that is not accepted was measured to the nearest triangle.
void DistanceCover::note(const Corner& corner) {
    const double accepted = accepted_m(), distance2 = std::min(corner.distance2, corner.ground2);
    if (distance2 > accepted * accepted) found_m_ = std::sqrt(distance2);
}

void DistanceCover::make_exact(Polygon& polygon) const {
    for (std::size_t i = 0; i < polygon.count; ++i) {
        Corner& one = polygon.corners[i];
        if (one.is_exact) continue;
        const NearestTriangles::Near near = set_.nearest(one.at, one.place);
        one = {one.at, near.distance2, near.place, true};
    }
}

DistanceCover::Best DistanceCover::by_triangle(const Polygon& polygon, std::uint32_t place,
                                               double stop2) const {
    Best best{0.0, place, 0};
    for (std::size_t i = 0; i < polygon.count && best.distance2 < stop2; ++i) {
        const Corner& one = polygon.corners[i];
        const double d2 = one.place == place ? one.distance2 : set_.distance2(place, one.at);
        if (d2 > best.distance2) best.distance2 = d2, best.worst = i;
    }
    return best;
}

DistanceCover::Best DistanceCover::best_of_corners(const Polygon& polygon) const {
    Best best{std::numeric_limits<double>::infinity(), 0, 0};
    const double accepted = accepted_m();
    for (std::size_t k = 0; k < polygon.count; ++k) {
        const std::uint32_t place = polygon.corners[k].place;
        const auto* const before = polygon.corners.begin() + k;
        if (std::any_of(polygon.corners.begin(), before,
                        [&](const Corner& other) { return other.place == place; }))
            continue;
        const Best one = by_triangle(polygon, place, best.distance2);
        if (one.distance2 < best.distance2) best = one;
        if (best.distance2 <= accepted * accepted) break;
    }
    return best;
}

DistanceCover::Reach DistanceCover::reach_of(const Polygon& polygon) {
    Reach reach;
    for (std::size_t i = 0; i < polygon.count; ++i) reach.middle += polygon.corners[i].at;
    reach.middle /= static_cast<double>(polygon.count);
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const double radius = glm::distance(reach.middle, polygon.corners[i].at);
        if (radius > reach.radius_m) reach.radius_m = radius, reach.farthest = i;
    }
    return reach;
}

int DistanceCover::accept(double bound_m, std::uint32_t place) {
    bound_m_ = std::max(bound_m_, bound_m);
    hint_ = place;
    return user_of(place);
}

DistanceCover::Plane DistanceCover::where_to_cut(const Polygon& polygon,
                                                 const std::array<glm::dvec3, 3>& sides, std::size_t worst,
                                                 const Reach& reach, int depth) {
    const double size = std::max({glm::distance(sides[0], sides[1]), glm::distance(sides[1], sides[2]),
                                  glm::distance(sides[2], sides[0])});
    Plane plane;
    double most = 0.0;
    if (polygon.count < most_corners_to_cut && reach.radius_m < 2.5 * size && depth % 6 != 5) {
        const glm::dvec3 up = glm::cross(sides[1] - sides[0], sides[2] - sides[0]);
        for (std::size_t k = 0; k < 3; ++k) {
            glm::dvec3 out = glm::cross(sides[(k + 1) % 3] - sides[k], up);
            const double length = glm::length(out);
            if (!(length > 0.0)) continue;
            out /= length;
            const double beyond = glm::dot(polygon.corners[worst].at - sides[k], out);
            if (beyond <= std::max(most, 0.02 * reach.radius_m)) continue;
            double least = beyond;
            for (std::size_t i = 0; i < polygon.count; ++i)
                least = std::min(least, glm::dot(polygon.corners[i].at - sides[k], out));
            // Nearly all of it lies on one side.
            if (least > -0.02 * reach.radius_m) continue;
            most = beyond, plane = {sides[k], out};
        }
    }
    if (most > 0.0) return plane;
    const glm::dvec3& one = polygon.corners[reach.farthest].at;
    glm::dvec3 other = one;
    for (std::size_t i = 0; i < polygon.count; ++i)
        if (glm::distance(one, polygon.corners[i].at) > glm::distance(one, other))
            other = polygon.corners[i].at;
    return {0.5 * (one + other), other - one};
}

void DistanceCover::cut(const Polygon& polygon, const Plane& plane, std::uint32_t hint, Polygon& inside,
                        Polygon& outside) const {
    std::array<double, OriginalPart::most_corners> beyond{};
    for (std::size_t i = 0; i < polygon.count; ++i)
        beyond[i] = glm::dot(polygon.corners[i].at - plane.at, plane.normal);
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const std::size_t k = i + 1 == polygon.count ? 0 : i + 1;
        if (beyond[i] <= 0.0) inside.corners[inside.count++] = polygon.corners[i];
        if (beyond[i] >= 0.0) outside.corners[outside.count++] = polygon.corners[i];
        if ((beyond[i] < 0.0 && beyond[k] > 0.0) || (beyond[i] > 0.0 && beyond[k] < 0.0)) {
            const double share = beyond[i] / (beyond[i] - beyond[k]);
            const glm::dvec3 at =
                polygon.corners[i].at + share * (polygon.corners[k].at - polygon.corners[i].at);
            inside.corners[inside.count++] = outside.corners[outside.count++] = corner(at, hint);
        }
    }
    if (!polygon.has_marked) return;
    const bool is_inside = glm::dot(marked_ - plane.at, plane.normal) <= 0.0;
    inside.has_marked = outside.count < 3 || (is_inside && inside.count >= 3);
    outside.has_marked = !inside.has_marked;
}

int DistanceCover::cover(Polygon& polygon, int depth, std::uint32_t triangle) {
    for (std::size_t i = 0; i < polygon.count; ++i) note(polygon.corners[i]);
    const auto accepted2 = [&] { return accepted_m() * accepted_m(); };
    Best best = best_of_corners(polygon);
    if (best.distance2 > accepted2()) {
        make_exact(polygon);
        best = best_of_corners(polygon);
    }
    if (found_m_ > enough_m_) return accept(found_m_, best.place);
    if (best.distance2 <= accepted2()) return accept(std::sqrt(best.distance2), best.place);
    Best below{std::numeric_limits<double>::infinity(), 0, 0};
    if (ground_ != nullptr) below = best_on_ground(polygon);
    if (below.distance2 <= accepted2()) return accept_on_ground(std::sqrt(below.distance2));
    const Reach reach = reach_of(polygon);
    const Corner middle = exact_corner(reach.middle, best.place);
    note(middle);
    const Best of_middle = by_triangle(polygon, middle.place, std::numeric_limits<double>::infinity());
    if (of_middle.distance2 < best.distance2 || depth % 3 == 2) best = of_middle;
    if (best.distance2 <= accepted2()) return accept(std::sqrt(best.distance2), best.place);
    if (std::sqrt(std::min(middle.distance2, middle.ground2)) + reach.radius_m <= accepted_m() ||
        reach.radius_m < smallest_radius_m || depth > most_cuts_deep)
        return end(best, middle, reach.radius_m);
    const bool is_by_ground = below.distance2 < best.distance2;
    Polygon inside, outside;
    cut(polygon,
        where_to_cut(polygon, is_by_ground ? ground_->triangle(below.place) : set_.triangle(best.place),
                     is_by_ground ? below.worst : best.worst, reach, depth),
        best.place, inside, outside);
    const int one = inside.count >= 3 ? cover(inside, depth + 1, triangle) : none;
    const int other = outside.count >= 3 ? cover(outside, depth + 1, triangle) : none;
    if (one == none || one == other) return other;
    if (other == none) return one;
    if (one != in_parts) take(inside, triangle, one);
    if (other != in_parts) take(outside, triangle, other);
    return in_parts;
}

// The user of a polygon that is not cut any more: of what bounds it best.
int DistanceCover::end(const Best& best, const Corner& middle, double radius_m) {
    const double by_corners_m = std::sqrt(best.distance2), as_ball_m = std::sqrt(middle.distance2) + radius_m,
                 on_ground_m = std::sqrt(middle.ground2) + radius_m;
    if (on_ground_m < std::min(by_corners_m, as_ball_m)) return accept_on_ground(on_ground_m);
    return by_corners_m < as_ball_m ? accept(by_corners_m, best.place) : accept(as_ball_m, middle.place);
}

void DistanceCover::take(const Polygon& polygon, std::uint32_t triangle, int user) {
    Taken taken;
    taken.user = user;
    taken.part.count = static_cast<std::uint32_t>(polygon.count);
    taken.part.triangle = triangle;
    taken.part.has_marked = polygon.has_marked;
    for (std::size_t i = 0; i < polygon.count; ++i) taken.part.corners[i] = polygon.corners[i].at;
    taken_.push_back(taken);
}

DistanceCover::Best DistanceCover::best_on_ground(const Polygon& polygon) const {
    constexpr double endless = std::numeric_limits<double>::infinity();
    const double accepted2 = accepted_m() * accepted_m();
    Best best{endless, 0, 0};
    for (std::size_t i = 0; i < polygon.count && best.distance2 > accepted2; ++i) {
        const NearestTriangles::Near near =
            ground_->within(polygon.corners[i].at, 0.0, accepted2, NearestTriangles::nothing);
        if (near.place == NearestTriangles::nothing) return {endless, 0, 0};
        Best one{near.distance2, near.place, i};
        for (std::size_t k = 0; k < polygon.count && one.distance2 < best.distance2; ++k) {
            const double d2 = ground_->distance2(near.place, polygon.corners[k].at);
            if (d2 > one.distance2) one.distance2 = d2, one.worst = k;
        }
        if (one.distance2 < best.distance2) best = one;
    }
    return best;
}

int DistanceCover::accept_on_ground(double bound_m) {
    bound_m_ = std::max(bound_m_, bound_m);
    return on_ground;
}

int DistanceCover::cover(const OriginalPart& part) {
    Polygon polygon;
    polygon.count = part.count, polygon.has_marked = part.has_marked;
    for (std::size_t i = 0; i < part.count; ++i) polygon.corners[i].at = part.corners[i];
    if (ground_ != nullptr) {
        const Best below = best_on_ground(polygon);
        if (below.distance2 <= accepted_m() * accepted_m())
            return accept_on_ground(std::sqrt(below.distance2));
    }
    for (std::size_t i = 0; i < part.count; ++i) {
        polygon.corners[i] = corner(part.corners[i], hint_);
        hint_ = polygon.corners[i].place;
    }
    return cover(polygon, 0, part.triangle);
}

int DistanceCover::cover_ball(const glm::dvec3& middle, double radius_m) {
    const double rest = accepted_m() - radius_m;
    if (rest <= 0.0) return none;
    if (ground_ != nullptr) {
        const NearestTriangles::Near below =
            ground_->within(middle, rest * rest, rest * rest, NearestTriangles::nothing);
        if (below.place == NearestTriangles::nothing) return none;
        bound_m_ = std::max(bound_m_, std::sqrt(below.distance2) + radius_m);
        return on_ground;
    }
    const NearestTriangles::Near near = set_.within(middle, rest * rest, rest * rest, hint_);
    if (near.place == NearestTriangles::nothing) return none;
    return accept(std::sqrt(near.distance2) + radius_m, near.place);
}

}  // namespace oro
