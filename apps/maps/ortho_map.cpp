#include "apps/maps/ortho_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "apps/labels/labelled_picture.h"
#include "core/base/parallel.h"
#include "core/base/srgb.h"

namespace oro {
namespace {

constexpr int square_px = 512;

// As many samples a pixel as were asked for at least, 2 x 2 or more: so much finer is the picture from afar.
int finer_by(int samples) {
    return std::max(2, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(samples)) - 1.0e-9)));
}

std::array<float, 256> linear_lights() {
    std::array<float, 256> lights{};
    for (std::size_t i = 0; i < lights.size(); ++i) {
        lights[i] = static_cast<float>(light_of_srgb(static_cast<double>(i) / 255.0));
    }
    return lights;
}
std::uint8_t code_of(double light) {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(srgb_of_light(light), 0.0, 1.0)));
}

// A drawn picture, to be asked for light between its pixels.
class Drawn {
  public:
    Drawn(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {
        rgb_.reserve(std::size_t{3} * static_cast<std::size_t>(width_px) *
                     static_cast<std::size_t>(height_px));
    }
    void take(std::span<const std::uint8_t> row) { rgb_.insert(rgb_.end(), row.begin(), row.end()); }

    // Linear light, bilinear between the middles of pixels.
    [[nodiscard]] glm::dvec3 light_at(const glm::dvec2& at_px) const {
        static const std::array<float, 256> lights = linear_lights();
        const double x = std::clamp(at_px.x - 0.5, 0.0, width_px_ - 1.001),
                     y = std::clamp(at_px.y - 0.5, 0.0, height_px_ - 1.001);
        const int column = static_cast<int>(x), row = static_cast<int>(y);
        const double right = x - column, down = y - row;
        glm::dvec3 sum(0.0);
        for (int i = 0; i < 4; ++i) {
            const double share = (i % 2 == 0 ? 1.0 - right : right) * (i / 2 == 0 ? 1.0 - down : down);
            const std::size_t at =
                3 * (static_cast<std::size_t>(row + i / 2) * static_cast<std::size_t>(width_px_) +
                     static_cast<std::size_t>(column + i % 2));
            sum += share * glm::dvec3(static_cast<double>(lights[rgb_[at]]),
                                      static_cast<double>(lights[rgb_[at + 1]]),
                                      static_cast<double>(lights[rgb_[at + 2]]));
        }
        return sum;
    }

  private:
    int width_px_, height_px_;
    std::vector<std::uint8_t> rgb_;
};

// Light comes from one direction over a map whose terrain casts shadows, or they would break where squares
// meet; else from the same side of every place.
void aim_light(const View& view, const Geodetic& eye, gpu::FrameStyle& style) {
    if (style.shadows == 0) return;
    const Geodetic& middle = view.camera.eye;
    const glm::dvec3 sun = ecef_from_enu(middle.lat_deg, middle.lon_deg) * glm::dvec3(style.sun_enu);
    style.sun_enu = gpu::vec3(glm::transpose(ecef_from_enu(eye.lat_deg, eye.lon_deg)) * sun);
}

// Draws a square's picture and lays its pixels into a band of the map's rows.
class SquarePainter {
  public:
    SquarePainter(const Gpu& gpu, Scene& scene, const View& view, const Style& style, RasterPath path)
        : gpu_(gpu), scene_(scene), view_(view), style_(style), finer_(finer_by(view.samples)) {
        options_ = picture_options(view, path);
        options_.samples = 1;
        options_.tau_px *= finer_;
        options_.model = {};
        // As wide on the map as on a picture.
        style_.frame.contours.width_px *= static_cast<float>(finer_);
        style_.frame.smooth_edges = 0;
    }
    [[nodiscard]] int finer() const { return finer_; }

    Result<void> paint(const MapSquare& square, int map_width_px, std::vector<std::uint8_t>& band,
                       PictureReport& report) {
        if (square.camera.width_px == 0) return {};
        gpu::FrameStyle style = style_.frame;
        aim_light(view_, square.camera.eye, style);
        Drawn drawn(square.camera.width_px, square.camera.height_px);
        ORO_TRY(PictureReport part, render_picture(gpu_, scene_, square.camera, style, options_,
                                                   [&](std::span<const std::uint8_t> row) {
                                                       return drawn.take(row), Result<void>();
                                                   }));
        part.ground_px = 0;  // the map's own pixels are counted, not those of what it is made of
        report.add(part);
        in_parallel(square.height_px, thread_count(), [&](int y) {
            for (int x = 0; x < square.width_px; ++x) {
                const std::size_t i = square.number(x, y);
                if (!square.ground[i]) continue;
                const glm::dvec3 light = light_of(square, drawn, square.at_px[i]);
                std::uint8_t* const to =
                    band.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(map_width_px) +
                                       static_cast<std::size_t>(square.x_px + x));
                for (int c = 0; c < 3; ++c) to[c] = code_of(light[c]);
                to[3] = 255;
            }
        });
        return {};
    }

  private:
    [[nodiscard]] glm::dvec3 light_of(const MapSquare& square, const Drawn& drawn,
                                      const glm::dvec2& at_px) const {
        glm::dvec3 sum(0.0);
        for (int j = 0; j < finer_; ++j)
            for (int i = 0; i < finer_; ++i)
                sum += drawn.light_at(at_px + ((i + 0.5) / finer_ - 0.5) * square.right_px +
                                      ((j + 0.5) / finer_ - 0.5) * square.down_px);
        return sum / static_cast<double>(finer_ * finer_);
    }

    const Gpu& gpu_;
    Scene& scene_;
    const View& view_;
    Style style_;
    int finer_;
    PictureOptions options_;
};

}  // namespace

Result<PictureReport> draw_map(const Gpu& gpu, Scene& scene, const View& view, const TrueGround& ground,
                               const Style& style, RasterPath path, const MapRowSink& sink,
                               const RenderProgress& progress) {
    const MapFrame& map = *view.map;
    ORO_TRY(MapPlaces places, MapPlaces::of(map));
    SquarePainter painter(gpu, scene, view, style, path);
    PictureReport report;
    report.path = path;
    const std::size_t row_bytes = std::size_t{4} * static_cast<std::size_t>(map.width_px);
    for (int y = 0; y < map.height_px; y += square_px) {
        const int rows = std::min(square_px, map.height_px - y);
        std::vector<std::uint8_t> band(row_bytes * static_cast<std::size_t>(rows));
        for (int x = 0; x < map.width_px; x += square_px) {
            MapSquare where;
            where.x_px = x;
            where.y_px = y;
            where.width_px = std::min(square_px, map.width_px - x);
            where.height_px = rows;
            const MapSquare square =
                map_square(where, places, ground, view.sea == Sea::voids, painter.finer());
            ORO_CHECK(painter.paint(square, map.width_px, band, report));
            if (progress)
                progress((y + rows * std::min(1.0, static_cast<double>(x + square_px) / map.width_px)) /
                         map.height_px);
        }
        // What could not be read counted as void.
        ORO_CHECK(ground.health());
        for (int i = 0; i < rows; ++i) {
            const auto row = std::span<const std::uint8_t>(band).subspan(
                static_cast<std::size_t>(i) * row_bytes, row_bytes);
            for (std::size_t at = 3; at < row.size(); at += 4) report.ground_px += row[at] != 0;
            ORO_CHECK(sink(row));
        }
    }
    return report;
}

}  // namespace oro
