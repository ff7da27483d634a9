#include "core/net/grid_net.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace oro {
namespace {

constexpr int fewest_posts = 16;  // of a patch's side: what needs smaller ones is not smooth
constexpr double smallest_radius_m = wgs84_b_m * wgs84_b_m / wgs84_a_m;  // of curvature, on the ellipsoid

glm::dvec3 unit_normal(const PostPlace& place) {
    const SineCosine lat = sine_cosine_deg(place.lat_deg), lon = sine_cosine_deg(place.lon_deg);
    return {lat.cosine * lon.cosine, lat.cosine * lon.sine, lat.sine};
}

// Chebyshev polynomials at x in -1 .. 1, and their derivatives.
template <class Terms>
void chebyshev(double x, Terms& value) {
    value[0] = 1.0;
    value[1] = x;
    for (std::size_t i = 2; i < value.size(); ++i) value[i] = 2.0 * x * value[i - 1] - value[i - 2];
}
template <class Terms>
void chebyshev(double x, Terms& value, Terms& slope) {
    chebyshev(x, value);
    slope[0] = 0.0;
    slope[1] = 1.0;
    for (std::size_t i = 2; i < value.size(); ++i)
        slope[i] = 2.0 * value[i - 1] + 2.0 * x * slope[i - 1] - slope[i - 2];
}

// Roots of the polynomial of that number: where a function is asked for that the ones below it are to follow.
double root(int i, int count) {
    return -std::cos(std::numbers::pi * (i + 0.5) / count);
}

}  // namespace

PostPlace place_of_normal(const glm::dvec3& normal) {
    return {deg_from_radians(Radians(std::atan2(normal.z, std::hypot(normal.x, normal.y)))),
            deg_from_radians(Radians(std::atan2(normal.y, normal.x)))};
}

GridNet::Cut GridNet::cut(int posts, int patches) {
    const int patch_posts = std::max(fewest_posts, (posts + patches - 1) / patches);
    return {{0, posts, patch_posts, (posts + patch_posts - 1) / patch_posts}};
}

GridNet::GridNet(const Cut& down, const Cut& across)
    : down_(down),
      across_(across),
      patches_(static_cast<std::size_t>(down_.patches) * static_cast<std::size_t>(across_.patches)) {}

Result<std::shared_ptr<const GridNet>> GridNet::fit(int rows, int columns, const ExactPlaces& exact) {
    assert(rows >= 2 && columns >= 2);
    for (int patches = 1; patches == 1 || patches * fewest_posts <= std::max(rows, columns); patches *= 2) {
        std::shared_ptr<GridNet> net(new GridNet(cut(rows, patches), cut(columns, patches)));
        ORO_TRY(const bool holds, net->fit_patches(exact));
        if (!holds) continue;
        ORO_CHECK(net->measure());
        return std::shared_ptr<const GridNet>(std::move(net));
    }
    return Error{ErrorKind::failed, "grid of posts",
                 "its places on the Earth do not follow smoothly from row and column"};
}

// True when all patches hold what was promised.
Result<bool> GridNet::fit_patches(const ExactPlaces& exact) {
    for (int row = 0; row < down_.patches; ++row) {
        for (int column = 0; column < across_.patches; ++column) {
            ORO_CHECK(fit_patch(exact, row, column));
            ORO_TRY(const double error_m, patch_error_m(exact, row, column));
            error_m_ = std::max(error_m_, error_m);
            if (!(error_m <= largest_error_m)) return false;
        }
    }
    return true;
}

