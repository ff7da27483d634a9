// What is left of a grid where others lie over it: every place once, no gap, walls as high as the step is.
#include "geo/together/grid_clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/test_data.h"

namespace oro {
namespace {

GridAxis axis(double first_deg, double posts_per_deg, int step, int count) {
    return {posts_per_deg, first_deg, 0, step, count};
}

HeightField waves(PostGrid grid, double base_m) {
    HeightField field;
    field.grid = std::move(grid);
    for (int row = 0; row < field.grid.rows(); ++row) {
        for (int column = 0; column < field.grid.columns(); ++column) {
            const PostPlace at = field.grid.place_at(row, column);
            field.H_m.push_back(static_cast<float>(base_m + 200.0 * std::sin(300.0 * at.lat_deg) *
                                                                std::cos(200.0 * at.lon_deg)));
        }
    }
    return field;
}
HeightField on_degrees(double north_deg, double west_deg, double posts_per_deg, int rows, int columns,
                       double base_m) {
    return waves({axis(north_deg, posts_per_deg, -1, rows), axis(west_deg, posts_per_deg, 1, columns), {}},
                 base_m);
}

// A grid that is turned by an angle: posts every so many metres on the plane that touches the Earth at its
// middle.
HeightField turned(double lat_deg, double lon_deg, double turn_deg, double post_m, int rows, int columns,
                   double base_m) {
    const double turn = turn_deg * std::numbers::pi / 180.0;
    const double metre_deg = 1.0 / 111'200.0, cosine = std::cos(lat_deg * std::numbers::pi / 180.0);
    const auto net = LatticeGeoreference::fit(
        rows, columns, [&](std::span<const PostNumber> posts, std::span<PostPlace> places) -> Result<void> {
            for (std::size_t i = 0; i < posts.size(); ++i) {
                const double right = (posts[i].column - 0.5 * (columns - 1)) * post_m,
                             down = (posts[i].row - 0.5 * (rows - 1)) * post_m;
                const double east = std::cos(turn) * right + std::sin(turn) * down,
                             north = std::sin(turn) * right - std::cos(turn) * down;
                places[i] = {lat_deg + north * metre_deg, lon_deg + east * metre_deg / cosine};
            }
            return {};
        });
    EXPECT_TRUE(net.ok());
    return waves(grid_on_net(net.value()), base_m);
}

void make_holes(HeightField& field, std::mt19937& random, int count, int side) {
    for (int i = 0; i < count; ++i) {
        const int row = static_cast<int>(random() % static_cast<unsigned>(field.grid.rows())),
                  column = static_cast<int>(random() % static_cast<unsigned>(field.grid.columns()));
        for (int r = row; r < std::min(row + side, field.grid.rows()); ++r)
            for (int c = column; c < std::min(column + side, field.grid.columns()); ++c)
                field.H_m[static_cast<std::size_t>(r * field.grid.columns() + c)] = void_height_m;
    }
}

struct At {
    double x, y, H_m;
};
At at(const HeightField& field, const SeamPoint& point) {
    At sum{};
    for (std::size_t i = 0; i < 3; ++i) {
        const GridPost post = point.posts[i];
        sum.x += point.shares[i] * post.column;
        sum.y += point.shares[i] * post.row;
        if (point.shares[i] != 0.0) sum.H_m += point.shares[i] * field.H_at_post_m(post.row, post.column);
    }
    return sum;
}

double side(const At& a, const At& b, double x, double y) {
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}
bool holds(const std::array<At, 3>& triangle, double x, double y) {
    const double s[3] = {side(triangle[0], triangle[1], x, y), side(triangle[1], triangle[2], x, y),
                         side(triangle[2], triangle[0], x, y)};
    return (s[0] >= 0.0 && s[1] >= 0.0 && s[2] >= 0.0) || (s[0] <= 0.0 && s[1] <= 0.0 && s[2] <= 0.0);
}

// H of the plane through three corners.
double H_in(const std::array<At, 3>& triangle, double x, double y) {
    return (side(triangle[1], triangle[2], x, y) * triangle[0].H_m +
            side(triangle[2], triangle[0], x, y) * triangle[1].H_m +
            side(triangle[0], triangle[1], x, y) * triangle[2].H_m) /
           side(triangle[0], triangle[1], triangle[2].x, triangle[2].y);
}

class Scene {
  public:
    Scene(HeightField field, std::vector<HeightField> over)
        : field_(std::move(field)), over_(std::move(over)) {
        std::vector<const HeightField*> all;
        for (const HeightField& one : over_) all.push_back(&one);
        Result<GridClip> cut = clip_by_finer(field_, all);
        EXPECT_TRUE(cut.ok()) << (cut.ok() ? "" : cut.error().line());
        if (cut.ok()) cut_ = std::move(cut).value();
        for (const SeamTriangle& piece : cut_.ground) {
            pieces_.push_back(
                {at(field_, piece.points[0]), at(field_, piece.points[1]), at(field_, piece.points[2])});
            // Anticlockwise seen from above: y goes down.
            EXPECT_LT(side(pieces_.back()[0], pieces_.back()[1], pieces_.back()[2].x, pieces_.back()[2].y),
                      0.0);
        }
    }
    [[nodiscard]] const GridClip& cut() const { return cut_; }
    [[nodiscard]] bool is_covered(double x, double y) const {
        const PostPlace place = field_.grid.place_at(y, x);
        return std::any_of(over_.begin(), over_.end(), [&](const HeightField& over) {
            return over.surface_H_m(place.lat_deg, place.lon_deg).has_value();
        });
    }
    // The three posts of the triangle of a place.
    [[nodiscard]] std::array<GridPost, 3> triangle_at(double x, double y) const {
        const int row = static_cast<int>(y), column = static_cast<int>(x);
        if (y - row > x - column) return {{{row, column}, {row + 1, column}, {row + 1, column + 1}}};
        return {{{row, column}, {row + 1, column + 1}, {row, column + 1}}};
    }
    [[nodiscard]] bool is_there(const std::array<GridPost, 3>& posts) const {
        return std::none_of(posts.begin(), posts.end(), [&](GridPost post) {
            return is_void(field_.H_at_post_m(post.row, post.column));
        });
    }
    [[nodiscard]] bool is_kept(const std::array<GridPost, 3>& posts) const {
        return is_there(posts) && std::none_of(posts.begin(), posts.end(), [&](GridPost post) {
                   return cut_.masked_posts[static_cast<std::size_t>(post.row * field_.grid.columns() +
                                                                     post.column)] != 0;
               });
    }
    // How many random places are not on exactly one surface.
    [[nodiscard]] int wrong_places(std::mt19937& random, int count) const;
    void expect_no_gap() const;
    void expect_walls_as_high_as_steps() const;

