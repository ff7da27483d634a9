// From places to posts of a net by one polynomial.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/net/lattice_georeference.h"

namespace oro {

PostNumber LatticeGeoreference::Inverse::post(const glm::dvec3& normal) const {
    const glm::dvec2 at = uv(normal), held = glm::clamp(at, -1.0, 1.0);
    glm::dvec2 sum(0.0);
    std::size_t last = terms;
    for (int i = degree; i >= 0; --i) {
        glm::dvec2 row(0.0);
        for (int j = degree - i; j >= 0; --j) row = row * held.y + coefficients[--last];
        sum = sum * held.x + row;
    }
    sum += beyond * (at - held);
    return {sum.x, sum.y};
}

namespace {

// Roots of Chebyshev's polynomials, drawn out to -1 .. 1.
double edge_root(int i, int count) {
    const double half = std::numbers::pi / count;
    return -std::cos(half * (i + 0.5)) / std::cos(0.5 * half);
}

constexpr std::size_t inverse_terms = LatticeGeoreference::Inverse::terms;
using NormalMatrix = std::array<std::array<double, inverse_terms>, inverse_terms>;

// Solves a symmetric positive definite system in place of its right sides. Source: W. H. Press et al.,
// Numerical Recipes, 3rd ed. 2007, section 2.9.
bool solve(NormalMatrix& of, std::array<glm::dvec2, inverse_terms>& right) {
    for (std::size_t i = 0; i < inverse_terms; ++i) {
        for (std::size_t j = i; j < inverse_terms; ++j) {
            double sum = of[i][j];
            for (std::size_t k = 0; k < i; ++k) sum -= of[i][k] * of[j][k];
            if (i == j && !(sum > 0.0)) return false;
            of[j][i] = i == j ? std::sqrt(sum) : sum / of[i][i];
        }
    }
    for (std::size_t i = 0; i < inverse_terms; ++i) {
        for (std::size_t k = 0; k < i; ++k) right[i] -= of[i][k] * right[k];
        right[i] /= of[i][i];
    }
    for (std::size_t i = inverse_terms; i-- > 0;) {
        for (std::size_t k = i + 1; k < inverse_terms; ++k) right[i] -= of[k][i] * right[k];
        right[i] /= of[i][i];
    }
    return true;
}

}  // namespace

// Least squares over places that lie closest together at the rim, as roots of Chebyshev's polynomials do.
Result<void> LatticeGeoreference::fit_inverse() {
    constexpr int side = 24;
    const PostPlace middle = place_of_normal(middle_);
    const glm::dmat3 enu = ecef_from_enu(middle.lat_deg, middle.lon_deg);
    inverse_.along_u = enu[0];
    inverse_.along_v = enu[1];
    std::vector<glm::dvec2> places, posts;
    glm::dvec2 low(2.0), high(-2.0);
    for (int i = 0; i < side * side; ++i) {
        const double row = 0.5 * down_.last() * (1.0 + edge_root(i / side, side));
        const double column = 0.5 * across_.last() * (1.0 + edge_root(i % side, side));
        const glm::dvec3 normal = normal_at(row, column);
        places.emplace_back(glm::dot(normal, enu[0]), glm::dot(normal, enu[1]));
        posts.emplace_back(row, column);
        low = glm::min(low, places.back());
        high = glm::max(high, places.back());
    }
    inverse_.middle = 0.5 * (low + high);
    inverse_.scale = 2.0 / (high - low);
    NormalMatrix matrix{};
    inverse_.coefficients.fill(glm::dvec2(0.0));
    for (std::size_t n = 0; n < places.size(); ++n) {
        const glm::dvec2 at = (places[n] - inverse_.middle) * inverse_.scale;
        std::array<double, inverse_terms> powers{};
        std::size_t term = 0;
        for (int i = 0; i <= Inverse::degree; ++i)
            for (int j = 0; j <= Inverse::degree - i; ++j)
                powers[term++] = std::pow(at.x, i) * std::pow(at.y, j);
        for (std::size_t i = 0; i < inverse_terms; ++i) {
            inverse_.coefficients[i] += powers[i] * posts[n];
            for (std::size_t j = i; j < inverse_terms; ++j) matrix[i][j] += powers[i] * powers[j];
        }
    }
    if (!solve(matrix, inverse_.coefficients))
        return Error{ErrorKind::failed, "grid of posts", "its rows and columns are mirrored or have a fold"};
    // u^1 is behind all terms of u^0; v^1 is the second of these.
    inverse_.beyond = glm::dmat2(inverse_.coefficients[Inverse::degree + 1], inverse_.coefficients[1]);
    for (std::size_t n = 0; n < posts.size(); ++n) {
        const PostNumber post = inverse_.post(normal_at(posts[n].x, posts[n].y));
        inverse_.error_posts = std::max(
            {inverse_.error_posts, std::abs(post.row - posts[n].x), std::abs(post.column - posts[n].y)});
    }
    return {};
}

}  // namespace oro
