#include "apps/text/inked_rows.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace oro {
namespace {

constexpr int around_px = 5;  // how far the colour of what is around is looked for

int first_row_of(const InkedText& text) {
    return std::max(0, text.mask.y_px - around_px);
}
int end_row_of(const InkedText& text) {
    return text.mask.y_px + text.mask.height_px + around_px;
}

std::uint8_t mixed(std::uint8_t under, std::uint8_t over, std::uint8_t share) {
    return static_cast<std::uint8_t>((under * (255 - share) + over * share + 127) / 255);
}

}  // namespace

InkedRows::InkedRows(int width_px, int height_px, std::vector<InkedText> texts, Sink sink)
    : width_px_(width_px), height_px_(height_px), texts_(std::move(texts)), sink_(std::move(sink)) {
    std::ranges::stable_sort(texts_, {}, end_row_of);
    first_rows_.assign(texts_.size() + 1, height_px_);
    for (std::size_t i = texts_.size(); i > 0; --i)
        first_rows_[i - 1] = std::min(first_rows_[i], first_row_of(texts_[i - 1]));
}

// The mean of the pixels around, by the fourth power of how far they are from the ink's colour.
InkedRows::Colour InkedRows::around(int x_px, int y_px, const Colour& ink) const {
    std::array<std::uint64_t, 3> sums{};
    std::uint64_t whole = 0;
    const int last_row = first_row_ + static_cast<int>(rows_.size()) - 1;
    for (int y = std::max(first_row_, y_px - around_px); y <= std::min(last_row, y_px + around_px); ++y) {
        const std::vector<std::uint8_t>& row = rows_[static_cast<std::size_t>(y - first_row_)];
        for (int x = std::max(0, x_px - around_px); x <= std::min(width_px_ - 1, x_px + around_px); ++x) {
            const std::uint8_t* pixel = &row[3 * static_cast<std::size_t>(x)];
            std::uint64_t apart = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                const int off = pixel[i] - ink[i];
                apart += static_cast<std::uint64_t>(off * off);
            }
            const std::uint64_t weight = apart * apart;
            for (std::size_t i = 0; i < 3; ++i) sums[i] += weight * pixel[i];
            whole += weight;
        }
    }
    if (whole == 0) return ink;
    Colour mean{};
    for (std::size_t i = 0; i < 3; ++i) mean[i] = static_cast<std::uint8_t>((sums[i] + whole / 2) / whole);
    return mean;
}

void InkedRows::draw(const InkedText& inked) {
    const TextMask& text = inked.mask;
    const int top = std::max(text.y_px, first_row_), left = std::max(text.x_px, 0),
              bottom = std::min(text.y_px + text.height_px, first_row_ + static_cast<int>(rows_.size())),
              right = std::min(text.x_px + text.width_px, width_px_);
    const auto place_of = [&](int x, int y) {
        return static_cast<std::size_t>(y - text.y_px) * static_cast<std::size_t>(text.width_px) +
               static_cast<std::size_t>(x - text.x_px);
    };
    // All colours around before any of them is changed.
    std::vector<Colour> under;
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
            if (text.halo[place_of(x, y)] > 0)
                under.push_back(inked.halo ? *inked.halo : around(x, y, inked.ink));
        }
    }
    std::size_t next = 0;
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
            const std::size_t place = place_of(x, y);
            std::uint8_t* pixel =
                &rows_[static_cast<std::size_t>(y - first_row_)][3 * static_cast<std::size_t>(x)];
            const bool has_halo = text.halo[place] > 0;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint8_t ground =
                    has_halo ? mixed(pixel[i], under[next][i], text.halo[place]) : pixel[i];
                pixel[i] = mixed(ground, inked.ink[i], text.ink[place]);
            }
            next += has_halo ? 1U : 0U;
        }
    }
}

Result<void> InkedRows::hand_on(int end_row) {
    for (; first_row_ < end_row && !rows_.empty(); ++first_row_) {
        ORO_CHECK(sink_(rows_.front()));
        rows_.pop_front();
    }
    return {};
}

Result<void> InkedRows::take(std::span<const std::uint8_t> rgb) {
    assert(rgb.size() == 3 * static_cast<std::size_t>(width_px_));
    rows_.emplace_back(rgb.begin(), rgb.end());
    const int end = first_row_ + static_cast<int>(rows_.size());
    for (; drawn_ < texts_.size() && (end_row_of(texts_[drawn_]) <= end || end == height_px_); ++drawn_)
        draw(texts_[drawn_]);
    return hand_on(std::min(end, first_rows_[drawn_]));
}

}  // namespace oro
