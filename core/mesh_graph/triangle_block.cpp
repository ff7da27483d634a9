#include "core/mesh_graph/triangle_block.h"

#include <algorithm>
#include <cmath>

namespace oro {
namespace {

void put(FourVectors& into, int lane, const glm::dvec3& vector) {
    into.x[lane] = vector.x, into.y[lane] = vector.y, into.z[lane] = vector.z;
}
glm::dvec3 taken(const FourVectors& from, int lane) {
    return {from.x[lane], from.y[lane], from.z[lane]};
}
double one_over(double value) {
    return value > 0.0 ? 1.0 / value : 0.0;
}
double to_one_side(const glm::dvec3& from, const glm::dvec3& side, double by_length2) {
    const double t = std::min(std::max(glm::dot(from, side) * by_length2, 0.0), 1.0);
    const glm::dvec3 rest{from.x - t * side.x, from.y - t * side.y, from.z - t * side.z};
    return glm::dot(rest, rest);
}

}  // namespace

TriangleBlock::TriangleBlock(const std::array<glm::dvec3, 3>* triangles, int count) {
    for (int lane = 0; lane < 4; ++lane) {
        const std::array<glm::dvec3, 3>& one = triangles[std::min(lane, count - 1)];
        const glm::dvec3 u = one[1] - one[0], v = one[2] - one[0], w = v - u, n = glm::cross(u, v);
        const double uu = glm::dot(u, u), vv = glm::dot(v, v), ww = glm::dot(w, w), nn = glm::dot(n, n);
        put(a, lane, one[0]), put(ab, lane, u), put(ac, lane, v);
        by_ab[lane] = one_over(uu), by_ac[lane] = one_over(vv), by_bc[lane] = one_over(ww);
        const double longest2 = std::max({uu, vv, ww});
        const bool has_plane = nn > 1.0e-12 * longest2 * longest2;
        least_share[lane] = has_plane ? 0.0 : 2.0;
        const glm::dvec3 scaled = has_plane ? n / nn : glm::dvec3(0.0);
        put(along_ab, lane, glm::cross(v, scaled)), put(along_ac, lane, glm::cross(scaled, u));
        put(normal, lane, has_plane ? n / std::sqrt(nn) : glm::dvec3(0.0));
    }
}

double TriangleBlock::distance2(int lane, const glm::dvec3& place) const {
    const glm::dvec3 from = place - taken(a, lane), u = taken(ab, lane), v = taken(ac, lane);
    const double s = glm::dot(from, taken(along_ab, lane)), t = glm::dot(from, taken(along_ac, lane));
    if (s >= least_share[lane] && t >= least_share[lane] && s + t <= 1.0) {
        const double up = glm::dot(from, taken(normal, lane));
        return up * up;
    }
    return std::min(to_one_side(from, u, by_ab[lane]),
                    std::min(to_one_side(from, v, by_ac[lane]), to_one_side(from - u, v - u, by_bc[lane])));
}

std::array<glm::dvec3, 3> TriangleBlock::triangle(int lane) const {
    const glm::dvec3 first = taken(a, lane);
    return {first, first + taken(ab, lane), first + taken(ac, lane)};
}

}  // namespace oro
