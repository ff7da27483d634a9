#include "apps/legend/strip.h"

#include <algorithm>
#include <cmath>

namespace oro {

namespace {

std::vector<std::uint8_t> blank(int width_px, int height_px, const StripColour& paper) {
    std::vector<std::uint8_t> rgb;
    const auto pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    rgb.reserve(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) rgb.insert(rgb.end(), paper.begin(), paper.end());
    return rgb;
}

}  // namespace

Strip::Strip(int width_px, int height_px, const StripColour& paper)
    : width_px_(width_px), height_px_(height_px), rgb_(blank(width_px, height_px, paper)) {}

void Strip::mix(int x, int y, const StripColour& colour, double share) {
    if (x < 0 || y < 0 || x >= width_px_ || y >= height_px_ || share <= 0.0) return;
    std::uint8_t* const pixel =
        rgb_.data() +
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px_) + static_cast<std::size_t>(x));
    for (std::size_t c = 0; c < 3; ++c)
        pixel[c] = static_cast<std::uint8_t>(std::lround((1.0 - share) * pixel[c] + share * colour[c]));
}

void Strip::fill(glm::dvec2 corner_px, glm::dvec2 size_px,
                 const std::function<StripColour(glm::dvec2 share)>& colour) {
    const int left = static_cast<int>(std::lround(corner_px.x)),
              top = static_cast<int>(std::lround(corner_px.y));
    const int right = static_cast<int>(std::lround(corner_px.x + size_px.x)),
              bottom = static_cast<int>(std::lround(corner_px.y + size_px.y));
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x)
            mix(x, y, colour({(x + 0.5 - left) / (right - left), (y + 0.5 - top) / (bottom - top)}), 1.0);
}

void Strip::fill(glm::dvec2 corner_px, glm::dvec2 size_px, const StripColour& colour) {
    fill(corner_px, size_px, [&](glm::dvec2) { return colour; });
}

void Strip::paint(glm::dvec2 corner_px, glm::dvec2 size_px,
                  const std::function<bool(glm::dvec2 at_px)>& inside, const StripColour& colour) {
    constexpr int across = 4;
    const int right = static_cast<int>(std::ceil(corner_px.x + size_px.x)),
              bottom = static_cast<int>(std::ceil(corner_px.y + size_px.y));
    for (int y = static_cast<int>(std::floor(corner_px.y)); y < bottom; ++y)
        for (int x = static_cast<int>(std::floor(corner_px.x)); x < right; ++x) {
            int count = 0;
            for (int i = 0; i < across * across; ++i)
                count += inside({x + (i % across + 0.5) / across, y + (i / across + 0.5) / across}) ? 1 : 0;
            mix(x, y, colour, static_cast<double>(count) / (across * across));
        }
}

Result<void> Strip::write(const TextFace& face, const std::string& text, glm::dvec2 base_px, double size_px,
                          const StripColour& ink, From from) {
    if (text.empty()) return {};
    ORO_TRY(const double width_px, face.width_px(text, size_px));
    constexpr double half_capitals = 0.365;
    const glm::dvec2 middle(base_px.x + (from == From::left ? 0.5 * width_px : 0.0),
                            base_px.y - half_capitals * size_px);
    ORO_TRY(const TextMask mask, face.mask(text, {middle, 0.0, size_px, 0.0}));
    for (int y = 0; y < mask.height_px; ++y)
        for (int x = 0; x < mask.width_px; ++x)
            mix(mask.x_px + x, mask.y_px + y, ink,
                mask.ink[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width_px) +
                         static_cast<std::size_t>(x)] /
                    255.0);
    return {};
}

}  // namespace oro
