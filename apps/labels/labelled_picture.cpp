#include "apps/labels/labelled_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <memory>
#include <numbers>
#include <optional>

#include "apps/labels/graticule_in_view.h"
#include "apps/overlay/area_masks.h"
#include "apps/text/inked_rows.h"
#include "apps/text/text_face.h"
#include "apps/view/trees_of_view.h"
#include "core/base/parallel.h"
#include "core/base/srgb.h"
#include "shaders/shared_growth.h"

namespace oro {
namespace {

constexpr double halo_share = 0.2;  // of the figures' size

std::uint8_t code_of(float linear) {
    return static_cast<std::uint8_t>(std::lround(255.0 * srgb_of_light(static_cast<double>(linear))));
}

// The line below a label is interrupted between its letters, too, where their halos leave a gap.
void interrupt_line(const LineLabel& label, double size_px, TextMask& mask) {
    const double radians = label.angle_deg * std::numbers::pi / 180.0;
    const glm::dvec2 along(std::cos(radians), std::sin(radians)), across(-along.y, along.x);
    const glm::dvec2 half(0.5 * label.length_px, most_line_off_share * size_px + 1.0);
    for (int y = 0; y < mask.height_px; ++y) {
        for (int x = 0; x < mask.width_px; ++x) {
            const glm::dvec2 away = glm::dvec2(mask.x_px + x + 0.5, mask.y_px + y + 0.5) - label.middle_px;
            const glm::dvec2 in = half - glm::abs(glm::dvec2(glm::dot(away, along), glm::dot(away, across)));
            const double share = std::clamp(std::min(in.x, in.y) + 0.5, 0.0, 1.0);
            std::uint8_t& halo =
                mask.halo[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width_px) +
                          static_cast<std::size_t>(x)];
            halo = std::max(halo, static_cast<std::uint8_t>(std::lround(255.0 * share)));
        }
    }
}

bool touches(const TextMask& mask, const std::vector<NameLabel>& names) {
    const Box box{static_cast<double>(mask.x_px), static_cast<double>(mask.y_px),
                  static_cast<double>(mask.x_px + mask.width_px),
                  static_cast<double>(mask.y_px + mask.height_px)};
    return std::ranges::any_of(
        names, [&](const NameLabel& name) { return box.touches(name.box) || box.touches(name.leader); });
}

// What a view's vector files put on its picture.
Result<void> find_vectors(const View& view, const TrueGround& ground, const TextFace& face,
                          ViewWriting& writing) {
    const std::vector<NamedPoint> points = points_of(view);
    if (points.empty() && view.vectors_read->overlay.empty()) return {};
    const PointsInView in_view(ground, view.camera, view.model);
    writing.overlay = overlay_in_view(view, ground, in_view);
    ORO_TRY(writing.names, names_in_view(points, in_view, view.camera, face));
    // What could not be read counts as void: sight lines went through it.
    return ground.health();
}

// The graticule, below the lines of vector files; its values where no name and no label stands.
Result<void> find_graticule(const View& view, const TrueGround& ground, const TextFace& face,
                            ViewWriting& writing) {
    const PointsInView in_view(ground, view.camera, view.model);
    ORO_TRY(GraticuleInView graticule, graticule_in_view(view, ground, in_view, face, writing.texts));
    std::vector<InkedText>& lines = writing.overlay.inked;
    lines.insert(lines.begin(), std::make_move_iterator(graticule.lines.begin()),
                 std::make_move_iterator(graticule.lines.end()));
    for (InkedText& label : graticule.labels) writing.texts.push_back(std::move(label));
    return ground.health();
}

}  // namespace

PictureOptions picture_options(const View& view, RasterPath path) {
    PictureOptions options;
    options.samples = view.samples;
    options.tau_px = view.tau_px;
    options.model = view.model;
    options.path = path;
    if (view.show && !view.shows_mesh_parts) options.show = shown_by(*view.show);
    return options;
}

