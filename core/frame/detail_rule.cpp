#include "core/frame/detail_rule.h"

#include "core/lod/levels_gpu.h"

namespace oro {

// Most answers are far from the limit. gpu::projected_error_px() is at least f e / distance, and at most its
// second bound; the shares of 1e-3 and 2e-5 are more than its slacks and the rounding of floats make of them.
bool DetailRule::good_enough(const PageQuarter& quarter, const ViewSphere& seen, double distance_m,
                             double stretch) const {
    if (quarter.largest_error_m >= gpu::unfit_error_m) return false;
    const float error_m = quarter.largest_error_m * static_cast<float>(stretch);
    if (error_m > 1.0e-20F) {
        const double error_px_m =
            static_cast<double>(view_.pixels_per_tangent) * static_cast<double>(error_m);
        const auto tau_px = static_cast<double>(view_.tau_px);
        if (error_px_m > 1.001 * tau_px * distance_m) return false;
        const double nearest_m = distance_m - seen.radius_m - 2.0e-5 * (distance_m + seen.radius_m) -
                                 1.001 * static_cast<double>(error_m) * corner_stretch_;
        if (nearest_m > 0.0 && error_px_m * corner_stretch_ * corner_stretch_ < 0.999 * tau_px * nearest_m)
            return true;
    }
    return gpu::projected_error_px(gpu::vec3(seen.centre_m), static_cast<float>(seen.radius_m), error_m,
                                   view_.pixels_per_tangent, view_.corner_tangent) <= view_.tau_px;
}

}  // namespace oro