// Discrete orthogonality gives the coefficients. Source: W. H. Press et al., Numerical Recipes, 3rd ed. 2007,
// eq. 5.8.7.
Result<void> GridNet::fit_patch(const ExactPlaces& exact, int row, int column) {
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
        const glm::dvec3 normal = unit_normal(places[i]);
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
Result<double> GridNet::patch_error_m(const ExactPlaces& exact, int row, int column) const {
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
    Terms down, right;
    for (std::size_t i = 0; i < posts.size(); ++i) {
        chebyshev(down_.in_patch(posts[i].row, row), down);
        chebyshev(across_.in_patch(posts[i].column, column), right);
        glm::dvec3 sum(0.0);
        for (std::size_t j = 0; j < terms * terms; ++j)
            sum += down[j / terms] * right[j % terms] * patch(row, column).coefficients[j];
        const double off_m = wgs84_a_m * glm::distance(glm::normalize(sum), unit_normal(places[i]));
        most_m = off_m <= most_m ? most_m : off_m;  // and what is no number
    }
    return most_m;
}

int GridNet::Cut::patch_of(double number) const {
    const double patch = (number + first) / patch_posts;
    if (!(patch > 0.0)) return 0;  // nor is what is no number
    return static_cast<int>(std::min(patch, patches - 1.0));
}

GridNet::Jet GridNet::jet_at(double row, double column) const {
    const double held_row = std::clamp(row, 0.0, down_.last()),
                 held_column = std::clamp(column, 0.0, across_.last());
    const int i = down_.patch_of(held_row), j = across_.patch_of(held_column);
    Terms down, down_slope, right, right_slope;
    chebyshev(down_.in_patch(held_row, i), down, down_slope);
    chebyshev(across_.in_patch(held_column, j), right, right_slope);
    const Patch& of = patch(i, j);
    Jet jet{glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)};
    for (std::size_t k = 0; k < terms; ++k) {
        glm::dvec3 sum(0.0), slope(0.0);
        for (std::size_t l = 0; l < terms; ++l) {
            sum += right[l] * of.coefficients[k * terms + l];
            slope += right_slope[l] * of.coefficients[k * terms + l];
        }
        jet.normal += down[k] * sum;
        jet.by_row += down_slope[k] * sum;
        jet.by_column += down[k] * slope;
    }
    jet.by_row *= 2.0 / down_.patch_posts;
    jet.by_column *= 2.0 / across_.patch_posts;
    jet.normal += (row - held_row) * jet.by_row + (column - held_column) * jet.by_column;
    return jet;
}

glm::dvec3 GridNet::normal_at(double row, double column) const {
    return glm::normalize(jet_at(row, column).normal);
}

void GridNet::normals_of_row(int row, int first_column, std::span<glm::dvec3> normals) const {
    const int i = down_.patch_of(row);
    Terms down, right;
    chebyshev(down_.in_patch(row, i), down);
    std::array<glm::dvec3, terms> of_row;
    int of_patch = -1;
    for (std::size_t k = 0; k < normals.size(); ++k) {
        const int column = first_column + static_cast<int>(k);
        if (row < 0 || row >= rows() || column < 0 || column >= columns()) {
            normals[k] = normal_at(row, column);
            continue;
        }
        const int j = across_.patch_of(column);
        if (j != of_patch) {
            of_patch = j;
            of_row.fill(glm::dvec3(0.0));
            for (std::size_t l = 0; l < terms * terms; ++l)
                of_row[l % terms] += down[l / terms] * patch(i, j).coefficients[l];
        }
        chebyshev(across_.in_patch(column, j), right);
        glm::dvec3 sum(0.0);
        for (std::size_t l = 0; l < terms; ++l) sum += right[l] * of_row[l];
        normals[k] = glm::normalize(sum);
    }
}

PostPlace GridNet::place_at(double row, double column) const {
    return place_of_normal(normal_at(row, column));
}

// Newton's method in the plane of the map's own derivatives.
PostNumber GridNet::post_at(double lat_deg, double lon_deg) const {
    const glm::dvec3 wanted = unit_normal({lat_deg, lon_deg});
    constexpr double far = 1.0e9;
    if (!(glm::dot(wanted, middle_) > 0.0)) return {far, far};
    PostNumber post = inverse_.post(wanted);
    Jet jet = jet_at(post.row, post.column);
    constexpr int most_steps = 30;
    for (int step = 0; step < most_steps; ++step) {
        const glm::dvec3 off = wanted - glm::normalize(jet.normal);
        const double rr = glm::dot(jet.by_row, jet.by_row), cc = glm::dot(jet.by_column, jet.by_column),
                     rc = glm::dot(jet.by_row, jet.by_column);
        const double r = glm::dot(off, jet.by_row), c = glm::dot(off, jet.by_column);
        const double determinant = rr * cc - rc * rc;
        const double down = (r * cc - c * rc) / determinant, right = (c * rr - r * rc) / determinant;
        post.row += down;
        post.column += right;
        if (std::abs(down) + std::abs(right) < 1.0e-7) break;  // the next step would be its square
        jet = jet_at(post.row, post.column);
    }
    return post;
}

