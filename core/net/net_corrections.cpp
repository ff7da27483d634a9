// Corrections of what a net's polynomials cannot follow, and whether its patches meet with them.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "core/base/parallel.h"
#include "core/net/chebyshev.h"
#include "core/net/lattice_georeference.h"

namespace oro {

void LatticeGeoreference::add_correction(Correction correction) {
    patches_[static_cast<std::size_t>(correction.patch)].correction =
        static_cast<std::int32_t>(corrections_.size());
    corrections_.push_back(std::move(correction));
}

// Places and derivatives: bilinear between the posts around.
void LatticeGeoreference::correct(const Patch& of, const PostNumber& at, int row, int column,
                                  Jet& jet) const {
    const double down = at.row + down_.first - static_cast<double>(row) * down_.patch_posts,
                 right = at.column + across_.first - static_cast<double>(column) * across_.patch_posts;
    const auto cell = [](double post, int posts) {
        return post > 0.0 ? static_cast<int>(std::min(post, posts - 1.0)) : 0;  // nor is what is no number
    };
    const int i = cell(down, down_.patch_posts), j = cell(right, across_.patch_posts);
    const glm::dvec3 north_west = correction_at(of, i, j), south_west = correction_at(of, i + 1, j);
    const glm::dvec3 along_north = correction_at(of, i, j + 1) - north_west,
                     along_south = correction_at(of, i + 1, j + 1) - south_west;
    const glm::dvec3 north = north_west + (right - j) * along_north,
                     south = south_west + (right - j) * along_south;
    jet.normal += north + (down - i) * (south - north);
    jet.by_row += south - north;
    jet.by_column += along_north + (down - i) * (along_south - along_north);
}

// Patches meet to some micrometres, not to the last bit. What was found beside a rim is looked for from the
// rim on, too, in the patch that begins there: a post belongs to that one.
PostNumber LatticeGeoreference::across_rims(const PostNumber& post, const glm::dvec3& wanted) const {
    constexpr double near = 1.0e-3, same = 1.0e-9;
    const auto is_near_rim = [](double number, double whole, const Cut& axis) {
        return std::abs(number - whole) < near && whole >= 0.0 && whole <= axis.last() &&
               std::fmod(whole + axis.first, axis.patch_posts) == 0.0;
    };
    const PostNumber whole{std::round(post.row), std::round(post.column)};
    const bool row_rim = is_near_rim(post.row, whole.row, down_),
               column_rim = is_near_rim(post.column, whole.column, across_);
    const std::array<std::array<bool, 2>, 3> ways{{{true, true}, {true, false}, {false, true}}};
    for (const auto& [by_row, by_column] : ways) {
        if ((by_row && !row_rim) || (by_column && !column_rim)) continue;
        const PostNumber on{by_row ? whole.row : post.row, by_column ? whole.column : post.column};
        const PostNumber step = step_towards(wanted, jet_at(on.row, on.column));
        if ((by_row && !(step.row > -same)) || (by_column && !(step.column > -same))) continue;
        return {on.row + step.row, on.column + step.column};
    }
    return post;
}

// Corrects what does not hold. False where a correction would be none.
Result<bool> LatticeGeoreference::fit_corrected(const ExactPlaces& exact) {
    const int count = down_.patches * across_.patches;
    std::vector<Result<Corrected>> made(static_cast<std::size_t>(count), Corrected{});
    std::atomic<bool> failed{false};
    in_parallel(count, thread_count(), [&](int number) {
        if (failed) return;
        auto& patch = made[static_cast<std::size_t>(number)];
        patch = make_corrected(exact, number / across_.patches, number % across_.patches);
        if (!patch.ok() || !patch->holds) failed = true;
    });
    for (int number = 0; number < count; ++number) {
        auto& patch = made[static_cast<std::size_t>(number)];
        if (!patch.ok()) return patch.error();
        if (!patch->holds) return false;
        error_m_ = std::max(error_m_, patch->error_m);
        if (!patch->correction) continue;
        add_correction(std::move(*patch->correction));
        if (!is_gentle(number / across_.patches, number % across_.patches)) return false;
    }
    return patches_are_whole();
}

Result<LatticeGeoreference::Corrected> LatticeGeoreference::make_corrected(const ExactPlaces& exact, int row,
                                                                           int column) {
    ORO_CHECK(fit_patch(exact, row, column));
    ORO_TRY(const double error_m, patch_error_m(exact, row, column));
    // A kink may lie between the places that were looked at.
    if (error_m <= 0.5 * largest_error_m) return Corrected{error_m, true, std::nullopt};
    return correction_of(exact, row, column);
}

Result<LatticeGeoreference::Corrected> LatticeGeoreference::correction_of(const ExactPlaces& exact, int row,
                                                                          int column) const {
    const int last_row = down_.last_of_patch(row), last_column = across_.last_of_patch(column);
    const int first_row = row * down_.patch_posts - down_.first,
              first_column = column * across_.patch_posts - across_.first;
    std::vector<PostNumber> posts;
    for (int i = 0; i <= last_row; ++i)
        for (int j = 0; j <= last_column; ++j)
            posts.push_back({static_cast<double>(first_row + i), static_cast<double>(first_column + j)});
    std::vector<PostPlace> places(posts.size());
    ORO_CHECK(exact(posts, places));
    const auto columns = static_cast<std::size_t>(across_.patch_posts) + 1;
    Correction correction{row * across_.patches + column, {}};
    correction.posts.resize((static_cast<std::size_t>(down_.patch_posts) + 1) * columns);
    double without_m = 0.0, with_m = 0.0;
    const auto off_m = [](const glm::dvec3& sum, const glm::dvec3& normal) {
        return wgs84_a_m * glm::distance(glm::normalize(sum), normal);
    };
    for (std::size_t n = 0; n < posts.size(); ++n) {
        const auto width = static_cast<std::size_t>(last_column) + 1;
        const glm::dvec3 normal = normal_of_place(places[n]);
        const glm::dvec3 sum = in_patch(row, column, down_.in_patch(posts[n].row, row),
                                        across_.in_patch(posts[n].column, column));
        const glm::dvec3 steps = glm::round((normal - sum) / correction_step);
        constexpr double most = largest_correction_m / wgs84_a_m / correction_step;
        auto& post = correction.posts[n / width * columns + n % width];
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::abs(steps[axis]) <= most)) return Corrected{0.0, false, std::nullopt};
            post[static_cast<std::size_t>(axis)] = static_cast<std::int16_t>(steps[axis]);
        }
        without_m = std::max(without_m, off_m(sum, normal));
        with_m = std::max(with_m, off_m(sum + correction_step * steps, normal));
    }
    if (without_m <= largest_error_m) return Corrected{without_m, true, std::nullopt};
    return Corrected{with_m, true, std::move(correction)};
}

