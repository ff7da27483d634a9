// A made terrain as it truly is and as it is drawn: what each extreme is measured on.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/measure/ground_error.h"
#include "core/measure/picture_errors.h"
#include "core/truth/true_surface.h"
#include "render/frame/depth_picture.h"
#include "render/frame/frame_renderer.h"
#include "render/scene/scene.h"
#include "tests/support/gpu_fixture.h"

namespace oro::test {

// A strip of a picture that is 1080 pixels high, so that errors in pixels are those of a full HD picture.
inline constexpr int strip_width_px = 32, strip_height_px = 1080;
Camera strip_camera(const Geodetic& eye, const Attitude& attitude, double fov_deg = 45.0);

// Hills by a formula of the place on the unit sphere: without a seam at the poles and the antimeridian.
// Features from 2 pi R / waves down to an eighth of it; heights within 2 `height_m` of 0.
float globe_H_m(double lat_deg, double lon_deg, double waves, double height_m);

class Stage {
  public:
    // Errors are failed expectations.
    Stage(const Gpu& gpu, HeightField field, double exaggeration = 1.0);

    struct Drawn {
        std::vector<float> depths;
        std::vector<DrawnPoint> points;
        std::vector<std::uint32_t> ids;
        FrameReport report;
    };
    // One frame of a camera's whole picture; everything that is sent is scanned, and depths that are not
    // finite are failures.
    Drawn draw(const Camera& camera, RasterPath path, double tau_px = 0.0, const WorldModel& model = {});
    // The scene's plan of such a frame, scanned.
    FramePlan plan(const Camera& camera, const Tile& tile, double tau_px, const WorldModel& model = {});

    // How far the ground of a drawn picture is from where it truly is.
    [[nodiscard]] GroundErrors ground(const Camera& camera, std::span<const DrawnPoint> points,
                                      GroundMeasures measures = GroundMeasures::displacement) const;
    // Draws a view at full detail and takes all four measures of it.
    struct Measured {
        DepthPicture picture;
        PictureErrors errors;
    };
    [[nodiscard]] Measured measure(const Camera& camera, RasterPath path);

    struct Agreement {
        std::uint64_t pixels{};  // compared
        std::uint64_t wrong{};   // whose drawn distance the oracle sees nowhere near them
        std::uint64_t ground{};  // where the oracle sees ground
    };
    // Holds the drawn distance of every `every`-th pixel against those that the oracle sees through its
    // middle and `around_px` left, right, above and below: it must lie between them, give or take slack_m and
    // the rounding of float, 6e-7 of the distance.
    [[nodiscard]] Agreement agreement(const Camera& camera, const std::vector<float>& depths, int every,
                                      double around_px = 0.1, double slack_m = 0.01) const;

    [[nodiscard]] const HeightField& field() const { return field_; }
    [[nodiscard]] const TrueSurface& surface() const { return surface_; }
    Scene& scene() { return *scene_; }
    // Height of the ground above the ellipsoid; a failure where there is none.
    [[nodiscard]] double ground_h_m(double lat_deg, double lon_deg) const;

  private:
    FrameRenderer& renderer(RasterPath path, const Camera& camera);

    const Gpu& gpu_;
    HeightField field_;
    TrueSurface surface_;
    std::optional<Scene> scene_;
    std::map<RasterPath, FrameRenderer> renderers_;
    std::map<RasterPath, DepthPainter> painters_;
};

// A GPU, named in the tables.
class Extremes : public GpuTest {
  protected:
    void SetUp() override;
    // Draws a view by one path, and records its worst displacement in pixels and the pixels in which the
    // oracle sees something else; either name may be empty. Gives the errors of the ground.
    static GroundErrors check_view(Stage& stage, const Camera& camera, RasterPath path, const char* group,
                                   const char* px_row, const char* wrong_row, int every = 7,
                                   GroundMeasures measures = GroundMeasures::displacement);
};

inline constexpr RasterPath both_paths[] = {RasterPath::mesh, RasterPath::compute};

}  // namespace oro::test