GridNet::Lie GridNet::lie_at(double row, double column) const {
    const Jet jet = jet_at(row, column);
    const glm::dvec3 up = glm::normalize(jet.normal);
    const PostPlace place = place_of_normal(up);
    const glm::dmat3 enu = ecef_from_enu(place.lat_deg, place.lon_deg);
    const double across_m = prime_vertical_radius_m(place.lat_deg),
                 along_m = meridian_radius_m(place.lat_deg);
    // A turn of the normal is so many metres eastwards and northwards.
    const auto on_ground_m = [&](const glm::dvec3& by) {
        return glm::dvec2(across_m * glm::dot(by, enu[0]), along_m * glm::dot(by, enu[1]));
    };
    const glm::dvec2 down = on_ground_m(jet.by_row), right = on_ground_m(jet.by_column);
    return {glm::length(down), glm::length(right), std::atan2(right.y, right.x)};
}

// Bounds over the grid, from places so close together that a smooth map has nothing between them.
Result<void> GridNet::measure() {
    constexpr int side = 48;
    const double row_step = down_.last() / side, column_step = across_.last() / side;
    double bend = 1.0;
    std::vector<Lie> lies;
    for (int i = 0; i <= side; ++i) {
        for (int j = 0; j <= side; ++j) {
            const double row = i * row_step, column = j * column_step;
            const Jet jet = jet_at(row, column);
            const double facing = glm::dot(glm::cross(jet.by_column, -jet.by_row), jet.normal);
            const double down = glm::length(jet.by_row), right = glm::length(jet.by_column);
            if (!(facing > 0.1 * down * right))
                return Error{ErrorKind::failed, "grid of posts",
                             "its rows and columns are mirrored or have a fold"};
            const Jet below = jet_at(std::min(row + row_step, down_.last()), column);
            const Jet beside = jet_at(row, std::min(column + column_step, across_.last()));
            const auto bent = [&](const glm::dvec3& change, double step, double one, double other) {
                return step > 0.0 ? glm::length(change) / (step * one * other) : 0.0;
            };
            bend =
                std::max({bend, bent(below.by_row - jet.by_row, i < side ? row_step : 0.0, down, down),
                          bent(beside.by_column - jet.by_column, j < side ? column_step : 0.0, right, right),
                          bent(below.by_column - jet.by_column, i < side ? row_step : 0.0, down, right)});
            lies.push_back(lie_at(row, column));
        }
    }
    // Between two samples it is larger than at both by no more than they differ.
    const auto largest = [&](double Lie::*length_m) {
        double most_m = 0.0, change_m = 0.0;
        for (std::size_t i = 0; i < lies.size(); ++i) {
            most_m = std::max(most_m, lies[i].*length_m);
            for (const std::size_t before : {std::size_t{1}, std::size_t{side + 1}})
                if (i >= before)
                    change_m = std::max(change_m, std::abs(lies[i].*length_m - lies[i - before].*length_m));
        }
        return most_m + std::min(change_m, 0.02 * most_m);
    };
    row_m_ = largest(&Lie::row_m);
    column_m_ = largest(&Lie::column_m);
    bend_ = 1.1 * bend * wgs84_a_m / smallest_radius_m;
    middle_ = normal_at(0.5 * down_.last(), 0.5 * across_.last());
    ORO_CHECK(fit_inverse());
    find_box();
    return {};
}

void GridNet::find_box() {
    const double middle_deg = place_of_normal(middle_).lon_deg;
    double south = 90.0, north = -90.0, west = 360.0, east = -360.0;
    const auto take = [&](double row, double column) {
        const PostPlace place = place_at(row, column);
        const double from_middle = std::remainder(place.lon_deg - middle_deg, 360.0);
        south = std::min(south, place.lat_deg);
        north = std::max(north, place.lat_deg);
        west = std::min(west, from_middle);
        east = std::max(east, from_middle);
    };
    constexpr int steps = 4096;
    for (int i = 0; i <= steps; ++i) {
        const double row = down_.last() * i / steps, column = across_.last() * i / steps;
        take(0.0, column);
        take(down_.last(), column);
        take(row, 0.0);
        take(row, across_.last());
    }
    for (const double pole_deg : {-90.0, 90.0}) {
        const PostNumber pole = post_at(pole_deg, 0.0);
        if (!(pole.row >= 0.0 && pole.row <= down_.last() && pole.column >= 0.0 &&
              pole.column <= across_.last()))
            continue;
        (pole_deg > 0.0 ? north : south) = pole_deg;
        west = -180.0;
        east = 180.0;
    }
    box_ = {middle_deg + west, south, middle_deg + east, north};
    if (box_.west_deg < -180.0) {
        box_.west_deg += 360.0;
        box_.east_deg += 360.0;
    }
}

}  // namespace oro