// A fold would be steeper.
bool LatticeGeoreference::is_gentle(int row, int column) const {
    const Patch& of = patch(row, column);
    const auto most_steps = [&](const glm::dvec3& one, const glm::dvec3& other, const Cut& axis) {
        return steepest_correction * glm::distance(one, other) / axis.patch_posts;
    };
    // Of the polynomials alone.
    const double down = most_steps(polynomial_at(of, -1.0, 0.0), polynomial_at(of, 1.0, 0.0), down_),
                 right = most_steps(polynomial_at(of, 0.0, -1.0), polynomial_at(of, 0.0, 1.0), across_);
    const int last_row = down_.last_of_patch(row), last_column = across_.last_of_patch(column);
    for (int i = 0; i <= last_row; ++i) {
        for (int j = 0; j <= last_column; ++j) {
            const glm::dvec3 here = correction_at(of, i, j);
            if (i < last_row && !(glm::distance(correction_at(of, i + 1, j), here) <= down)) return false;
            if (j < last_column && !(glm::distance(correction_at(of, i, j + 1), here) <= right)) return false;
        }
    }
    return true;
}

Result<void> LatticeGeoreference::take_corrections(const std::vector<Correction>& corrections) {
    const auto wrong = [](const std::string& what) {
        return Error{ErrorKind::failed, "grid of posts", what};
    };
    const std::size_t posts = (static_cast<std::size_t>(down_.patch_posts) + 1) *
                              (static_cast<std::size_t>(across_.patch_posts) + 1);
    int before = -1;
    for (const Correction& correction : corrections) {
        const std::string which = "the correction of patch " + std::to_string(correction.patch);
        if (correction.patch < 0 || static_cast<std::size_t>(correction.patch) >= patches_.size())
            return wrong(which + ", of " + std::to_string(patches_.size()) + " patches");
        if (correction.patch <= before)
            return wrong(which + " comes after that of " + std::to_string(before));
        before = correction.patch;
        if (correction.posts.size() != posts)
            return wrong(which + " has " + std::to_string(correction.posts.size()) + " posts, expected " +
                         std::to_string(posts));
        add_correction(correction);
        constexpr double most = largest_correction_m / wgs84_a_m / correction_step;
        for (const auto& post : correction.posts)
            for (const std::int16_t steps : post)
                if (std::abs(static_cast<double>(steps)) > most)
                    return wrong(which + " moves a post by more than 95 mm");
        if (!is_gentle(correction.patch / across_.patches, correction.patch % across_.patches))
            return wrong(which + " jumps from one post to the next");
    }
    return {};
}

