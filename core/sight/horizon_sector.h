// The horizon that nearer ground makes over a sector of azimuths. Within core.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/sight/eye_plane.h"
#include "core/sight/swept_posts.h"

namespace oro {

// How high ground is seen over level, as the tangent: of a net of straight edges, and how far that may be
// off.
struct Horizon {
    static constexpr double none = -std::numeric_limits<double>::infinity();
    double tangent{none};
    double lowest{none};  // the ground's own is between these
    double highest{none};
    bool has_rim{false};  // on the way ground ends or begins: a line may run on below it

    void add(double height_m, double distance_m, double error_m) {
        const double per_m = 1.0 / distance_m;
        tangent = std::max(tangent, height_m * per_m);
        lowest = std::max(lowest, (height_m - error_m) * per_m);
        highest = std::max(highest, (height_m + error_m) * per_m);
    }
};

// Azimuths by a number that grows with them counter-clockwise from east, 0 .. 4, and is quick to have.
inline double azimuth_number(const PlanePost& post) {
    const double sum = std::abs(post.x) + std::abs(post.y);
    const double share = sum > 0.0 ? post.y / sum : 0.0;
    if (post.x < 0.0) return 2.0 - share;
    return share < 0.0 ? 4.0 + share : share;
}

class HorizonSector {
  public:
    // Of the ranges first .. first + count - 1 of `ranges` around the eye.
    HorizonSector(const EyePlane& plane, int ranges, int first, int count);

    // Takes the edge between two posts in; those that are farther than a target must come after it.
    // `is_rim`: there is ground on one side of it only.
    void add_edge(std::int64_t one, std::int64_t other, bool is_rim);
    // True where no edge of a post counts: all that begin or end there, or at a post that is nearer, lie
    // within `reach` of the post's azimuth, as azimuth_number() counts, are seen no higher than at `tangent`,
    // and have ground on both sides. add_edge() would change nothing.
    [[nodiscard]] bool is_above(const PlanePost& post, double reach, double tangent) const;
    // The same of ranges of the sector, which SweptPosts finds; true of none.
    [[nodiscard]] bool is_above(int first_range, int last_range, double tangent) const {
        return last_range < first_range ||
               are_all_above(lowest_.data() + first_range, last_range - first_range + 1, tangent);
    }
    // The horizon in a target's own direction; false where too many edges came together.
    [[nodiscard]] bool horizon(const PlanePost& target, Horizon& horizon) const {
        return this->horizon(target, static_cast<int>(azimuth_number(target) * 0.25 * ranges_) - first_,
                             horizon);
    }
    // ... with the number of the target's range, which SweptPosts finds.
    [[nodiscard]] bool horizon(const PlanePost& target, int number, Horizon& horizon) const;

  private:
    struct Edge {
        std::uint32_t right, left;  // as seen from the eye: 2^32 posts would take 170 GB
        double highest;
    };
    // Edges that may be the highest anywhere in a range of azimuths.
    struct Range {
        static constexpr int most = 16;
        double left_out{Horizon::none};  // nothing that found no room was higher
        int count{0};
        bool has_rim{false};
        std::array<Edge, most> edges;
    };
    [[nodiscard]] double most_tangent(const PlanePost& right, const PlanePost& left, double turned) const;
    // Where an edge crosses the border of two ranges, once that is known.
    struct Crossing {
        double tangent, distance_m;
        bool is_known;
    };
    void add_to(int number, const Edge& edge, bool begins, bool ends, Crossing& border);
    [[nodiscard]] double tangent_at(const PlanePost& right, const PlanePost& left, const PlanePost& towards,
                                    double& distance_m) const;

    const EyePlane& plane_;
    int ranges_;
    int first_;
    std::vector<Range> own_;
    std::vector<double> lowest_;      // of each range: everywhere in it something is as high
    std::vector<PlanePost> borders_;  // directions, one more than ranges
};

}  // namespace oro
