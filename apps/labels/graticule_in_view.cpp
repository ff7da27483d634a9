#include "apps/labels/graticule_in_view.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "apps/names/name_labels.h"
#include "apps/overlay/graticule.h"
#include "apps/overlay/line_masks.h"
#include "core/base/parallel.h"
#include "core/truth/oracle.h"

namespace oro {
namespace {

constexpr InkedText::Colour light{250, 250, 246}, dark{16, 20, 28};
constexpr double light_px = 1.0, dark_px = 2.4;

// Places of the ground, even over the picture.
std::vector<Geodetic> seen_places(const View& view, const TrueGround& ground) {
    constexpr int side = 32;
    const Camera& camera = view.camera;
    const Sight sight = sight_from(camera.eye, view.model.air);
    std::vector<std::optional<Geodetic>> hits(static_cast<std::size_t>((side + 1) * (side + 1)));
    in_parallel(side + 1, thread_count(), [&](int row) {
        for (int column = 0; column <= side; ++column) {
            const glm::dvec2 at_px(std::clamp(camera.width_px * (column / static_cast<double>(side)), 0.5,
                                              camera.width_px - 0.5),
                                   std::clamp(camera.height_px * (row / static_cast<double>(side)), 0.5,
                                              camera.height_px - 0.5));
            const auto hit =
                first_hit(ground, sight, camera.ecef_direction_at(at_px), sight_reach_m(camera.eye.h_m));
            if (hit) hits[static_cast<std::size_t>(row * (side + 1) + column)] = hit->point;
        }
    });
    std::vector<Geodetic> places;
    for (const auto& hit : hits)
        if (hit) places.push_back(*hit);
    return places;
}

// A little more than what was looked at.
CoordinateRange widened(CoordinateRange range, double least, double most) {
    constexpr double share = 0.05;
    const double more = share * (range.high - range.low);
    range.low = std::max(range.low - more, least);
    range.high = std::min(range.high + more, most);
    return range;
}

Result<std::vector<GraticuleLine>> lines_over(const View& view, const std::vector<Geodetic>& places) {
    constexpr double far = 1e12;
    std::vector<double> one, other;
    if (view.graticule == Graticule::geographic) {
        for (const Geodetic& place : places) {
            one.push_back(place.lat_deg);
            // Counted on from the first without a jump.
            const double first_deg = places.front().lon_deg;
            other.push_back(first_deg + std::remainder(place.lon_deg - first_deg, 360.0));
        }
        const CoordinateRange lat_deg = widened(range_of(std::move(one)), -90.0, 90.0),
                              lon_deg = widened(range_of(std::move(other)), -far, far);
        return geographic_lines(lat_deg, lon_deg, graticule_interval_s(lat_deg, lon_deg));
    }
    ORO_TRY(const CrsPlaces crs, CrsPlaces::of(view.graticule_crs, CrsPlaces::Reach::anywhere));
    for (const Geodetic& place : places) {
        const auto numbers = crs.coordinates(place.lat_deg, place.lon_deg);
        if (!numbers) continue;
        one.push_back((*numbers)[0]);
        other.push_back((*numbers)[1]);
    }
    if (one.empty()) return std::vector<GraticuleLine>();
    const CoordinateRange x = widened(range_of(std::move(one)), -far, far),
                          y = widened(range_of(std::move(other)), -far, far);
    return projected_lines(crs, x, y, graticule_interval(x, y));
}

bool touch(const TextMask& one, const TextMask& other) {
    return one.x_px < other.x_px + other.width_px && other.x_px < one.x_px + one.width_px &&
           one.y_px < other.y_px + other.height_px && other.y_px < one.y_px + one.height_px;
}

// The values of the lines that are seen, those of little room left out.
Result<void> add_labels(const std::vector<GraticuleLine>& lines, const std::vector<SeenLine>& seen,
                        const Camera& camera, const TextFace& face, const std::vector<InkedText>& in_the_way,
                        std::vector<InkedText>& labels) {
    const double size_px = name_size_px(camera.height_px), halo_px = name_halo_share * size_px;
    const glm::dvec2 picture_px(camera.width_px, camera.height_px);
    std::vector<std::vector<const SeenLine*>> parts(lines.size());
    for (const SeenLine& part : seen) parts[part.shape].push_back(&part);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (parts[i].empty()) continue;
        ORO_TRY(const double width_px, face.width_px(lines[i].label, size_px));
        const glm::dvec2 half_px(0.5 * width_px + halo_px + 2.0, 0.5 * size_px + halo_px + 2.0);
        const auto at_px = label_place(parts[i], picture_px, half_px, 2.0 * width_px);
        if (!at_px) continue;
        ORO_TRY(TextMask mask, face.mask(lines[i].label, {*at_px, 0.0, size_px, halo_px}));
        const auto touches = [&](const InkedText& text) { return touch(mask, text.mask); };
        if (std::ranges::any_of(in_the_way, touches) || std::ranges::any_of(labels, touches)) continue;
        labels.push_back({std::move(mask), dark, light});
    }
    return {};
}

}  // namespace

Result<GraticuleInView> graticule_in_view(const View& view, const TrueGround& ground,
                                          const PointsInView& in_view, const TextFace& face,
                                          const std::vector<InkedText>& in_the_way) {
    GraticuleInView graticule;
    const std::vector<Geodetic> places = seen_places(view, ground);
    if (places.empty()) return graticule;
    ORO_TRY(const std::vector<GraticuleLine> lines, lines_over(view, places));
    std::vector<const VectorShape*> shapes;
    for (const GraticuleLine& line : lines) shapes.push_back(&line.shape);
    const Camera& camera = view.camera;
    const std::vector<SeenLine> seen = seen_lines(shapes, ground, in_view, camera, dark_px);
    LineMask under(camera.width_px, camera.height_px), over(camera.width_px, camera.height_px);
    for (const SeenLine& line : seen) {
        under.add(line.places_px, dark_px);
        over.add(line.places_px, light_px);
    }
    under.give(dark, graticule.lines);
    over.give(light, graticule.lines);
    ORO_CHECK(add_labels(lines, seen, camera, face, in_the_way, graticule.labels));
    return graticule;
}

}  // namespace oro
