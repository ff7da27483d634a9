// Whether a group stands in a view for what it was made of: the rule of every cut.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <optional>

#include "core/clusters/cluster_graph.h"
#include "core/earth/camera.h"
#include "core/earth/world_model.h"
#include "shaders/shared.h"

namespace oro {

// A group stands where its error, projected from the nearest place that it may have, is at most tau: the
// bound of projected_error_px (shaders/choose/levels.glsl). The processor measures a group for an eye, in
// double; the answer is that of shaders/clusters/group_rule.glsl, in float, here as on the GPU, to the bit.
// Light may bend (core/frame/model_view.h, whose spheres grow alike). As errors and spheres grow from a group
// to those above, so does the bound; rounding is kept out by letting tau shrink and spheres grow, by two and
// by one millionth from a level to the next. So where a group stands all below it stand, whatever order they
// are asked in.
//
// With a level the cut is the same from everywhere (discrete): all groups up to that level stand, none above.
// Then nothing is promised in pixels.
class GroupRule {
  public:
    // tau_px: at least 0.
    GroupRule(const Camera& camera, double tau_px, const Air& air = {},
              std::optional<std::uint32_t> level = {});

    [[nodiscard]] bool stands(const ClusterGroup& group) const;
    // What the GPU needs for the same answer.
    [[nodiscard]] gpu::AskedGroup measured(const ClusterGroup& group) const;
    [[nodiscard]] const gpu::CutRule& cut_rule() const { return rule_; }
    // The rule of this eye where less is asked for: each step is sqrt(2) times the tau, of at least 1/16 px,
    // or one level more. After the last all groups stand.
    [[nodiscard]] GroupRule coarser(unsigned steps) const;
    static constexpr unsigned most_coarser_steps = 64;
    // The bound itself, in double, pixels; infinite where nothing can be promised. At most tau where a group
    // stands, but for that of a level.
    [[nodiscard]] double error_px(const ClusterGroup& group) const;

    // Where a sphere is seen, in view coordinates: light that bends lifts it, and makes it larger.
    struct SeenSphere {
        glm::dvec3 centre_m;
        double radius_m;
        double stretch;  // what lengths in it are at most multiplied by
    };
    [[nodiscard]] SeenSphere seen(const Ecef& centre, double radius_m) const;

  private:
    gpu::CutRule rule_;
    double tau_px_;  // before it is rounded
    double curvature_per_m_;
    glm::dmat3 view_from_ecef_;
    Ecef eye_;
    glm::dvec3 up_view_;
};

// The GPU's own answer (shaders/clusters/group_rule.glsl) compiled for the processor.
bool stands(const gpu::AskedGroup& group, const gpu::CutRule& rule);

}  // namespace oro
