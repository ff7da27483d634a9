// The four measures of a picture, and the truth that they are taken against.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/earth/camera.h"
#include "core/measure/drawn_point.h"
#include "core/measure/ground_error.h"
#include "core/measure/seen_error.h"
#include "core/measure/skyline_error.h"
#include "core/truth/oracle.h"
#include "core/truth/true_ground.h"

namespace oro {

// What a view truly shows: made once, however many drawings of it are measured. All that it is made of
// outlives it.
class TruePicture {
  public:
    TruePicture(const TrueGround& ground, const Sight& sight, const Camera& camera, int threads);

    [[nodiscard]] const Skyline& skyline() const { return skyline_; }

  private:
    friend struct PictureErrors picture_errors(const TruePicture&, std::span<const DrawnPoint>,
                                               std::span<const DrawnDepths>, int, std::span<const TrueMesh>);
    TrueGround ground_;
    const Sight& sight_;
    Camera camera_;
    Oracle oracle_;
    std::vector<std::optional<SightHit>> hits_;
    Skyline skyline_;
};

// How far a drawing is from the truth: what a drawing moves by no more than so many pixels, is not seen, has
// no edge and no skyline farther off (docs/TRUTH.md, One bound for four measures).
struct PictureErrors {
    GroundErrors ground;  // displacement of each ground point, and distance from the surface
    SeenErrors seen;      // what is truly seen there
    SkylineError skyline;
    double nearest_m{};  // along the view axis, of what is drawn; 0: nothing is
    double slack_px{};   // drawing_slack_px() of the ground that has most
    // The largest of all four in pixels; of edges less what they are found to (seen_resolution_px).
    [[nodiscard]] double largest_px() const;
    // Some of what that is of is only known to be no smaller than it says (ErrorSummary::at_least).
    [[nodiscard]] bool largest_px_at_least() const;
};
// samples: as skyline_error(). drawn: the triangles that are drawn in the place of the ground's meshes;
// empty: these themselves.
PictureErrors picture_errors(const TruePicture& truth, std::span<const DrawnPoint> points,
                             std::span<const DrawnDepths> samples, int threads,
                             std::span<const TrueMesh> drawn = {});

// What drawing may round off on a picture, besides what tau allows: 0.05 px; and near ground what is more
// than that: half a step of the heights, 0.24 mm, and what a cell's flat triangles are off, 0.4 mm with posts
// of 3 seconds (0.3 mm in height, 0.2 mm along level ground), on walls more. z_m: of the ground along the
// view axis; 0: there is none. steepness: of the ground, metres a metre.
double drawing_slack_px(const Camera& camera, const PostGrid& grid, double z_m, double steepness = 0.0);

}  // namespace oro
