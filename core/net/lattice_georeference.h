// Where the posts of a grid lie whose source has a CRS of its own (projected, turned, of another datum):
// smooth functions of row and column, and corrections where those cannot follow; held against the exact
// places when they were made.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/earth/ellipsoid.h"

namespace oro {

// A post's number, or a place between posts.
struct PostNumber {
    double row;
    double column;
};
// A place on the ellipsoid.
struct PostPlace {
    double lat_deg;
    double lon_deg;
};

// The ellipsoid's normal over a grid as polynomials in row and column, in patches. A normal is smooth
// everywhere, also at the poles and across the antimeridian, where latitude and longitude are not. A post
// belongs to one patch by its number alone, so it has the same bits in whichever page or level it is asked
// for. Beyond the grid the map goes on straight.
//
// A datum may come by a grid of shifts (BETA2007, NTF, OSTN15), linear between its nodes. No polynomial
// follows its kinks. Patches over them have a correction besides: what their posts are off, one by one, and
// bilinear between.
class LatticeGeoreference {
  public:
    // The exact places of posts; as many as are asked for, maybe by several threads at once.
    using ExactPlaces = std::function<Result<void>(std::span<const PostNumber>, std::span<PostPlace>)>;
    static constexpr double largest_error_m = 2.0e-5;

    // For rows x columns posts (2 at least of each). Places are within largest_error_m of the exact ones:
    // patches are halved until that holds at places between those that made them. Where the smallest do not
    // hold it, larger ones are taken, and those with a post that is farther off are corrected. Rows must run
    // clockwise from columns, seen from above, as south does from east. Errors: those of `exact`; a map that
    // jumps (largest_correction_m, steepest_correction), is mirrored or has a fold.
    static Result<std::shared_ptr<const LatticeGeoreference>> fit(int rows, int columns,
                                                                  const ExactPlaces& exact);

    // A part of it: the same posts, with the same bits. At least 2 of each, all within the grid. Errors: none
    // that its whole had not.
    [[nodiscard]] Result<std::shared_ptr<const LatticeGeoreference>> part(int first_row, int first_column,
                                                                          int rows, int columns) const;

    // What the polynomials of a patch are off at its posts, those with which the next patches begin among
    // them, row by row: x, y and z of the normal in whole steps (2.9 um on the Earth). 6 bytes a post.
    struct Correction {
        int patch{};  // patches are counted row by row
        std::vector<std::array<std::int16_t, 3>> posts;
    };
    static constexpr double correction_step = 0x1p-41;
    static constexpr double largest_correction_m = 0.095;  // along each axis
    // How much more one post is corrected than the next, of the way between them.
    static constexpr double steepest_correction = 1.0e-3;

    // All that it is made of, to the bit: for files.
    struct Stored {
        struct Axis {
            int first;        // post of the first patch that the grid begins with
            int posts;        // of the grid
            int patch_posts;  // of each patch
            int patches;
            // True where these are numbers that fit each other: as many patches as hold the posts.
            [[nodiscard]] bool fits() const;
        };
        Axis down{}, across{};
        double error_m{};
        std::vector<glm::dvec3> coefficients;  // patch by patch, a row of them after another
        std::vector<Correction> corrections;   // of some patches, in their order
    };
    static constexpr int coefficients_a_patch = 81;
    [[nodiscard]] Stored stored() const;
    // The inverse of stored(); any numbers may be given. Errors (of a "grid of posts"): what makes them no
    // net: counts that do not fit each other, normals that are none, patches that do not meet, a fold,
    // corrections that are none.
    static Result<std::shared_ptr<const LatticeGeoreference>> from(const Stored& stored);

    [[nodiscard]] PostPlace place_at(double row, double column) const;
    // Fractional numbers of the post at a place. Within 1e-9 of a post inside the grid; outside it, a place
    // that is outside, too (all that is a quarter of the Earth away is one).
    [[nodiscard]] PostNumber post_at(double lat_deg, double lon_deg) const;

