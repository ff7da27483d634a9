// What each thing that a picture models or leaves out does to a view: predicted from the surface and the eye,
// before anything is drawn.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/earth/camera.h"
#include "core/effects/effect_table.h"
#include "core/frame/region_pages.h"
#include "core/terrain/flat_triangle.h"
#include "core/truth/oracle.h"
#include "core/truth/picture_error.h"
#include "core/truth/true_ground.h"
#include "core/truth/view_samples.h"

namespace oro {

// How large an effect is in a view: how far ground is moved, in metres and on the picture. worst: no ground
// that is seen is moved farther, and so (docs/TRUTH.md) nothing that is seen, no edge and no skyline.
// typical: the median of what is in view. Of the data's own limits: heights, and what they are on the
// picture.
struct EffectSize {
    double worst_m{};
    double typical_m{};
    double worst_px{};
    double typical_px{};
    // How sizes spread over what is in view, as estimates tell it: 99 of 100 are within p99_px, all that were
    // looked at within largest_px. worst_px is that times a margin.
    double p99_px{};
    double largest_px{};
};

// Heights of a grid that are off by up to worst_m, and typically by typical_m, wherever they are.
struct HeightsOff {
    double worst_m{};
    double typical_m{};
};

// Predicts the effects in one view, from what it sees (core/truth/view_samples.h), and on another Earth from
// what a picture of that one shows, too. Asks for the pages that hold what is seen when detail is asked for.
// Bounds of what drawing rounds off and of levels are derived; those of the Earth, the geoid and the air are
// the largest at the samples, times a margin for what lies between them.
class EffectPrediction {
  public:
    // pages, world: of each of the ground's grids. camera: the true eye. What ground and pages are made of
    // outlives the prediction. Steps between grids are left out: measures do not count them, either.
    EffectPrediction(const TrueGround& ground, const RegionPagesList& pages, const Camera& camera,
                     const EarthParameters& world, int threads);

    // Nothing is in view: all sizes are 0.
    [[nodiscard]] bool empty() const { return sight_lines() == 0; }
    // Sight lines that met ground.
    [[nodiscard]] std::size_t sight_lines() const;
    [[nodiscard]] double nearest_m() const;
    [[nodiscard]] double median_distance_m() const;

    // Of one effect by itself. tau_px: for detail.
    // Nothing for a source that says nothing. Errors: a page that cannot be read. Not from several threads at
    // a time.
    [[nodiscard]] Result<std::optional<EffectSize>> size(EffectKind kind, double tau_px) const;

    // Heights that are off by so much at what is seen, metres, 0 or more: what was found there, without a
    // margin.
    [[nodiscard]] EffectSize found_off_by(const std::function<double(const ViewSample&)>& height_m) const;

    // What lies between posts that are `apart` of the region's apart: 1 for the data as they are. 2 predicts
    // what every second post would hide, which is known.
    [[nodiscard]] EffectSize interpolation(int apart) const;
    // one of each grid.
    [[nodiscard]] EffectSize heights_off(std::span<const HeightsOff> of_grids) const;
    // Of heights that are off by so much at each sample: metres, 0 or more.
    [[nodiscard]] EffectSize heights_off_by(const std::function<double(const ViewSample&)>& height_m) const;
    // An estimate of what lies between posts, with a margin: nobody has looked there.
    [[nodiscard]] EffectSize interpolation_estimate(int apart) const;

    // Bound of the whole error of a picture that is drawn so: the sum of the effects that are in it, but for
    // interpolation and source, which no drawing can help. A plane's counts with what levels let come out.
    // Errors: as size().
    [[nodiscard]] Result<EffectSize> total(const DrawingModel& drawing) const;

  private:
    using Sample = ViewSample;
    using Drawn = std::function<glm::dvec3(const Sample& sample)>;
    using Bound = std::function<double(const Sample& sample)>;
    // What is drawn elsewhere than it is seen: by where the truth's samples are drawn, and by where what a
    // picture of `model` shows truly is.
    [[nodiscard]] EffectSize moved(const Drawn& drawn, double margin) const;
    // tau_px: levels may let so much more ground come out from behind edges.
    [[nodiscard]] EffectSize moved_by(EffectKind kind, const WorldModel& model, double tau_px) const;
    // A point that a picture of another model shows: how far that is from where it truly is.
    struct Shown {
        double metres;
        double px;
        double from_seen_px;  // as ViewSample
        double outside_px;    // of the picture
        bool even;
    };
    [[nodiscard]] double outside_px(const glm::dvec3& apparent_m) const;
    [[nodiscard]] const std::vector<Shown>& shown_by(EffectKind kind, const WorldModel& model,
                                                     int rim_px) const;
    // Heights that are off by no more than a bound.
    [[nodiscard]] EffectSize lifted(const Bound& height_m) const;
    // Points that are off by no more than a bound, whichever way.
    [[nodiscard]] EffectSize anywhere(const Bound& bound_m, const Bound& typical_m) const;
    [[nodiscard]] double vertical_px(const Sample& sample, double height_m) const;
    [[nodiscard]] double any_way_px(const Sample& sample, double metres) const;
    [[nodiscard]] double apart_px(const glm::dvec3& drawn_m, const glm::dvec3& seen_m) const;
    [[nodiscard]] FlatTriangle flat_triangle(const Sample& sample, double posts) const;
    struct PostShare {
        int row;
        int column;
        double share;
    };
    [[nodiscard]] std::array<PostShare, 3> shares_of(const Sample& sample) const;
    [[nodiscard]] EffectSize in_sixteen_bits() const;
    [[nodiscard]] EffectSize in_float32(Precision precision) const;
    [[nodiscard]] Result<EffectSize> detail(double tau_px) const;
    [[nodiscard]] EffectSize gaps_closed(double tau_px) const;
    [[nodiscard]] Result<std::optional<EffectSize>> new_size(EffectKind kind, double tau_px) const;
    [[nodiscard]] std::optional<EffectSize> known_bound(EffectKind kind) const;
    [[nodiscard]] EffectSize in_flat_cells() const;
    [[nodiscard]] std::optional<EffectSize> stated_by_source() const;
    [[nodiscard]] EffectSize without_geoid() const;
    [[nodiscard]] const TrueSurface& surface(const Sample& sample) const {
        return ground_.surface(sample.grid);
    }
    [[nodiscard]] const PostGrid& grid(const Sample& sample) const { return surface(sample).field().grid; }
    // N that the pages of a grid go without.
    [[nodiscard]] double left_out_N_m(std::size_t grid, double lat_deg, double lon_deg) const;

    TrueGround ground_;
    RegionPagesList pages_;
    Camera camera_;
    EarthParameters world_;
    int threads_;
    Sight sight_;
    glm::dmat3 view_from_ecef_;
    double pixels_per_tangent_;
    std::vector<ViewSample> samples_;
    mutable std::map<std::pair<EffectKind, int>, std::vector<Shown>> shown_;
    mutable std::map<std::pair<EffectKind, double>, std::optional<EffectSize>> known_;
};

}  // namespace oro