bool has_writing(const View& view, const Style& style) {
    return style.labels_px > 0.0 || view.vectors_read || view.graticule;
}

Result<std::vector<LineLabel>> add_line_labels(const TextFace& face, const SeenHeights& seen,
                                               const Style& style, const std::vector<NameLabel>& names,
                                               std::vector<InkedText>& texts) {
    const gpu::ContourLines& lines = style.frame.contours;
    const double size_px = style.labels_px;
    const InkedRows::Colour ink{code_of(lines.colour.x), code_of(lines.colour.y), code_of(lines.colour.z)};
    ORO_TRY(const std::vector<LineLabel> labels,
            line_labels(seen, static_cast<double>(lines.interval_m), size_px,
                        [&](const std::string& text) { return face.width_px(text, size_px); }));
    std::vector<LineLabel> written;
    for (const LineLabel& label : labels) {
        ORO_TRY(TextMask mask,
                face.mask(label.text, {label.middle_px, label.angle_deg, size_px, halo_share * size_px}));
        if (touches(mask, names)) continue;
        interrupt_line(label, size_px, mask);
        texts.push_back({std::move(mask), ink, {}});
        written.push_back(label);
    }
    return written;
}

Result<ViewWriting> find_writing(const Gpu& gpu, Scene& scene, const View& view, const TrueGround& ground,
                                 const Style& style, RasterPath path) {
    ViewWriting writing;
    if (!has_writing(view, style)) return writing;
    ORO_TRY(const TextFace face, TextFace::open());
    if (view.vectors_read) ORO_CHECK(find_vectors(view, ground, face, writing));
    if (has_areas(view)) {
        ORO_TRY(writing.overlay.areas, area_masks(gpu, scene, view, ground, picture_options(view, path)));
    }
    writing.texts = std::move(writing.names.inked);
    if (style.labels_px > 0.0) {
        ORO_TRY(const SeenHeights seen,
                seen_heights(gpu, scene, view.camera, picture_options(view, path), ground));
        ORO_TRY(writing.labels, add_line_labels(face, seen, style, writing.names.labels, writing.texts));
    }
    if (view.graticule) ORO_CHECK(find_graticule(view, ground, face, writing));
    return writing;
}

RowSink written_rows(ViewWriting& writing, const Camera& camera, const RowSink& sink) {
    if (writing.is_empty()) return sink;
    const auto written =
        std::make_shared<InkedRows>(camera.width_px, camera.height_px, std::move(writing.texts), sink);
    const auto lined = std::make_shared<InkedRows>(
        camera.width_px, camera.height_px, std::move(writing.overlay.inked),
        [written](std::span<const std::uint8_t> row) { return written->take(row); });
    const auto filled =
        std::make_shared<InkedRows>(camera.width_px, camera.height_px, std::move(writing.overlay.areas),
                                    [lined](std::span<const std::uint8_t> row) { return lined->take(row); });
    return [filled](std::span<const std::uint8_t> row) { return filled->take(row); };
}

Result<LabelledPicture> render_labelled(const Gpu& gpu, Scene& scene, const View& view,
                                        const TrueGround& ground, const Style& style, RasterPath path,
                                        const RowSink& sink, const RenderProgress& progress) {
    ORO_TRY(ViewWriting writing, find_writing(gpu, scene, view, ground, style, path));
    const RowSink rows = written_rows(writing, view.camera, sink);
    LabelledPicture picture;
    picture.labels = std::move(writing.labels);
    picture.names = std::move(writing.names);
    picture.overlay = std::move(writing.overlay);
    PictureOptions options = picture_options(view, path);
    options.counts_near_trees = may_stand_among_trees(view, ground, style);
    if (options.counts_near_trees) ORO_CHECK(ground.health());
    ORO_TRY(picture.report, render_picture(gpu, scene, view.camera, style.frame, options, rows, progress));
    return picture;
}

}  // namespace oro