    // Unit normal.
    [[nodiscard]] glm::dvec3 normal_at(double row, double column) const;
    // Puts the unit normals of posts first_column ... of a row into `normals`.
    void normals_of_row(int row, int first_column, std::span<glm::dvec3> normals) const;

    // How rows and columns lie on the ground at a post: metres from it to the next, and by how much the way
    // from column to column is turned from east, towards north.
    struct LatticeFrame {
        double row_m;
        double column_m;
        double turn_rad;
    };
    [[nodiscard]] LatticeFrame local_frame_at(double row, double column) const;

    [[nodiscard]] int rows() const { return down_.posts; }
    [[nodiscard]] int columns() const { return across_.posts; }
    // Largest distance from the exact places that was seen when the net was made; of a net with corrections
    // at posts, where it counts.
    [[nodiscard]] double error_m() const { return error_m_; }
    [[nodiscard]] bool is_corrected() const { return !corrections_.empty(); }
    // Largest distances from post to post anywhere.
    [[nodiscard]] double row_m() const { return row_m_; }
    [[nodiscard]] double column_m() const { return column_m_; }
    // How much ways along rows and columns bend at most, 1 being a great circle, and by how much they turn at
    // the kinks of a corrected net, in radians: a stretch of them of s metres is at most bend s^2 / (8 R) +
    // kink s / 4 off its chord.
    [[nodiscard]] double bend() const { return bend_; }
    [[nodiscard]] double kink() const { return kink_; }
    // From places to posts by one polynomial, for what needs it quickly and not quite exactly: row and column
    // as a sum of powers of (u, v), the place's normal along two axes, moved and scaled to -1 .. 1 over the
    // grid. Beyond those it goes on straight.
    struct Inverse {
        static constexpr int degree = 6;
        static constexpr int terms = (degree + 1) * (degree + 2) / 2;
        glm::dvec3 along_u, along_v;  // ECEF
        glm::dvec2 middle, scale;     // (dot products - middle) * scale is in -1 .. 1
        std::array<glm::dvec2, terms>
            coefficients;      // of u^i v^j: i from 0, and of each j from 0 to degree - i
        glm::dmat2 beyond;     // posts a step of (u, v), outside
        double error_posts{};  // largest seen over the grid

        [[nodiscard]] glm::dvec2 uv(const glm::dvec3& normal) const {
            return (glm::dvec2(glm::dot(normal, along_u), glm::dot(normal, along_v)) - middle) * scale;
        }
        [[nodiscard]] PostNumber post(const glm::dvec3& normal) const;
    };
    [[nodiscard]] const Inverse& inverse() const { return inverse_; }
    // Box of all posts; east may run past 180.
    struct Box {
        double west_deg, south_deg, east_deg, north_deg;
    };
    [[nodiscard]] const Box& box() const { return box_; }

