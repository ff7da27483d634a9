#include "core/net/lattice_georeference.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "core/net/chebyshev.h"

namespace oro {
namespace {

constexpr double smallest_radius_m = wgs84_b_m * wgs84_b_m / wgs84_a_m;  // of curvature, on the ellipsoid

// The largest length of frames that were sampled in rows of `columns`: between two samples it is larger than
// at both by no more than they differ.
double largest_length_m(std::span<const LatticeGeoreference::LatticeFrame> frames, std::size_t columns,
                        double LatticeGeoreference::LatticeFrame::*length_m) {
    double most_m = 0.0, change_m = 0.0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const double one_m = frames[i].*length_m;
        most_m = std::max(most_m, one_m);
        for (const std::size_t before : {std::size_t{1}, columns})
            if (i >= before) change_m = std::max(change_m, std::abs(one_m - frames[i - before].*length_m));
    }
    return most_m + std::min(change_m, 0.02 * most_m);
}

}  // namespace

glm::dvec3 normal_of_place(const PostPlace& place) {
    const SineCosine lat = sine_cosine_deg(place.lat_deg), lon = sine_cosine_deg(place.lon_deg);
    return {lat.cosine * lon.cosine, lat.cosine * lon.sine, lat.sine};
}

PostPlace place_of_normal(const glm::dvec3& normal) {
    return {deg_from_radians(Radians(std::atan2(normal.z, std::hypot(normal.x, normal.y)))),
            deg_from_radians(Radians(std::atan2(normal.y, normal.x)))};
}

int LatticeGeoreference::Cut::patch_of(double number) const {
    const double patch = (number + first) / patch_posts;
    if (!(patch > 0.0)) return 0;  // nor is what is no number
    return static_cast<int>(std::min(patch, patches - 1.0));
}

LatticeGeoreference::Jet LatticeGeoreference::jet_at(double row, double column) const {
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
    if (of.correction != Patch::none) correct(of, {held_row, held_column}, i, j, jet);
    jet.normal += (row - held_row) * jet.by_row + (column - held_column) * jet.by_column;
    return jet;
}

glm::dvec3 LatticeGeoreference::normal_at(double row, double column) const {
    return glm::normalize(jet_at(row, column).normal);
}

void LatticeGeoreference::normals_of_row(int row, int first_column, std::span<glm::dvec3> normals) const {
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
        if (patch(i, j).correction != Patch::none)
            sum += correction_at(patch(i, j), down_.post_of_patch(row, i), across_.post_of_patch(column, j));
        normals[k] = glm::normalize(sum);
    }
}

PostPlace LatticeGeoreference::place_at(double row, double column) const {
    return place_of_normal(normal_at(row, column));
}

// A step of Newton's method in the plane of the map's own derivatives.
PostNumber LatticeGeoreference::step_towards(const glm::dvec3& wanted, const Jet& jet) {
    const glm::dvec3 off = wanted - glm::normalize(jet.normal);
    const double rr = glm::dot(jet.by_row, jet.by_row), cc = glm::dot(jet.by_column, jet.by_column),
                 rc = glm::dot(jet.by_row, jet.by_column);
    const double r = glm::dot(off, jet.by_row), c = glm::dot(off, jet.by_column);
    const double determinant = rr * cc - rc * rc;
    return {(r * cc - c * rc) / determinant, (c * rr - r * rc) / determinant};
}

PostNumber LatticeGeoreference::post_at(double lat_deg, double lon_deg) const {
    const glm::dvec3 wanted = normal_of_place({lat_deg, lon_deg});
    constexpr double far = 1.0e9;
    if (!(glm::dot(wanted, middle_) > 0.0)) return {far, far};
    PostNumber post = inverse_.post(wanted);
    Jet jet = jet_at(post.row, post.column);
    constexpr int most_steps = 30;
    for (int step = 0; step < most_steps; ++step) {
        const auto [down, right] = step_towards(wanted, jet);
        post.row += down;
        post.column += right;
        if (std::abs(down) + std::abs(right) < 1.0e-7) break;  // the next step would be its square
        jet = jet_at(post.row, post.column);
    }
    return corrections_.empty() ? post : across_rims(post, wanted);
}

LatticeGeoreference::LatticeFrame LatticeGeoreference::local_frame_at(double row, double column) const {
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
Result<void> LatticeGeoreference::measure() {
    constexpr int side = 48;
    const double row_step = down_.last() / side, column_step = across_.last() / side;
    // Over a few posts a kink turns no less, and bends no more than it does over these.
    constexpr double few_posts = 8.0;
    const auto looks = [&](double step, double last) {
        return corrections_.empty() ? step : std::min(std::max(step, few_posts), last);
    };
    const double row_look = looks(row_step, down_.last()), column_look = looks(column_step, across_.last());
    double bend = 1.0, turn = 0.0;
    std::vector<LatticeFrame> frames;
    for (int i = 0; i <= side; ++i) {
        for (int j = 0; j <= side; ++j) {
            const double row = i * row_step, column = j * column_step;
            const Jet jet = jet_at(row, column);
            const double facing = glm::dot(glm::cross(jet.by_column, -jet.by_row), jet.normal);
            const double down = glm::length(jet.by_row), right = glm::length(jet.by_column);
            if (!(facing > 0.1 * down * right))
                return Error{ErrorKind::failed, "grid of posts",
                             "its rows and columns are mirrored or have a fold"};
            const Jet below = jet_at(std::min(row + row_look, down_.last()), column);
            const Jet east = jet_at(row, std::min(column + column_look, across_.last()));
            const auto within = [](double from, double look, double last) {
                return from + look <= last + 1.0e-6 * look ? look : 0.0;
            };
            const double row_way = within(row, row_look, down_.last()),
                         column_way = within(column, column_look, across_.last());
            const auto bent = [&](const glm::dvec3& change, double step, double one, double other) {
                const double angle = step * std::max(one, other);
                const double found = step > 0.0 ? glm::length(change) / (step * one * other) : 0.0;
                bend = std::max(bend, found);
                turn = std::max(turn, (found - 1.0) * angle);
            };
            bent(below.by_row - jet.by_row, row_way, down, down);
            bent(east.by_column - jet.by_column, column_way, right, right);
            bent(below.by_column - jet.by_column, row_way, down, right);
            frames.push_back(local_frame_at(row, column));
        }
    }
    row_m_ = largest_length_m(frames, side + 1, &LatticeFrame::row_m);
    column_m_ = largest_length_m(frames, side + 1, &LatticeFrame::column_m);
    bend_ = 1.1 * bend * wgs84_a_m / smallest_radius_m;
    // Between two samples ways may turn one way and back: twice what they differ by.
    if (!corrections_.empty()) kink_ = 2.0 * turn;
    middle_ = normal_at(0.5 * down_.last(), 0.5 * across_.last());
    ORO_CHECK(fit_inverse());
    find_box();
    return {};
}

void LatticeGeoreference::find_box() {
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
