// Text as pixels: its length, its place, its angle, its halo, and what it does to a picture's rows.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "apps/text/inked_rows.h"
#include "apps/text/text_face.h"

namespace oro {
namespace {

TextFace face() {
    auto opened = TextFace::open();
    EXPECT_TRUE(opened.ok());
    return std::move(*opened);
}

std::uint8_t at(const TextMask& mask, const std::vector<std::uint8_t>& values, int x, int y) {
    if (x < mask.x_px || y < mask.y_px || x >= mask.x_px + mask.width_px || y >= mask.y_px + mask.height_px)
        return 0;
    return values[static_cast<std::size_t>((y - mask.y_px) * mask.width_px + x - mask.x_px)];
}

// Where ink lies in the middle of all, and how much of it there is, in pixels.
struct Ink {
    glm::dvec2 middle{0.0};
    double area{};
};
Ink ink_of(const TextMask& mask) {
    Ink ink;
    for (int y = 0; y < mask.height_px; ++y) {
        for (int x = 0; x < mask.width_px; ++x) {
            const double share = mask.ink[static_cast<std::size_t>(y * mask.width_px + x)] / 255.0;
            ink.middle += share * glm::dvec2(mask.x_px + x + 0.5, mask.y_px + y + 0.5);
            ink.area += share;
        }
    }
    ink.middle /= ink.area;
    return ink;
}

// DejaVu Sans 2.37: figures are 1303 of 2048 units wide (its hmtx table).
TEST(TextFace, FiguresAreAsWideAsTheFontSays) {
    const TextFace text = face();
    EXPECT_NEAR(*text.width_px("2500", 11.0), 4.0 * 1303.0 / 2048.0 * 11.0, 1e-9);
    EXPECT_NEAR(*text.width_px("Säntis", 20.0), 2.0 * *text.width_px("Säntis", 10.0), 1e-9);
    EXPECT_EQ(*text.width_px("", 11.0), 0.0);
    const auto broken = text.width_px("\xff\xfe", 11.0);
    ASSERT_FALSE(broken.ok());
    EXPECT_NE(broken.error().line().find("UTF-8"), std::string::npos);
}

// A zero is symmetric: its ink lies around the place it was put at, at any angle and between pixels.
TEST(TextFace, StandsWhereItIsPut) {
    const TextFace text = face();
    const double upright = ink_of(*text.mask("0", {{100.0, 50.0}, 0.0, 30.0, 0.0})).area;
    for (const double angle_deg : {0.0, 17.0, 45.0, 90.0, -30.0, 180.0, 251.0}) {
        for (const glm::dvec2 middle : {glm::dvec2(100.0, 50.0), glm::dvec2(-3.25, 7.6)}) {
            const Ink ink = ink_of(*text.mask("0", {middle, angle_deg, 30.0, 0.0}));
            EXPECT_LT(glm::length(ink.middle - middle), 0.1) << angle_deg;
            EXPECT_NEAR(ink.area, upright, 0.02 * upright) << angle_deg;
        }
    }
}

// The second of two letters lies in the direction of the angle: clockwise, y downwards.
TEST(TextFace, RunsAlongItsAngle) {
    const TextFace text = face();
    for (const double angle_deg : {0.0, 30.0, 90.0, -60.0, 135.0}) {
        const double radians = angle_deg * std::numbers::pi / 180.0;
        const glm::dvec2 along(std::cos(radians), std::sin(radians));
        const Ink both = ink_of(*text.mask("0.", {{60.0, 60.0}, angle_deg, 24.0, 0.0}));
        const Ink dot = ink_of(*text.mask(" .", {{60.0, 60.0}, angle_deg, 24.0, 0.0}));
        EXPECT_GT(glm::dot(dot.middle - both.middle, along), 4.0) << angle_deg;
        // The dot stands on the base line, below the middle.
        EXPECT_GT(glm::dot(dot.middle - glm::dvec2(60.0), glm::dvec2(-along.y, along.x)), 5.0) << angle_deg;
    }
}

TEST(TextFace, AHaloReachesAsFarAsItSays) {
    const TextFace text = face();
    const TextMask mask = *text.mask("1", {{50.5, 50.5}, 20.0, 36.0, 3.0});
    double farthest = 0.0;
    for (int y = 20; y < 80; ++y) {
        for (int x = 20; x < 80; ++x) {
            EXPECT_GE(at(mask, mask.halo, x, y) + 1, at(mask, mask.ink, x, y));
            if (at(mask, mask.halo, x, y) < 128) continue;
            double nearest = 99.0;
            for (int v = y - 6; v <= y + 6; ++v) {
                for (int u = x - 6; u <= x + 6; ++u) {
                    if (at(mask, mask.ink, u, v) >= 128)
                        nearest = std::min(nearest, std::hypot(u - x, v - y));
                }
            }
            farthest = std::max(farthest, nearest);
        }
    }
    EXPECT_NEAR(farthest, 3.0, 1.05) << "from a pixel to a pixel, each half in and half out";
}

// A line of the ink's colour is interrupted, the ground goes on in its own colour, and what is not near the
// text stays.
TEST(InkedRows, InterruptALineAndKeepTheGround) {
    constexpr int width = 80, height = 60;
    const InkedRows::Colour ink{150, 97, 58};
    const auto ground = [](int x, int y, std::size_t i) {
        return static_cast<std::uint8_t>(200 + x / 4 + y / 4 - 10 * static_cast<int>(i));
    };
    const auto is_line = [](int y) { return y == 29 || y == 30; };
    const TextFace text = face();
    const TextMask mask = *text.mask("15", {{40.0, 30.0}, 0.0, 26.0, 3.0});
    std::vector<std::vector<std::uint8_t>> rows;
    InkedRows inked(width, height, {{mask, ink, {}}}, [&](std::span<const std::uint8_t> row) {
        rows.emplace_back(row.begin(), row.end());
        return Result<void>();
    });
    for (int y = 0; y < height; ++y) {
        std::vector<std::uint8_t> row;
        for (int x = 0; x < width; ++x) {
            for (std::size_t i = 0; i < 3; ++i) row.push_back(is_line(y) ? ink[i] : ground(x, y, i));
        }
        ASSERT_TRUE(inked.take(row).ok());
    }
    ASSERT_EQ(rows.size(), static_cast<std::size_t>(height)) << "all rows are handed on";
    int inside = 0, written = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::uint8_t halo = at(mask, mask.halo, x, y), figure = at(mask, mask.ink, x, y);
            for (std::size_t i = 0; i < 3; ++i) {
                const int shown = rows[static_cast<std::size_t>(y)][3 * static_cast<std::size_t>(x) + i];
                if (halo == 0) {
                    EXPECT_EQ(shown, is_line(y) ? ink[i] : ground(x, y, i)) << x << ", " << y;
                } else if (halo == 255 && figure == 0) {
                    EXPECT_NEAR(shown, ground(x, y, i), 4) << x << ", " << y;
                    inside += is_line(y) ? 1 : 0;
                } else if (figure == 255) {
                    EXPECT_EQ(shown, ink[i]);
                    ++written;
                }
            }
        }
    }
    EXPECT_GT(inside, 15) << "of the line, below the halo";
    EXPECT_GT(written, 20);
}

// Whatever comes first is written: nothing is kept but the rows that a text still needs.
TEST(InkedRows, HandOnRowsThatNoTextNeeds) {
    int handed_on = 0;
    const TextFace text = face();
    InkedRows inked(40, 200, {{*text.mask("7", {{20.0, 150.0}, 0.0, 11.0, 2.0}), {}, {}}},
                    [&](std::span<const std::uint8_t>) {
                        ++handed_on;
                        return Result<void>();
                    });
    const std::vector<std::uint8_t> row(120, 255);
    for (int y = 0; y < 100; ++y) ASSERT_TRUE(inked.take(row).ok());
    EXPECT_EQ(handed_on, 100);
    for (int y = 100; y < 150; ++y) ASSERT_TRUE(inked.take(row).ok());
    EXPECT_LT(handed_on, 150);
    for (int y = 150; y < 200; ++y) ASSERT_TRUE(inked.take(row).ok());
    EXPECT_EQ(handed_on, 200);
}

}  // namespace
}  // namespace oro
