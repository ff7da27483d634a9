// Which named points a view sees, and where on its picture.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/vectors/named_points.h"
#include "core/earth/camera.h"
#include "core/earth/cylinder.h"
#include "core/earth/world_model.h"
#include "core/truth/oracle.h"
#include "core/truth/true_ground.h"

namespace oro {

// A point is seen where something so high on it is: a person, or the cross of a summit. It lets a point that
// lies some metres behind the highest post of its summit be named.
inline constexpr double seen_above_m = 2.0;
// A point's own height is where it is placed when it is at most so far above the ground; else the ground is.
inline constexpr double highest_above_ground_m = 300.0;
// The height that a point tells is what is written of it when it is so near the ground's there, or nearer
// than so much of that: posts 90 m apart lie 260 m below the Matterhorn's summit. Feet taken for metres are
// farther off.
inline constexpr double most_off_ground_m = 100.0;
inline constexpr double most_off_ground_share = 0.1;

struct SeenPoint {
    std::string name;
    double lat_deg{};
    double lon_deg{};
    Geodetic place;  // above the ellipsoid, exaggerated as the view is
    double H_m{};    // what is written: its own where it tells one, else that of the ground at lat, lon
    bool may_move{};
    bool is_moved{};      // `place` is the summit nearby, and neither lat nor lon
    double distance_m{};  // along the sight line
    double rank{};        // greater ones are named first
    glm::dvec2 place_px;  // from the picture's top left corner
};

// What stands in a picture and is hidden or not, beside what is named.
struct PointCounts {
    int beyond_data{};  // of the region
    int outside{};      // of the picture
    int hidden{};       // by the terrain
};

// Why none of the names of a view's files shows; "" where there are no names. Beside the counts: names that
// the font has no letters for, and those that others left no room for.
std::string note_of_no_name(const PointCounts& counts, std::size_t without_letters, std::size_t without_room);

// Tells which points an eye sees; safe to ask from one thread at a time, and shares its work between several.
class PointsInView {
  public:
    // What `ground` is made of outlives it: of the view's region and exaggeration. The model is the view's:
    // Earth and air.
    PointsInView(const TrueGround& ground, const Camera& camera, const WorldModel& model);
    // On a panorama: places are the cylinder's; view_m() and projected_px() stay the camera's.
    PointsInView(const TrueGround& ground, const Camera& camera, const WorldModel& model,
                 const Cylinder& around);

    // The ground has a canopy of so many metres at a place: points stand on it, and the H that is written of
    // those that tell none is that of the ground below.
    void count_from_below_canopy(std::function<double(const Geodetic&)> canopy_m) {
        canopy_m_ = std::move(canopy_m);
    }
    // Where a place is on the picture; nothing behind the eye.
    [[nodiscard]] std::optional<glm::dvec2> place_px(const Geodetic& point) const;
    // The two steps of place_px: in view coordinates (x right, y up, z backwards), where light shows it; and
    // from there to the picture, for z < 0.
    [[nodiscard]] glm::dvec3 view_m(const Geodetic& point) const;
    [[nodiscard]] glm::dvec2 projected_px(const glm::dvec3& view_m) const;
    // Whether a place is seen, or something up to `above_m` over it.
    [[nodiscard]] bool sees(const Geodetic& point, double above_m) const;
    // Those that are in the picture and seen, the highest rank first; the same for the same points. Rank:
    // prominence, and H below all that have one.
    [[nodiscard]] std::vector<SeenPoint> seen(const std::vector<NamedPoint>& points,
                                              PointCounts& counts) const;

  private:
    [[nodiscard]] std::optional<SeenPoint> placed(const NamedPoint& point, PointCounts& counts) const;
    void put_at(const Geodetic& place, SeenPoint& point) const;
    [[nodiscard]] bool in_picture(const SeenPoint& point) const;
    // Whether a point is seen. One that may be a summit is moved to that of the data's posts
    // (core/terrain/summit.h) where it must be: mapped summits stand behind those of a grid of posts. The
    // summit then is seen, too.
    [[nodiscard]] bool sees_or_moves(SeenPoint& point) const;
    [[nodiscard]] std::optional<Geodetic> summit_near(const Geodetic& place) const;

    TrueGround ground_;
    Camera camera_;
    WorldModel model_;
    std::optional<Cylinder> around_;
    glm::dmat3 view_from_ecef_;
    glm::dmat3 enu_from_ecef_;
    Oracle oracle_;
    std::function<double(const Geodetic&)> canopy_m_;  // null: there is none
};

}  // namespace oro
