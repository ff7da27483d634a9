#include "apps/names/names_in_view.h"

#include <algorithm>
#include <cmath>

namespace oro {
namespace {

constexpr double leader_width_share = 0.09;  // of the em
constexpr double thinnest_leader_px = 1.2;

TextMask empty_mask(const Box& box) {
    TextMask mask;
    mask.x_px = static_cast<int>(std::floor(box.left)) - 1;
    mask.y_px = static_cast<int>(std::floor(box.top)) - 1;
    mask.width_px = static_cast<int>(std::ceil(box.right)) + 1 - mask.x_px;
    mask.height_px = static_cast<int>(std::ceil(box.bottom)) + 1 - mask.y_px;
    const auto pixels = static_cast<std::size_t>(mask.width_px) * static_cast<std::size_t>(mask.height_px);
    mask.ink.resize(pixels);
    mask.halo.resize(pixels);
    return mask;
}

// Covers pixels by the share of them that lies in a box.
void fill(const Box& box, std::vector<std::uint8_t> TextMask::*which, TextMask& mask) {
    const auto share = [](double pixel, double begin, double end) {
        return std::clamp(std::min(pixel + 1.0, end) - std::max(pixel, begin), 0.0, 1.0);
    };
    const auto first = [](double begin, int least) {
        return std::max(least, static_cast<int>(std::floor(begin)));
    };
    const int right = std::min(mask.x_px + mask.width_px, static_cast<int>(std::ceil(box.right))),
              bottom = std::min(mask.y_px + mask.height_px, static_cast<int>(std::ceil(box.bottom)));
    for (int y = first(box.top, mask.y_px); y < bottom; ++y) {
        const double high = share(y, box.top, box.bottom);
        for (int x = first(box.left, mask.x_px); x < right; ++x) {
            std::uint8_t& to =
                (mask.*
                 which)[static_cast<std::size_t>(y - mask.y_px) * static_cast<std::size_t>(mask.width_px) +
                        static_cast<std::size_t>(x - mask.x_px)];
            const long cover = std::lround(255.0 * high * share(x, box.left, box.right));
            to = std::max(to, static_cast<std::uint8_t>(cover));
        }
    }
}

}  // namespace

Result<std::vector<InkedText>> inked_names(const TextFace& face, const std::vector<NameLabel>& labels) {
    std::vector<InkedText> texts;
    for (const NameLabel& label : labels) {
        const double em = label.size_px, small = heights_share * em, halo = name_halo_share * em;
        const Box all{std::min(label.box.left, label.leader.left), std::min(label.box.top, label.leader.top),
                      std::max(label.box.right, label.leader.right),
                      std::max(label.box.bottom, label.leader.bottom)};
        TextMask mask = empty_mask(all);
        ORO_CHECK(face.add_level(label.point.name, {label.name_px, 0.0, em, halo}, mask));
        ORO_CHECK(face.add_level(label.heights, {label.heights_px, 0.0, small, halo}, mask));
        const double at = label.point.place_px.x,
                     half = 0.5 * std::max(thinnest_leader_px, leader_width_share * em);
        fill(label.leader, &TextMask::halo, mask);
        fill({at - half, label.leader.top, at + half, label.leader.bottom}, &TextMask::ink, mask);
        texts.push_back({std::move(mask), name_ink, name_halo});
    }
    return texts;
}

}  // namespace oro
