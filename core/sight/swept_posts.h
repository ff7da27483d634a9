// The posts of one shell of a viewshed's sweep, quantity by quantity, so that loops over them become vector
// code. Within core.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/sight/eye_plane.h"

namespace oro {

class SweptPosts {
  public:
    // Of ranges first .. first + count - 1 of `ranges` around the eye, as HorizonSector has them. The plane
    // outlives this; its bound_tangents() comes first.
    SweptPosts(const EyePlane& plane, int ranges, int first, int count)
        : plane_(plane), ranges_(ranges), first_(first), count_(count) {}

    // What is known of one post.
    struct Post {
        // No edge between two posts within the plane's bound_tangents() of the post is seen higher; infinite
        // where that is not known, or the post is too near.
        double most_tangent;
        double up_s, up_z;            // the ellipsoid's normal there, along the post's direction and upwards
        double aside;                 // ... and across its direction, without a sign
        int range;                    // of the post's own direction, counted from the sector's first
        int first_range, last_range;  // of all that its edges reach, within the sector; last < first: none
    };
    // Takes the posts of a shell in place of those before. `up`: needed where a target stands on the post.
    void clear() { size_ = 0; }
    void add(std::int64_t number, const glm::dvec3& up);
    void measure();
    [[nodiscard]] Post at(std::size_t i) const {
        return {most_tangent_[i], up_s_[i], up_z_[i], aside_[i], range_[i], first_range_[i], last_range_[i]};
    }

  private:
    const EyePlane& plane_;
    int ranges_, first_, count_;
    std::size_t size_{};
    std::vector<double> x_, y_, distance_m_, up_x_, up_y_, up_z_, most_tangent_, up_s_, aside_;
    std::vector<std::int32_t> range_, first_range_, last_range_;
};

// Targets over hidden posts, and how high each would have to be over its post's ground to be seen along a
// tangent.
class HiddenTargets {
  public:
    struct Target {
        std::size_t cell;   // of the window
        double ground_z_m;  // of the post, as EyePlane has it, without the bend of light
        double s_m;         // the post's distance across the plane
        double up_s, up_z;  // the ellipsoid's normal there, along the post's direction and upwards
        double tangent;     // of the horizon
        double target_m;    // height of the target over the ground
        double further_m;   // what is added to what it misses
    };
    void clear() { targets_.clear(); }
    void add(const Target& target) { targets_.push_back(target); }
    // deficits_m[cell] of each: how much higher the target would have to be, infinite where no height would
    // do.
    void write(double bend_per_m, std::vector<float>& deficits_m);

  private:
    std::vector<Target> targets_;
    std::vector<double> numbers_;  // the same, quantity by quantity
};

// How high a target must be over the ground of a post, z + t up_z + bend (s + t up_s)^2 = tangent (s + t
// up_s); infinite where no height would do. `ground_z_m` and the rest as in HiddenTargets::Target.
[[nodiscard]] double needed_height_m(double ground_z_m, double s_m, double up_s, double up_z,
                                     double bend_per_m, double tangent);

// Whether none of `count` numbers is `tangent` or lower.
[[nodiscard]] bool are_all_above(const double* numbers, int count, double tangent);

}  // namespace oro