  private:
    static constexpr int terms = 9;
    using Terms = std::array<double, terms>;
    struct Patch {
        static constexpr std::int32_t none = -1;
        std::array<glm::dvec3, terms * terms> coefficients;
        std::int32_t correction{none};  // its number among those of the net
    };
    static_assert(terms * terms == coefficients_a_patch);
    struct Jet {
        glm::dvec3 normal, by_row, by_column;  // not of unit length, but all but
    };
    struct Cut;
    LatticeGeoreference(const Cut& down, const Cut& across);
    // A patch by its number down and across.
    struct PatchNumber {
        int row, column;
    };
    Result<std::optional<PatchNumber>> fit_patches(const ExactPlaces& exact, PatchNumber first);
    Result<bool> fit_corrected(const ExactPlaces& exact);
    // What a patch becomes, its coefficients aside; `holds` is false where a correction would be none.
    struct Corrected {
        double error_m{};
        bool holds{true};
        std::optional<Correction> correction;
    };
    Result<Corrected> make_corrected(const ExactPlaces& exact, int row, int column);
    Result<Corrected> correction_of(const ExactPlaces& exact, int row, int column) const;
    Result<void> fit_patch(const ExactPlaces& exact, int row, int column);
    Result<double> patch_error_m(const ExactPlaces& exact, int row, int column) const;
    void add_correction(Correction correction);
    Result<void> take_corrections(const std::vector<Correction>& corrections);
    [[nodiscard]] bool is_gentle(int row, int column) const;
    [[nodiscard]] bool patches_are_whole() const;
    [[nodiscard]] bool rims_meet(int row, int column) const;
    Result<void> measure();
    void find_box();
    Result<void> fit_inverse();
    [[nodiscard]] const Patch& patch(int row, int column) const {
        return patches_[static_cast<std::size_t>(row * across_.patches + column)];
    }
    [[nodiscard]] Jet jet_at(double row, double column) const;
    void correct(const Patch& of, const PostNumber& at, int row, int column, Jet& jet) const;
    static PostNumber step_towards(const glm::dvec3& wanted, const Jet& jet);
    [[nodiscard]] PostNumber across_rims(const PostNumber& post, const glm::dvec3& wanted) const;

    // The patches along one axis. Sums of whole numbers are exact, so a part has the places of its whole.
    struct Cut : Stored::Axis {
        [[nodiscard]] int patch_of(double number) const;
        // -1 .. 1 from the patch's first post to the next one's.
        [[nodiscard]] double in_patch(double number, int patch) const {
            return 2.0 * (number + first - static_cast<double>(patch) * patch_posts) / patch_posts - 1.0;
        }
        // The number of a place in a patch: the inverse of the above.
        [[nodiscard]] double number(int patch, double place) const {
            return 0.5 * (place + 1.0) * patch_posts + static_cast<double>(patch) * patch_posts - first;
        }
        // Posts from a patch's first one.
        [[nodiscard]] int post_of_patch(int number, int patch) const {
            return number + first - patch * patch_posts;
        }
        // The last post of a patch that the grid has, the next one's first among them.
        [[nodiscard]] int last_of_patch(int patch) const {
            return std::min(patch_posts, post_of_patch(posts - 1, patch));
        }
        [[nodiscard]] double last() const { return posts - 1.0; }
    };
    static Cut cut(int posts, int patches);
    static glm::dvec3 polynomial_at(const Patch& of, double down, double right);
    [[nodiscard]] glm::dvec3 in_patch(int row, int column, double down, double right) const;
    // What a post of a patch is corrected by.
    [[nodiscard]] glm::dvec3 correction_at(const Patch& of, int down, int right) const {
        const auto columns = static_cast<std::size_t>(across_.patch_posts) + 1;
        const auto& steps =
            corrections_[static_cast<std::size_t>(of.correction)]
                .posts[static_cast<std::size_t>(down) * columns + static_cast<std::size_t>(right)];
        return correction_step * glm::dvec3(steps[0], steps[1], steps[2]);
    }

    Cut down_, across_;
    std::vector<Patch> patches_;
    std::vector<Correction> corrections_;
    double error_m_{};
    double row_m_{}, column_m_{}, bend_{}, kink_{};
    Box box_{};
    glm::dvec3 middle_{};  // normal of the grid's middle
    Inverse inverse_{};
};

// The place with a unit normal, and the other way.
PostPlace place_of_normal(const glm::dvec3& normal);
glm::dvec3 normal_of_place(const PostPlace& place);

// Position of what is h_m above the ellipsoid along its unit normal. Error: below 1e-8 m.
inline Ecef ecef_along(const glm::dvec3& normal, double h_m) {
    const double across_m = wgs84_a_m / std::sqrt(1.0 - wgs84_e2 * normal.z * normal.z);
    return {{(across_m + h_m) * normal.x, (across_m + h_m) * normal.y,
             (across_m * (1.0 - wgs84_e2) + h_m) * normal.z}};
}

}  // namespace oro
