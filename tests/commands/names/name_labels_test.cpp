// Names on a picture: none over another, the same each time, and how long they take.
#include "apps/names/name_labels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <random>

#include "apps/names/names_in_view.h"
#include "apps/text/text_face.h"
#include "core/base/elapsed.h"

namespace oro {
namespace {

constexpr int width_px = 1920, height_px = 1080;

// As peaks stand on a picture: most of them in a band around the horizon.
std::vector<SeenPoint> made_points(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x(0.0, width_px), m(500.0, 4500.0);
    std::normal_distribution<double> y(450.0, 90.0);
    std::uniform_int_distribution<int> letters(4, 22);
    std::vector<SeenPoint> points;
    for (int i = 0; i < count; ++i) {
        SeenPoint point;
        point.name = std::string(static_cast<std::size_t>(letters(random)), 'e') + " " + std::to_string(i);
        point.place_px = {x(random), std::clamp(y(random), 1.0, height_px - 1.0)};
        point.H_m = m(random);
        point.distance_m = 20.0 * m(random);
        points.push_back(std::move(point));
    }
    return points;
}

std::vector<NameLabel> labels_of(const std::vector<SeenPoint>& points, const TextFace& face) {
    auto labels = name_labels(points, width_px, height_px, [&](const std::string& text, double size_px) {
        return face.width_px(text, size_px);
    });
    EXPECT_TRUE(labels.ok());
    return std::move(*labels);
}

TEST(NameLabels, NoneTouchesAnother) {
    const auto face = TextFace::open();
    ASSERT_TRUE(face.ok());
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const std::vector<NameLabel> labels = labels_of(made_points(500, seed), *face);
        EXPECT_GT(labels.size(), 60U) << "seed " << seed;
        for (std::size_t i = 0; i < labels.size(); ++i) {
            const NameLabel& one = labels[i];
            EXPECT_GE(one.box.left, 0.0);
            EXPECT_GE(one.box.top, 0.0);
            EXPECT_LE(one.box.right, width_px);
            EXPECT_LE(one.box.bottom, height_px);
            // The line stands below (or above) the text, and ends at the point.
            EXPECT_GE(one.leader.left, one.box.left);
            EXPECT_LE(one.leader.right, one.box.right);
            EXPECT_TRUE(one.leader.bottom == one.point.place_px.y || one.leader.top == one.point.place_px.y);
            for (std::size_t j = 0; j < i; ++j) {
                const NameLabel& other = labels[j];
                EXPECT_FALSE(one.box.touches(other.box)) << seed << ": " << i << " " << j;
                EXPECT_FALSE(one.box.touches(other.leader)) << seed << ": " << i << " " << j;
                EXPECT_FALSE(one.leader.touches(other.box)) << seed << ": " << i << " " << j;
                EXPECT_FALSE(one.leader.touches(other.leader)) << seed << ": " << i << " " << j;
            }
        }
    }
}

// No ink of a name lies outside its box and its line, so that boxes that do not touch are names that do not.
TEST(NameLabels, AllInkIsInTheBox) {
    const auto face = TextFace::open();
    ASSERT_TRUE(face.ok());
    std::vector<SeenPoint> points = made_points(30, 3);
    points[0].name = "ÄÖÜ Å gjpqy Ŷ";
    points[1].name = "Çatalkaya";
    const std::vector<NameLabel> labels = labels_of(points, *face);
    const auto inked = inked_names(*face, labels);
    ASSERT_TRUE(inked.ok());
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const TextMask& mask = (*inked)[i].mask;
        const auto room = [&](int x, int y) {
            const Box pixel{x + 0.0, y + 0.0, x + 1.0, y + 1.0};
            return pixel.touches(labels[i].box) || pixel.touches(labels[i].leader);
        };
        std::size_t ink = 0;
        for (int y = 0; y < mask.height_px; ++y) {
            for (int x = 0; x < mask.width_px; ++x) {
                const auto at = static_cast<std::size_t>(y * mask.width_px + x);
                if (mask.ink[at] == 0) continue;
                ++ink;
                EXPECT_TRUE(room(mask.x_px + x, mask.y_px + y)) << labels[i].point.name;
            }
        }
        EXPECT_GT(ink, 50U);
    }
}

TEST(NameLabels, TheFirstStandsNearestToItsPoint) {
    const auto face = TextFace::open();
    ASSERT_TRUE(face.ok());
    std::vector<SeenPoint> points(2);
    points[0].name = "Eiger", points[0].place_px = {900.0, 500.0}, points[0].H_m = 3967.4;
    points[0].distance_m = 4230.0;
    points[1].name = "Mönch", points[1].place_px = {910.0, 502.0};
    const std::vector<NameLabel> labels = labels_of(points, *face);
    ASSERT_EQ(labels.size(), 2U);
    EXPECT_EQ(labels[0].heights, "3967 m  4.2 km");
    EXPECT_EQ(labels[1].heights, "0 m  0 m");
    EXPECT_NEAR(labels[0].box.bottom, 500.0 - 0.9 * 15.0, 1e-9);  // of 15 px, 1/72 of the picture's height
    EXPECT_EQ(name_size_px(height_px), 15.0);
    EXPECT_EQ(heights_words(812.6, 999.4), "813 m  999 m");
    EXPECT_EQ(heights_words(-3.2, 45678.0), "-3 m  46 km");
}

TEST(NameLabels, AreTheSameEachTimeAndQuick) {
    const auto face = TextFace::open();
    ASSERT_TRUE(face.ok());
    const std::vector<SeenPoint> points = made_points(500, 11);
    std::vector<NameLabel> first = labels_of(points, *face);
    const auto before = inked_names(*face, first);
    std::vector<NameLabel> again;
    Result<std::vector<InkedText>> inked = before;
    double placed_s = 1e9, all_s = 1e9;
    for (int i = 0; i < 10; ++i) {
        const auto start = Clock::now();
        again = labels_of(points, *face);
        const double so_far_s = seconds_since(start);
        inked = inked_names(*face, again);
        placed_s = std::min(placed_s, so_far_s);
        all_s = std::min(all_s, seconds_since(start));
    }
    std::cout << "500 names at 1920x1080: " << again.size() << " have room; placed in " << 1e3 * placed_s
              << " ms, with their pixels " << 1e3 * all_s << " ms (the best of ten)\n";
    ASSERT_EQ(first.size(), again.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(first[i].box.left, again[i].box.left);
        EXPECT_EQ(first[i].box.top, again[i].box.top);
        EXPECT_EQ((*before)[i].mask.ink, (*inked)[i].mask.ink);
    }
}

}  // namespace
}  // namespace oro
