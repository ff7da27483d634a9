// What each thing that a picture models or leaves out does to a view: predicted from the surface and the eye,
// before anything is drawn.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/camera.h"
#include "core/height_coding.h"
#include "core/oracle.h"
#include "core/picture_error.h"
#include "core/region_pages.h"
#include "core/true_surface.h"
#include "core/world_model.h"

namespace oro {

enum class EffectKind {
    geoid,          // H taken for h, the eye's, too
    sphere,         // Earth::sphere
    flat,           // Earth::flat
    refraction,     // light that goes straight
    float32_posts,  // Precision::rounded_posts
    float32_view,   // Precision::naive, its rounded posts included
    steps_f32,      // heights in steps of 2^-11 m
    steps_i16,      // heights in 16 bits
    detail,         // levels at tau
    placement,      // float32 relative to the eye
    depth,          // what a depth in float32 resolves
    pixel_grid,     // corners of triangles on a grid of 1/256 px
    flat_cells,     // triangles of full resolution are flat, the surface is curved
    interpolation,  // between posts nobody has measured
    source,         // what the source says of its own accuracy
};
// "sphere for ellipsoid": as tables call it.
const char* name_of(EffectKind kind);

// How large an effect is in a view: heights at the drawn points in metres, and what that is on the picture.
// worst is a bound, typical the median of what is in view.
struct EffectSize {
    double worst_m{};
    double typical_m{};
    double worst_px{};
    double typical_px{};
};

// How a view is to be drawn.
struct DrawingModel {
    WorldModel world;
    bool geoid{true};     // false: N = 0
    HeightCoding coding;  // of the heights on the GPU
    double tau_px{1.0};
};

// What is known of the world and of the region, besides its posts.
struct TrueWorld {
    double refraction_k{usual_refraction_k};
    std::optional<double> source_le90_m;  // half the height interval that holds 90 % of the source's errors
    HeightCoding sixteen;                 // what i16 would be for the region
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

    // Whether an effect is in a picture that is drawn so. Interpolation and source are in all of them.
    [[nodiscard]] static bool is_in(EffectKind kind, const DrawingModel& drawing, const TrueWorld& world);

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
