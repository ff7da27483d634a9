// What each thing that a picture models or leaves out does to a view: predicted from the surface and the eye,
// before anything is drawn.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/earth/camera.h"
#include "core/frame/region_pages.h"
#include "core/truth/effect_table.h"
#include "core/truth/oracle.h"
#include "core/truth/picture_error.h"
#include "core/truth/true_surface.h"

namespace oro {

// How large an effect is in a view: heights at the drawn points in metres, and what that is on the picture.
// worst is a bound, typical the median of what is in view.
struct EffectSize {
    double worst_m{};
    double typical_m{};
    double worst_px{};
    double typical_px{};
};

// Predicts the effects in one view. Casts up to 160 x 640 sight lines (14,400 for 16:9) when it is made; asks
// for the pages that hold what they meet when detail is asked for. Error of a prediction: what lies between
// the sight lines is not seen, so bounds carry a margin.
class EffectPrediction {
  public:
    // camera: the true eye. All outlive the prediction.
    EffectPrediction(const TrueSurface& surface, const RegionPages& pages, const Camera& camera,
                     const TrueWorld& world, int threads);

    // Nothing is in view: all sizes are 0.
    [[nodiscard]] bool empty() const { return samples_.empty(); }
    [[nodiscard]] double nearest_m() const;
    [[nodiscard]] double median_distance_m() const;

    // Of one effect by itself. tau_px: for detail. Nothing for a source that says nothing. Errors: a page
    // that cannot be read.
    // Not from several threads at a time.
    [[nodiscard]] Result<std::optional<EffectSize>> size(EffectKind kind, double tau_px) const;

    // What lies between posts that are `apart` of the region's apart: 1 for the data as they are. 2 predicts
    // what every second post would hide, which is known.
    [[nodiscard]] EffectSize interpolation(int apart) const;

    // Bound of the whole error of a picture that is drawn so: the sum of the effects that are in it, but for
    // interpolation and source, which no drawing can help. Errors: as size().
    [[nodiscard]] Result<EffectSize> total(const DrawingModel& drawing) const;

    // A point that is seen.
    struct Sample {
        Geodetic point;
        glm::dvec3 apparent_m;  // offset from the eye, ECEF axes
        double distance_m;
        double slope;  // of its triangle, metres a metre
        int row;       // of its cell
        int column;
        bool south_west;  // of the cell's triangles
    };

  private:
    using Displacement = std::function<std::optional<glm::dvec3>(const Sample& sample)>;
    using Bound = std::function<double(const Sample& sample)>;
    [[nodiscard]] std::vector<Sample> cast(const Refraction& refraction, int threads) const;
    [[nodiscard]] EffectSize displaced(const std::vector<Sample>& samples, const Displacement& drawn) const;
    [[nodiscard]] EffectSize bounded(const Bound& height_m) const;
    [[nodiscard]] double vertical_px(const Sample& sample, double height_m) const;
    struct PostShare {
        int row;
        int column;
        double share;
    };
    [[nodiscard]] std::array<PostShare, 3> shares_of(const Sample& sample) const;
    [[nodiscard]] EffectSize in_sixteen_bits() const;
    [[nodiscard]] EffectSize in_float32(Precision precision, bool backwards) const;
    [[nodiscard]] Result<EffectSize> detail(double tau_px) const;
    [[nodiscard]] Result<std::optional<EffectSize>> new_size(EffectKind kind, double tau_px) const;
    [[nodiscard]] std::optional<EffectSize> known_bound(EffectKind kind) const;
    [[nodiscard]] EffectSize as_sphere() const;
    [[nodiscard]] EffectSize in_straight_light() const;
    [[nodiscard]] EffectSize in_flat_cells() const;
    [[nodiscard]] std::optional<EffectSize> stated_by_source() const;
    [[nodiscard]] EffectSize on_flat_earth() const;
    [[nodiscard]] EffectSize without_geoid() const;
    // N that the pages go without.
    [[nodiscard]] double left_out_N_m(double lat_deg, double lon_deg) const;

    const TrueSurface& surface_;
    const RegionPages& pages_;
    Camera camera_;
    TrueWorld world_;
    int threads_;
    Sight sight_;
    glm::dmat3 view_from_ecef_;
    double pixels_per_tangent_;
    std::vector<Sample> samples_;
    mutable std::map<std::pair<EffectKind, double>, std::optional<EffectSize>> known_;
};

}  // namespace oro