  private:
    HeightField field_;
    std::vector<HeightField> over_;
    GridClip cut_;
    std::vector<std::array<At, 3>> pieces_;
};

int Scene::wrong_places(std::mt19937& random, int count) const {
    std::uniform_real_distribution<double> rows(0.0, field_.grid.rows() - 1.0),
        columns(0.0, field_.grid.columns() - 1.0);
    int wrong = 0;
    for (int i = 0; i < count; ++i) {
        const double y = rows(random), x = columns(random);
        const auto posts = triangle_at(x, y);
        if (!is_there(posts)) continue;
        int surfaces = (is_covered(x, y) ? 1 : 0) + (is_kept(posts) ? 1 : 0);
        for (const std::array<At, 3>& piece : pieces_) {
            if (!holds(piece, x, y)) continue;
            ++surfaces;
            // A cell of which a post is left out falls.
            std::array<At, 3> whole{};
            for (std::size_t k = 0; k < 3; ++k)
                whole[k] = {static_cast<double>(posts[k].column), static_cast<double>(posts[k].row),
                            static_cast<double>(field_.H_at_post_m(posts[k].row, posts[k].column))};
            EXPECT_NEAR(H_in(piece, x, y), H_in(whole, x, y), 1.0e-3) << "a piece at " << x << ", " << y;
        }
        if (surfaces != 1) {
            if (++wrong <= 5) std::printf("%d surfaces at column %.9f, row %.9f\n", surfaces, x, y);
        }
    }
    return wrong;
}

using Corner = std::pair<long long, long long>;
Corner corner(const At& point) {
    return {std::llround(point.x * 2.0e6), std::llround(point.y * 2.0e6)};
}

// Each side of a piece is that of a piece beside it, of a triangle that is kept, the foot of a wall, or where
// the grid ends.
void Scene::expect_no_gap() const {
    std::multiset<std::pair<Corner, Corner>> pieces, walls;
    for (const auto& piece : pieces_)
        for (std::size_t i = 0; i < 3; ++i) pieces.insert({corner(piece[i]), corner(piece[(i + 1) % 3])});
    for (const SeamWall& wall : cut_.walls)
        walls.insert({corner(at(field_, wall.cut[0])), corner(at(field_, wall.cut[1]))});
    int open = 0;
    for (const auto& piece : pieces_) {
        for (std::size_t i = 0; i < 3; ++i) {
            const At &a = piece[i], &b = piece[(i + 1) % 3];
            const std::pair<Corner, Corner> way{corner(a), corner(b)}, back{corner(b), corner(a)};
            EXPECT_EQ(pieces.count(way), 1U);
            if (pieces.count(back) == 1 || walls.count(way) == 1 || walls.count(back) == 1) continue;
            // A little to the outside, which is on the right hand of an anticlockwise side.
            const double x = 0.5 * (a.x + b.x), y = 0.5 * (a.y + b.y),
                         length = std::hypot(b.x - a.x, b.y - a.y);
            const double out_x = x - 1.0e-4 * (b.y - a.y) / length, out_y = y + 1.0e-4 * (b.x - a.x) / length;
            const bool beyond = out_x < 0.0 || out_y < 0.0 || out_x > field_.grid.columns() - 1.0 ||
                                out_y > field_.grid.rows() - 1.0;
            if (beyond || !is_there(triangle_at(out_x, out_y)) || is_kept(triangle_at(out_x, out_y)))
                continue;
            if (++open <= 5) std::printf("an open side from %.7f, %.7f to %.7f, %.7f\n", a.x, a.y, b.x, b.y);
        }
    }
    EXPECT_EQ(open, 0);
}

// H of a surface at a place that may be on its rim: at the nearest of some places around that has one. 1e-5
// posts are at most 15 mm of these waves.
double H_near(const HeightField& field, double x, double y, const std::vector<char>* masked = nullptr) {
    for (int i = 0; i < 16; ++i) {
        const double angle = i * std::numbers::pi / 8.0 + 0.1;
        const PostPlace place =
            field.grid.place_at(y + 1.0e-5 * std::sin(angle), x + 1.0e-5 * std::cos(angle));
        if (const auto H_m = field.surface_H_m(place.lat_deg, place.lon_deg, masked)) return *H_m;
    }
    return std::nan("");
}

void Scene::expect_walls_as_high_as_steps() const {
    for (const SeamWall& wall : cut_.walls) {
        for (std::size_t end = 0; end < 2; ++end) {
            const At low = at(field_, wall.cut[end]);
            const HeightField& over = over_[wall.over[end].grid - 1];
            const At high = at(over, wall.over[end]);
            const PostPlace place = over.grid.place_at(high.y, high.x);
            const PostNumber here = field_.grid.post_at(place.lat_deg, place.lon_deg);
            ASSERT_NEAR(here.row, low.y, 2.0e-6);
            ASSERT_NEAR(here.column, low.x, 2.0e-6);
            EXPECT_NEAR(H_near(field_, low.x, low.y, &cut_.masked_posts), low.H_m, 0.02);
            EXPECT_NEAR(H_near(over, high.x, high.y), high.H_m, 0.02);
        }
        // What is cut lies on the right hand, and is not covered.
        const At a = at(field_, wall.cut[0]), b = at(field_, wall.cut[1]);
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        const double x = 0.5 * (a.x + b.x) - 1.0e-4 * (b.y - a.y) / length,
                     y = 0.5 * (a.y + b.y) + 1.0e-4 * (b.x - a.x) / length;
        EXPECT_FALSE(is_covered(x, y)) << x << ", " << y;
    }
}

TEST(GridClip, AFinerGridOnTheSameDegreesTakesItsPart) {
    // 41 x 51 posts every 0.01 degrees; 61 x 81 every 0.0025 over its middle, rims along rows and columns of
    // the first.
    const Scene scene(on_degrees(47.0, 8.0, 100.0, 41, 51, 1000.0),
                      {on_degrees(46.9, 8.15, 400.0, 61, 81, 1050.0)});
    std::mt19937 random(71);
    EXPECT_EQ(scene.wrong_places(random, 20'000), 0);
    scene.expect_no_gap();
    scene.expect_walls_as_high_as_steps();
    // Its rim is 2 x (60 + 80) posts long.
    EXPECT_EQ(scene.cut().walls.size(), 280U);
    // In two of its corners a triangle has all its posts on the rim. One of them goes, and takes three
    // triangles outside along, which meet the rim's own posts.
    EXPECT_EQ(scene.cut().ground.size(), 18U);
}

TEST(GridClip, RandomGridsCoverEveryPlaceOnce) {
    for (const unsigned seed : {11U, 12U, 13U, 14U, 15U, 16U}) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> share(0.0, 1.0);
        HeightField field = on_degrees(47.0, 8.0, 100.0, 41, 51, 1000.0);
        make_holes(field, random, 6, 3);
        std::vector<HeightField> over;
        over.push_back(turned(46.8 + 0.1 * share(random), 8.2 + 0.1 * share(random), 360.0 * share(random),
                              150.0, 40 + static_cast<int>(random() % 60), 60, 1100.0));
        make_holes(over.back(), random, 4, 5);
        over.push_back(
            on_degrees(46.95 - 0.2 * share(random), 8.1 + 0.3 * share(random), 333.0, 30, 40, 900.0));
        // One smaller than a cell, and one that reaches beyond.
        over.push_back(turned(46.7 + 0.2 * share(random), 8.1 + 0.3 * share(random), 360.0 * share(random),
                              20.0, 9, 7, 1200.0));
        over.push_back(turned(46.6, 8.0 + 0.5 * share(random), 360.0 * share(random), 300.0, 25, 30, 1300.0));
        const Scene scene(std::move(field), std::move(over));
        const int wrong = scene.wrong_places(random, 20'000);
        std::printf("seed %u: %zu pieces, %zu walls, %d of 20,000 places wrong\n", seed,
                    scene.cut().ground.size(), scene.cut().walls.size(), wrong);
        EXPECT_EQ(wrong, 0);
        scene.expect_no_gap();
        scene.expect_walls_as_high_as_steps();
    }
}

// It shows what it does not cover: through a hole, the other grid.
TEST(GridClip, AVoidOfTheFinerShowsTheCoarser) {
    HeightField over = on_degrees(46.9, 8.15, 400.0, 61, 81, 1050.0);
    for (int row = 20; row <= 30; ++row)
        for (int column = 30; column <= 45; ++column)
            over.H_m[static_cast<std::size_t>(row * 81 + column)] = void_height_m;
    const Scene scene(on_degrees(47.0, 8.0, 100.0, 41, 51, 1000.0), {std::move(over)});
    std::mt19937 random(72);
    EXPECT_EQ(scene.wrong_places(random, 20'000), 0);
    scene.expect_no_gap();
    scene.expect_walls_as_high_as_steps();
    EXPECT_FALSE(scene.is_covered(15.0 + 37.5 / 4.0, 10.0 + 25.0 / 4.0));
}

// Most of its rim lies beyond the grid that is cut, and what is under it is cut all the same.
TEST(GridClip, AGridThatReachesBeyondTakesAllThatIsUnderIt) {
    std::mt19937 random(73);
    const Scene west_half(on_degrees(47.0, 8.0, 100.0, 41, 51, 1000.0),
                          {on_degrees(47.2, 7.5, 370.0, 300, 278, 1050.0)});
    EXPECT_EQ(west_half.wrong_places(random, 20'000), 0);
    west_half.expect_no_gap();
    const Scene around(on_degrees(47.0, 8.0, 100.0, 41, 51, 1000.0),
                       {on_degrees(47.2, 7.5, 370.0, 300, 600, 1050.0)});
    EXPECT_EQ(around.wrong_places(random, 20'000), 0);
    EXPECT_EQ(std::count(around.cut().masked_posts.begin(), around.cut().masked_posts.end(), 1), 41 * 51);
    EXPECT_TRUE(around.cut().ground.empty());
}

TEST(GridClip, GridsThatDoNotMeetLeaveEachOtherAlone) {
    const Scene scene(on_degrees(47.0, 8.0, 100.0, 41, 51, 1000.0),
                      {on_degrees(45.0, 8.15, 400.0, 61, 81, 1050.0)});
    EXPECT_TRUE(scene.cut().ground.empty());
    EXPECT_TRUE(scene.cut().walls.empty());
    EXPECT_EQ(std::count(scene.cut().masked_posts.begin(), scene.cut().masked_posts.end(), 1), 0);
}

}  // namespace
}  // namespace oro