glm::dvec3 LatticeGeoreference::polynomial_at(const Patch& of, double down, double right) {
    Terms by_row, by_column;
    chebyshev(down, by_row);
    chebyshev(right, by_column);
    glm::dvec3 sum(0.0);
    for (std::size_t j = 0; j < coefficients_a_patch; ++j)
        sum += by_row[j / terms] * by_column[j % terms] * of.coefficients[j];
    return sum;
}

// A patch at -1 .. 1 each way.
glm::dvec3 LatticeGeoreference::in_patch(int row, int column, double down, double right) const {
    const Patch& of = patch(row, column);
    Jet jet{polynomial_at(of, down, right), glm::dvec3(0.0), glm::dvec3(0.0)};
    if (of.correction != Patch::none)
        correct(of, {down_.number(row, down), across_.number(column, right)}, row, column, jet);
    return jet.normal;
}

// Looks at as many places of each patch as it has coefficients, its corners among them; not beyond the grid,
// where nothing is asked for.
bool LatticeGeoreference::patches_are_whole() const {
    constexpr double length_slack = 1.0e-6;
    const auto at = [](const Cut& axis, int patch, int i) {
        return std::min(-std::cos(std::numbers::pi * i / (terms - 1)), axis.in_patch(axis.last(), patch));
    };
    for (int row = 0; row < down_.patches; ++row) {
        for (int column = 0; column < across_.patches; ++column) {
            for (int i = 0; i < terms * terms; ++i) {
                const glm::dvec3 normal =
                    in_patch(row, column, at(down_, row, i / terms), at(across_, column, i % terms));
                if (!(std::abs(glm::length(normal) - 1.0) <= length_slack)) return false;
            }
            if (!rims_meet(row, column)) return false;
        }
    }
    return true;
}

// With the patches below and beside; at each post where one of them is corrected.
bool LatticeGeoreference::rims_meet(int row, int column) const {
    constexpr double apart = 1.0e-10;  // 0.6 mm; those of a fit without corrections are within 1e-11
    const bool below = row + 1 < down_.patches, right = column + 1 < across_.patches;
    const auto meet = [&](double along, bool down) {
        const glm::dvec3 here = down ? in_patch(row, column, 1.0, along) : in_patch(row, column, along, 1.0);
        const glm::dvec3 there =
            down ? in_patch(row + 1, column, -1.0, along) : in_patch(row, column + 1, along, -1.0);
        return glm::distance(here, there) <= apart;
    };
    const auto rim_meets = [&](bool down) {
        const Cut& axis = down ? across_ : down_;
        const int patch_number = down ? column : row;
        const Patch& other = down ? patch(row + 1, column) : patch(row, column + 1);
        for (int i = 0; i < terms; ++i) {
            const double along = std::min(-std::cos(std::numbers::pi * i / (terms - 1)),
                                          axis.in_patch(axis.last(), patch_number));
            if (!meet(along, down)) return false;
        }
        if (patch(row, column).correction == Patch::none && other.correction == Patch::none) return true;
        for (int post = 0; post <= axis.last_of_patch(patch_number); ++post)
            if (!meet(2.0 * post / axis.patch_posts - 1.0, down)) return false;
        return true;
    };
    return (!below || rim_meets(true)) && (!right || rim_meets(false));
}

}  // namespace oro
