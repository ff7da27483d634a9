// Nets made of exact places.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/net/chebyshev.h"
#include "core/net/lattice_georeference.h"

namespace oro {
namespace {

constexpr int fewest_posts = 16;  // of a patch's side: what needs smaller ones is not smooth

// Roots of the polynomial of that number: where a function is asked for that the ones below it are to follow.
double root(int i, int count) {
    return -std::cos(std::numbers::pi * (i + 0.5) / count);
}

}  // namespace

LatticeGeoreference::Cut LatticeGeoreference::cut(int posts, int patches) {
    const int patch_posts = std::max(fewest_posts, (posts + patches - 1) / patches);
    return {{0, posts, patch_posts, (posts + patch_posts - 1) / patch_posts}};
}

LatticeGeoreference::LatticeGeoreference(const Cut& down, const Cut& across)
    : down_(down),
      across_(across),
      patches_(static_cast<std::size_t>(down_.patches) * static_cast<std::size_t>(across_.patches)) {}

Result<std::shared_ptr<const LatticeGeoreference>> LatticeGeoreference::fit(int rows, int columns,
                                                                            const ExactPlaces& exact) {
    assert(rows >= 2 && columns >= 2);
    PatchNumber missed{0, 0};
    for (int patches = 1; patches == 1 || patches * fewest_posts <= std::max(rows, columns); patches *= 2) {
        std::shared_ptr<LatticeGeoreference> net(
            new LatticeGeoreference(cut(rows, patches), cut(columns, patches)));
        // Of the quarters of the one that missed, the first.
        const PatchNumber first{std::min(2 * missed.row, net->down_.patches - 1),
                                std::min(2 * missed.column, net->across_.patches - 1)};
        ORO_TRY(const auto now_missed, net->fit_patches(exact, first));
        if (now_missed) {
            missed = *now_missed;
            continue;
        }
        ORO_CHECK(net->measure());
        return std::shared_ptr<const LatticeGeoreference>(std::move(net));
    }
    // The larger, the fewer numbers and places they need, and the more of them are corrected.
    for (const int posts : {64, 32, 16}) {
        const auto patches = [&](int count) { return (count + posts - 1) / posts; };
        std::shared_ptr<LatticeGeoreference> net(
            new LatticeGeoreference(cut(rows, patches(rows)), cut(columns, patches(columns))));
        ORO_TRY(const bool holds, net->fit_corrected(exact));
        if (!holds) continue;
        ORO_CHECK(net->measure());
        return std::shared_ptr<const LatticeGeoreference>(std::move(net));
    }
    return Error{ErrorKind::failed, "grid of posts",
                 "its places on the Earth do not follow smoothly from row and column: they jump"};
}

// The patch that does not hold what was promised, if any; looks at one before all others, so that what does
// not hold takes little time.
Result<std::optional<LatticeGeoreference::PatchNumber>> LatticeGeoreference::fit_patches(
    const ExactPlaces& exact, PatchNumber first) {
    const int before = first.row * across_.patches + first.column;
    const int count = down_.patches * across_.patches;
    for (int i = -1; i < count; ++i) {
        if (i == before) continue;
        const int number = i < 0 ? before : i;
        const PatchNumber at{number / across_.patches, number % across_.patches};
        ORO_CHECK(fit_patch(exact, at.row, at.column));
        ORO_TRY(const double error_m, patch_error_m(exact, at.row, at.column));
        error_m_ = std::max(error_m_, error_m);
        if (!(error_m <= largest_error_m)) return std::optional<PatchNumber>(at);
    }
    return std::optional<PatchNumber>();
}

// Discrete orthogonality gives the coefficients. Source: W. H. Press et al., Numerical Recipes, 3rd ed. 2007,
// eq. 5.8.7.
Result<void> LatticeGeoreference::fit_patch(const ExactPlaces& exact, int row, int column) {
    std::array<PostNumber, terms * terms> posts;
    std::array<PostPlace, terms * terms> places;
    std::array<Terms, terms> at;  // of each root
    for (int i = 0; i < terms; ++i) chebyshev(root(i, terms), at[static_cast<std::size_t>(i)]);
    const auto number = [&](const Cut& axis, int patch, int i) {
        return (static_cast<double>(patch) + 0.5 * (root(i, terms) + 1.0)) * axis.patch_posts;
    };
    for (int i = 0; i < terms * terms; ++i)
        posts[static_cast<std::size_t>(i)] = {number(down_, row, i / terms),
                                              number(across_, column, i % terms)};
    ORO_CHECK(exact(posts, places));
    Patch& made = patches_[static_cast<std::size_t>(row * across_.patches + column)];
    std::ranges::fill(made.coefficients, glm::dvec3(0.0));
    for (std::size_t i = 0; i < terms * terms; ++i) {
        const glm::dvec3 normal = normal_of_place(places[i]);
        for (std::size_t j = 0; j < terms * terms; ++j)
            made.coefficients[j] += at[i / terms][j / terms] * at[i % terms][j % terms] * normal;
    }
    for (std::size_t j = 0; j < terms * terms; ++j) {
        const double share = (j / terms == 0 ? 1.0 : 2.0) * (j % terms == 0 ? 1.0 : 2.0);
        made.coefficients[j] *= share / (terms * terms);
    }
    return {};
}

// At places between the roots and on the patch's rim, where polynomials stray farthest.
Result<double> LatticeGeoreference::patch_error_m(const ExactPlaces& exact, int row, int column) const {
    constexpr int side = 2 * terms + 1;
    std::vector<PostNumber> posts(side * side);
    std::vector<PostPlace> places(side * side);
    const auto number = [&](const Cut& axis, int patch, int i) {
        const double first = static_cast<double>(patch) * axis.patch_posts;
        return first + std::min<double>(axis.patch_posts, axis.last() - first) * i / (side - 1);
    };
    for (int i = 0; i < side * side; ++i)
        posts[static_cast<std::size_t>(i)] = {number(down_, row, i / side),
                                              number(across_, column, i % side)};
    ORO_CHECK(exact(posts, places));
    double most_m = 0.0;
    for (std::size_t i = 0; i < posts.size(); ++i) {
        const glm::dvec3 sum = polynomial_at(patch(row, column), down_.in_patch(posts[i].row, row),
                                             across_.in_patch(posts[i].column, column));
        const double off_m = wgs84_a_m * glm::distance(glm::normalize(sum), normal_of_place(places[i]));
        most_m = off_m <= most_m ? most_m : off_m;  // and what is no number
    }
    return most_m;
}

}  // namespace oro
