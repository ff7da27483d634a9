// Where a model of the world shows what pages hold: for culling and the choice of levels, which must not lose
// what is drawn.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "core/earth/camera.h"
#include "core/earth/culling.h"
#include "core/earth/world_model.h"
#include "core/frame/height_quantization.h"
#include "core/lod/pyramid.h"

namespace oro {

// In view coordinates, metres; an infinite radius reaches everywhere.
struct ViewSphere {
    glm::dvec3 centre_m;
    double radius_m;
};

// The eye as horizon tests need it, and what the angles of cones are to be multiplied by.
struct SeenHorizon {
    HorizonEye eye;
    double stretch{1.0};
};

// An eye in a model of the world. With the model of today (WGS84, straight light, placement relative to the
// eye) all answers are those of plain geometry, to the bit.
class ModelView {
  public:
    ModelView(const Camera& camera, const WorldModel& model, const HeightQuantization& coding);

    // Pages keep their shape on every Earth, so nodes may be culled within them.
    [[nodiscard]] bool culls_nodes() const { return model_.earth == Earth::ellipsoid; }
    // Whether nodes of a page may stand for finer ones. On the flat Earth no node of a page that is so wide
    // that the plane tears it out of shape: where it lies is not known well enough.
    [[nodiscard]] bool may_stand(const PageRecord& page) const;
    // How far a post may be drawn from where the model would put it, metres: its rounding.
    [[nodiscard]] double rounding_m() const { return rounding_m_; }
    // Metres of lift for each square metre of distance across the eye's vertical, times 2; 0: light goes
    // straight.
    [[nodiscard]] double curvature_per_m() const { return refraction_.curvature_per_m(); }

    // A page's origin, light going straight.
    [[nodiscard]] glm::dvec3 origin_m(const PageSummary& page) const;
    // Where a sphere of a page's frame is seen: holds all that it held.
    [[nodiscard]] ViewSphere seen(const PageSummary& page, const glm::dvec3& in_page_m,
                                  double radius_m) const;
    // The same, with how far its middle is from the eye's vertical as light goes straight, and with what the
    // lengths in it are at most multiplied by when light bends.
    struct SeenAt {
        ViewSphere sphere;
        double across_m;
        double stretch;
    };
    [[nodiscard]] SeenAt seen_at(const PageSummary& page, const glm::dvec3& in_page_m, double radius_m) const;
    // On the ellipsoid, of a sphere around a place in ECEF.
    [[nodiscard]] SeenAt seen_at(const glm::dvec3& ecef_m, double radius_m) const {
        const ViewSphere straight{view_from_ecef_ * (ecef_m - eye_ecef_.m), radius_m};
        return curvature_per_m() == 0.0 ? SeenAt{straight, 0.0, 1.0} : bent_at(straight);
    }
    // Where the triangles of a page and of all below it are seen.
    [[nodiscard]] ViewSphere seen_page(const PostGrid& grid, const PageRecord& page) const;
    // A frustum's plane (view coordinates) for the spheres of a page's nodes where they are before light
    // bends: moved outwards by as much as anything in the page can be lifted over it. across_m: of seen_at(),
    // of the sphere around the page that has this radius.
    [[nodiscard]] Plane plane_for_nodes(const Plane& plane, double across_m, double radius_m) const;

    [[nodiscard]] SeenHorizon horizon(const HorizonOccluder& occluder) const;

  private:
    [[nodiscard]] glm::dvec3 straight_m(const PageSummary& page, const glm::dvec3& in_page_m) const;
    [[nodiscard]] double across_m(const glm::dvec3& view_m) const;
    [[nodiscard]] ViewSphere bent(const ViewSphere& straight) const;
    [[nodiscard]] SeenAt bent_at(const ViewSphere& straight) const;
    [[nodiscard]] ViewSphere on_plane(const PostGrid& grid, const PageRecord& page) const;

    WorldModel model_;
    Geodetic eye_;
    Ecef eye_ecef_;
    glm::dmat3 view_from_ecef_;
    glm::dvec3 up_view_;
    Refraction refraction_;
    double rounding_m_;
};

}  // namespace oro
