// Lines and their labels on made ground whose contours are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "apps/labels/line_labels.h"

namespace oro {
namespace {

constexpr double size_px = 11.0;

// Ground seen straight down: H by pixel.
SeenHeights seen(int width_px, int height_px, const std::function<double(double, double)>& H_m) {
    Camera camera;
    camera.width_px = width_px;
    camera.height_px = height_px;
    SeenHeights heights = no_heights(camera);
    for (int row = 0; row < heights.rows; ++row) {
        for (int column = 0; column < heights.columns; ++column) {
            const glm::dvec2 place = heights.place_px(column, row);
            heights.H_m[heights.at(column, row)] = static_cast<float>(H_m(place.x, place.y));
            heights.far_m[heights.at(column, row)] = 1000.0F;
        }
    }
    return heights;
}

std::vector<LineLabel> labels_on(const SeenHeights& heights, double interval_m) {
    auto labels = line_labels(heights, interval_m, size_px, [](const std::string& text) {
        return Result<double>(7.0 * static_cast<double>(text.size()));
    });
    EXPECT_TRUE(labels.ok());
    return *labels;
}

// A cone with its top in the middle: lines are circles.
double cone_m(double x, double y) {
    return 1000.0 - 2.0 * std::hypot(x - 300.0, y - 300.0);
}

TEST(ContourLines, OfAConeAreCircles) {
    const SeenHeights heights = seen(600, 600, cone_m);
    std::set<double> found_m;
    for (const ContourLine& line : contour_lines(heights, 100.0)) {
        found_m.insert(line.H_m);
        const double radius_px = (1000.0 - line.H_m + 0.01) / 2.0;
        for (const glm::dvec2& point : line.points_px)
            EXPECT_NEAR(glm::length(point - glm::dvec2(300.0)), radius_px, 0.05) << line.H_m;
        // Within the picture they close.
        if (radius_px < 299.0) {
            EXPECT_EQ(line.points_px.front(), line.points_px.back()) << line.H_m;
            EXPECT_GT(static_cast<double>(line.points_px.size()), 5.6 * radius_px) << line.H_m;
        }
    }
    EXPECT_EQ(found_m, (std::set<double>{200.0, 300.0, 400.0, 500.0, 600.0, 700.0, 800.0, 900.0}));
}

// At a pass two lines come near each other and do not cross: each point is used once.
TEST(ContourLines, OfAPassGoOnToBothSides) {
    for (const double lift_m : {-0.4, 0.0, 0.4}) {
        const SeenHeights heights = seen(201, 201, [&](double x, double y) {
            return 100.0 + lift_m + ((x - 100.3) * (x - 100.3) - (y - 100.3) * (y - 100.3)) / 50.0;
        });
        int of_pass = 0;
        for (const ContourLine& line : contour_lines(heights, 50.0)) {
            if (line.H_m != 100.0) continue;
            ++of_pass;
            EXPECT_GT(line.points_px.size(), 150U);
            for (std::size_t i = 1; i < line.points_px.size(); ++i)
                EXPECT_LE(glm::length(line.points_px[i] - line.points_px[i - 1]), 1.5);
        }
        EXPECT_EQ(of_pass, 2);
    }
}

// Figures run along their circle, within 1 degree; tops are uphill, towards the middle, which on a cone
// leaves its lower half: above the middle they would stand on their heads.
TEST(LineLabels, RunAlongTheirLineWithTheTopUphill) {
    const std::vector<LineLabel> labels = labels_on(seen(600, 600, cone_m), 20.0);
    ASSERT_GE(labels.size(), 6U);
    for (const LineLabel& label : labels) {
        if (label.H_m <= 400.0)
            continue;  // these leave the picture, and have parts in its upper corners alone
        const glm::dvec2 to_top = glm::dvec2(300.0) - label.middle_px;
        const double radians = label.angle_deg * std::numbers::pi / 180.0;
        const glm::dvec2 up(std::sin(radians), -std::cos(radians));
        EXPECT_TRUE(label.top_is_uphill);
        EXPECT_GT(glm::dot(glm::normalize(to_top), up), std::cos(std::numbers::pi / 180.0)) << label.text;
        EXPECT_GE(label.middle_px.y, 300.0) << label.text;
        EXPECT_LE(std::abs(label.angle_deg), 90.0);
        EXPECT_NEAR(glm::length(to_top), (1000.0 - label.H_m) / 2.0, 0.1);
        EXPECT_EQ(label.text, std::to_string(std::lround(label.H_m)));
        EXPECT_EQ(std::fmod(label.H_m, 100.0), 0.0) << "every fifth line";
    }
}

// A slope that falls away from the reader has no place where tops uphill can be read: figures are turned.
TEST(LineLabels, AreTurnedWhereAllOfALineFallsAway) {
    for (const double towards : {1.0, -1.0}) {
        const SeenHeights heights =
            seen(500, 400, [&](double, double y) { return 1000.0 + towards * 2.0 * y + 0.7; });
        const std::vector<LineLabel> labels = labels_on(heights, 20.0);
        ASSERT_FALSE(labels.empty());
        for (const LineLabel& label : labels) {
            EXPECT_NEAR(label.angle_deg, 0.0, 1e-6);
            EXPECT_EQ(label.top_is_uphill, towards < 0.0);
        }
    }
}

TEST(LineLabels, KeepFromTheBorderAndFromEachOther) {
    const SeenHeights heights = seen(900, 700, [](double x, double y) {
        return 500.0 + 60.0 * std::sin(x / 90.0) + 80.0 * std::cos(y / 70.0) + 0.5 * y;
    });
    const std::vector<LineLabel> labels = labels_on(heights, 5.0);
    ASSERT_GE(labels.size(), 10U);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const LineLabel& one = labels[i];
        EXPECT_GE(
            std::min({one.middle_px.x, one.middle_px.y, 900.0 - one.middle_px.x, 700.0 - one.middle_px.y}),
            1.5 * size_px);
        for (std::size_t k = i + 1; k < labels.size(); ++k) {
            const double apart_px = glm::length(one.middle_px - labels[k].middle_px);
            EXPECT_GE(apart_px, (one.text == labels[k].text ? 20.0 : 8.0) * size_px) << i << ", " << k;
        }
    }
}

// Two planes, the farther one seen over the edge of the nearer: H is the same on both sides of the edge, so
// a line of heights alone would go on; the ground does not.
TEST(LineLabels, AreNotWrittenAcrossAnEdge) {
    SeenHeights heights = seen(400, 300, [](double, double y) { return 1500.0 - 3.0 * y; });
    for (int row = 0; row < heights.rows; ++row) {
        for (int column = 200; column < heights.columns; ++column)
            heights.far_m[heights.at(column, row)] = 1100.0F;
    }
    const std::vector<LineLabel> labels = labels_on(heights, 30.0);
    ASSERT_FALSE(labels.empty());
    for (const LineLabel& label : labels)
        EXPECT_GE(std::abs(label.middle_px.x - 200.0), 0.5 * label.length_px + 0.4 * size_px - 1.0);
    for (const ContourLine& line : contour_lines(heights, 150.0)) {
        const auto [left, right] = std::ranges::minmax(line.points_px, {}, &glm::dvec2::x);
        EXPECT_FALSE(left.x < 199.0 && right.x > 201.0) << "a line goes on over the edge";
    }
}

TEST(LineLabels, AreNotWrittenInACrowd) {
    // Lines 4 px apart: figures would cover their neighbours.
    EXPECT_TRUE(labels_on(seen(400, 300, [](double, double y) { return 1500.0 - 5.0 * y; }), 20.0).empty());
    // Fifth lines between whole metres have no number that is true.
    const SeenHeights gentle = seen(400, 300, [](double, double y) { return 10.0 - 0.02 * y; });
    const std::vector<LineLabel> labels = labels_on(gentle, 0.3);
    EXPECT_FALSE(labels.empty());
    for (const LineLabel& label : labels) EXPECT_NEAR(std::fmod(label.H_m, 3.0), 0.0, 1e-9) << label.text;
}

}  // namespace
}  // namespace oro
