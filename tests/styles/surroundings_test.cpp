// What is drawn where no ground is, and where ground is water, in the style `natural`.
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <random>

#include "core/earth/framing.h"
#include "tests/styles/drawn_style.h"

namespace oro {
namespace {

using Codes = std::array<int, 4>;

Codes codes_at(const DepthPicture& picture, std::size_t pixel) {
    return {picture.rgba[4 * pixel], picture.rgba[4 * pixel + 1], picture.rgba[4 * pixel + 2],
            picture.rgba[4 * pixel + 3]};
}

int apart(const Codes& one, const Codes& other) {
    int most = 0;
    for (std::size_t i = 0; i < 3; ++i) most = std::max(most, std::abs(one[i] - other[i]));
    return most;
}

// Where a line of sight first meets the bare ellipsoid, in double precision.
std::optional<Geodetic> on_ellipsoid(const Camera& camera, const glm::dvec3& direction) {
    const glm::dvec3 scale(1.0 / wgs84_a_m, 1.0 / wgs84_a_m, 1.0 / wgs84_b_m);
    const glm::dvec3 from = camera.eye_ecef().m * scale, along = direction * scale;
    const double a = glm::dot(along, along), b = glm::dot(from, along), c = glm::dot(from, from) - 1.0;
    if (b >= 0.0 || b * b < a * c) return std::nullopt;
    return geodetic_from_ecef({camera.eye_ecef().m + direction * (c / (-b + std::sqrt(b * b - a * c)))});
}

// Posts from the region's rim, above 0 inside: of the place that a point of the picture shows.
double posts_inside(const Camera& camera, const PostGrid& grid, double x_px, double y_px) {
    const auto place = on_ellipsoid(camera, camera.ecef_direction_at({x_px, y_px}));
    if (!place) return -1e9;
    const double row = grid.lat.index_at(place->lat_deg), column = grid.column_at(place->lon_deg);
    return std::min({row, column, grid.rows() - 1 - row, grid.columns() - 1 - column});
}

class SurroundingsTest : public test::StyleTest {
  protected:
    static Result<Style> natural(const HeightField& field, const Camera& camera, Sea sea = Sea::level,
                                 Rim rim = Rim::skirt) {
        View view;
        view.style = (test::bundled_data() / "styles" / "natural.json").string();
        view.camera = camera;
        view.sea = sea;
        view.rim = rim;
        view.sun = SunDirection{200.0, 50.0};
        return load_style(view, field);
    }

    DepthPicture picture(const HeightField& field, const Camera& camera, const gpu::FrameStyle& frame) {
        Region region{std::vector<RegionGrid>(1)};
        region.grids[0].field = field;
        Style style{};
        style.frame = frame;
        auto found = drawn(region, camera, style);
        EXPECT_TRUE(found.has_value());
        return found ? std::move(*found) : DepthPicture{};
    }
};

// An eye that looks obliquely at a field's middle from any side.
Camera oblique(const PostGrid& grid, double heading_deg, double pitch_deg, double size_m) {
    Camera camera;
    const Geodetic middle{0.5 * (grid.north_deg() + grid.south_deg()),
                          0.5 * (grid.west_deg() + grid.east_deg()), 0.0};
    camera.eye = middle;
    camera.attitude = {heading_deg, pitch_deg, 0.0};
    camera.vertical_fov_deg = 40.0;
    camera.width_px = 160;
    camera.height_px = 120;
    const glm::dmat3 axes = glm::transpose(camera.view_from_ecef());
    camera.eye = geodetic_from_ecef({ecef_from_geodetic(middle).m + 1.6 * size_m * axes[2]});
    camera.attitude = attitude_of_axes(camera.eye, -axes[2], axes[0]);
    return camera;
}

// Ground in one corner at sea level, all else void: what is hatched is what a computation in double precision
// has inside the region, at any place and from any side.
TEST_F(SurroundingsTest, VoidsAreHatchedUpToTheRimOfTheRegion) {
    constexpr unsigned seed = 20261125;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (const auto& [lat_deg, lon_deg] :
         {std::pair{46.5, 8.0}, {0.0, 179.99}, {89.5, 20.0}, {-33.0, -70.0}}) {
        HeightField field = test::square_field(lat_deg, lon_deg, 100.0, 101, [](int row, int column) {
            return row < 20 && column < 20 ? 0.5 * ((row + column) % 2) : double{void_height_m};
        });
        const Camera camera =
            oblique(field.grid, 360.0 * share(random), -35.0 - 50.0 * share(random), 10100.0);
        SCOPED_TRACE(testing::Message() << lat_deg << "," << lon_deg);
        const auto style = natural(field, camera);
        ASSERT_TRUE(style.ok()) << style.error().line();
        const DepthPicture hatched = picture(field, camera, style->frame);
        gpu::FrameStyle plain = style->frame;
        plain.voids.on = 0;
        const DepthPicture without = picture(field, camera, plain);
        int inside = 0, outside = 0, wrong = 0;
        for (std::size_t i = 0; i < hatched.points.size(); ++i) {
            const auto column = i % 160, row = i / 160;
            const double in = posts_inside(camera, field.grid, static_cast<double>(column) + 0.5,
                                           static_cast<double>(row) + 0.5);
            if (!hatched.points[i].background() || std::abs(in) < 2.0) continue;
            EXPECT_EQ(codes_at(hatched, i)[3], 0);  // no ground
            const bool drawn = apart(codes_at(hatched, i), codes_at(without, i)) > 0;
            (in > 0.0 ? inside : outside) += 1;
            wrong += drawn != (in > 0.0) ? 1 : 0;
        }
        EXPECT_EQ(wrong, 0) << "of " << inside << " inside and " << outside << " outside";
        EXPECT_GT(inside, 2000);
        EXPECT_GT(outside, 1000);
    }
}

// Lines and what is between them: two colours, and neither nearly all.
TEST_F(SurroundingsTest, HatchHasLines) {
    const HeightField field = test::square_field(46.5, 8.0, 100.0, 101, [](int row, int column) {
        return row < 2 && column < 2 ? 1.0 : double{void_height_m};
    });
    const Camera camera = test::straight_down(field, 100.0, 60.0, 300);
    const auto style = natural(field, camera);
    ASSERT_TRUE(style.ok()) << style.error().line();
    const DepthPicture hatched = picture(field, camera, style->frame);
    int least = 255, most = 0;
    for (std::size_t i = 0; i < hatched.points.size(); ++i) {
        least = std::min(least, codes_at(hatched, i)[1]);
        most = std::max(most, codes_at(hatched, i)[1]);
    }
    EXPECT_GE(most - least, 8);   // seen,
    EXPECT_LE(most - least, 60);  // ... and quiet
    int lines = 0;
    for (std::size_t i = 0; i < hatched.points.size(); ++i)
        lines += 2 * codes_at(hatched, i)[1] > most + least ? 1 : 0;
    const double line_share = lines / static_cast<double>(hatched.points.size());
    EXPECT_GT(line_share, 0.04);
    EXPECT_LT(line_share, 0.30);
    // As the sea they have none.
    const auto sea = natural(field, camera, Sea::voids);
    ASSERT_TRUE(sea.ok());
    const DepthPicture water = picture(field, camera, sea->frame);
    least = 255, most = 0;
    for (std::size_t i = 0; i < water.points.size(); ++i) {
        least = std::min(least, codes_at(water, i)[1]);
        most = std::max(most, codes_at(water, i)[1]);
    }
    EXPECT_LE(most - least, 4);
}

// Rows just below the horizon of a void, by how many of their pixels show the lines' colour and how many the
// colour between.
struct HatchCount {
    int lines{}, between{}, least_in_row{1000};
};

// Over a void that reaches beyond the horizon, from `above_m`: in the picture's middle the sight is level.
class HatchToTheHorizon : public SurroundingsTest {
  protected:
    HatchCount below_the_horizon(double apart_m, int posts, double above_m) {
        const HeightField field = test::square_field(46.5, 8.0, apart_m, posts, [](int row, int column) {
            return row < 2 && column < 2 ? 1.0 : double{void_height_m};
        });
        Camera camera;
        camera.eye = {0.5 * (field.grid.north_deg() + field.grid.south_deg()),
                      0.5 * (field.grid.west_deg() + field.grid.east_deg()), above_m};
        camera.attitude = {30.0, 0.0, 0.0};
        camera.vertical_fov_deg = 40.0;
        camera.width_px = 240;
        camera.height_px = 180;
        const auto style = natural(field, camera);
        EXPECT_TRUE(style.ok()) << style.error().line();
        gpu::FrameStyle all_lines = style->frame, no_lines = style->frame;
        all_lines.voids.colour = all_lines.voids.lines;
        no_lines.voids.lines = no_lines.voids.colour;
        const DepthPicture hatched = picture(field, camera, style->frame),
                           lines = picture(field, camera, all_lines),
                           between = picture(field, camera, no_lines);
        HatchCount count;
        for (int row = first_below_horizon(camera) + 1, rows = 0; rows < 12; ++row, ++rows) {
            int of_row = 0;
            for (int column = 0; column < camera.width_px; ++column) {
                const auto i = static_cast<std::size_t>(row * camera.width_px + column);
                EXPECT_TRUE(hatched.points[i].background());
                const int whole = apart(codes_at(lines, i), codes_at(between, i)),
                          to_lines = apart(codes_at(lines, i), codes_at(hatched, i)),
                          to_between = apart(codes_at(between, i), codes_at(hatched, i));
                EXPECT_GE(whole, 4) << "row " << row;  // through air, too, they are told apart
                of_row += 4 * to_lines <= whole ? 1 : 0;
                count.between += 4 * to_between <= whole ? 1 : 0;
            }
            count.lines += of_row;
            count.least_in_row = std::min(count.least_in_row, of_row);
        }
        return count;
    }

    // The first row whose pixels all lie below the horizon.
    static int first_below_horizon(const Camera& camera) {
        for (int row = 0; row < camera.height_px; ++row) {
            bool below = true;
            for (int column = 0; column < camera.width_px; ++column)
                below = below &&
                        on_ellipsoid(camera, camera.ecef_direction_at({column + 0.5, row + 0.5})).has_value();
            if (below) return row;
        }
        return camera.height_px;
    }
};

// 12 rows of 240 pixels; stripes 17 px apart along a row, and 2.5 px wide there.
void expect_stripes(const HatchCount& count) {
    std::printf("%d of the lines, %d between, at least %d in a row\n", count.lines, count.between,
                count.least_in_row);
    EXPECT_GT(count.lines, 150);
    EXPECT_LT(count.lines, 700);
    EXPECT_GT(count.between, 1500);
    EXPECT_GE(count.least_in_row, 8);
}

// Found: from a person's height what lay beyond 70 m was one colour, like the sea.
TEST_F(HatchToTheHorizon, IsSeenFromAPersonsHeight) {
    expect_stripes(below_the_horizon(30.0, 401, 2.0));
}

// The horizon is 87 km away.
TEST_F(HatchToTheHorizon, IsSeenFromAMountain) {
    expect_stripes(below_the_horizon(1000.0, 221, 600.0));
}

// Voids of one post, 12 px from the next: a line crosses each of them, wherever it is. Found: lines stood 8
// posts apart or more, and missed them.
TEST_F(SurroundingsTest, SmallVoidsShowALine) {
    constexpr int side_px = 480, px_a_post = 12;
    const HeightField field = test::square_field(46.5, 8.0, 100.0, 45, [](int row, int column) {
        return row % 4 == 2 && (column + row / 4) % 4 == 2 ? double{void_height_m} : 1.0;
    });
    const Camera camera = test::straight_down(field, 100.0, side_px / px_a_post, side_px);
    const auto style = natural(field, camera);
    ASSERT_TRUE(style.ok()) << style.error().line();
    gpu::FrameStyle no_lines = style->frame;
    no_lines.voids.lines = no_lines.voids.colour;
    const DepthPicture hatched = picture(field, camera, style->frame),
                       plain = picture(field, camera, no_lines);
    int voids = 0, with_lines = 0;
    for (int row = 6; row < 40; row += 4) {
        for (int column = 4; column < 40; ++column) {
            if ((column + row / 4) % 4 != 2) continue;
            // Post 22 is in the picture's middle.
            const int x = side_px / 2 + (column - 22) * px_a_post, y = side_px / 2 + (row - 22) * px_a_post;
            int of_lines = 0;
            for (int i = 0; i < 4 * px_a_post * px_a_post; ++i) {
                const int at_x = x - px_a_post + i % (2 * px_a_post),
                          at_y = y - px_a_post + i / (2 * px_a_post);
                const auto pixel = static_cast<std::size_t>(at_y * side_px + at_x);
                of_lines += apart(codes_at(hatched, pixel), codes_at(plain, pixel)) >= 6 ? 1 : 0;
            }
            ++voids;
            with_lines += of_lines >= 12 ? 1 : 0;
        }
    }
    EXPECT_EQ(voids, 81);
    EXPECT_EQ(with_lines, voids);
}

// More than a page of them: hills, N that slopes by 1 m in 10 km, a lake of 30 x 30 posts, and flat fields of
// 3 x 3 and of 4 x 4 posts.
HeightField land_with_a_lake() {
    HeightField field = test::square_field(46.5, 8.0, 90.0, 141, [](int row, int column) {
        if (row >= 30 && row < 60 && column >= 30 && column < 60) return 400.0;
        if (row >= 80 && row < 83 && column >= 80 && column < 83) return 420.0;
        if (row >= 80 && row < 84 && column >= 20 && column < 24) return 420.0;
        return std::round(440.0 + 25.0 * std::sin(row / 5.0) * std::cos(column / 7.0) +
                          3.0 * ((row * 7 + column * 5) % 3));
    });
    field.undulation.lat = {2.0, 47.0, 0, -1, 3};
    field.undulation.lon = {2.0, 7.5, 0, +1, 3};
    field.undulation.N_m = {48, 52, 57, 46, 49, 53, 45, 47, 50};
    return field;
}

TEST_F(SurroundingsTest, LakesAreWaterAndSmallFlatFieldsAreNot) {
    const HeightField field = land_with_a_lake();
    for (const int side_px : {400, 50}) {  // the posts of level 0, and every second
        SCOPED_TRACE(testing::Message() << side_px << " px");
        const Camera camera = test::straight_down(field, 90.0, 96.0, side_px);
        const auto style = natural(field, camera);
        ASSERT_TRUE(style.ok()) << style.error().line();
        gpu::FrameStyle dry = style->frame;
        dry.water.on = 0;
        const DepthPicture with = picture(field, camera, style->frame), without = picture(field, camera, dry);
        int lake = 0, lake_dry = 0, land = 0, land_wet = 0;
        for (std::size_t i = 0; i < with.points.size(); ++i) {
            const double row = with.points[i].row, column = with.points[i].column;
            if (with.points[i].background()) continue;
            const bool wet = apart(codes_at(with, i), codes_at(without, i)) > 0;
            const double in = std::min({row - 30.0, 59.0 - row, column - 30.0, 59.0 - column});
            // Every second post may end two posts before the shore.
            if (in > 2.5) {
                ++lake;
                lake_dry += wet ? 0 : 1;
                EXPECT_EQ(codes_at(with, i)[3], 255);  // ground all the same: heights are those of the posts
            } else if (in < -0.01) {
                ++land;
                land_wet += wet ? 1 : 0;
            }
        }
        EXPECT_GT(lake, 100);
        EXPECT_EQ(lake_dry, 0) << "of " << lake;
        EXPECT_GT(land, 1000);
        EXPECT_EQ(land_wet, 0) << "of " << land;
    }
}

// A shore that goes two rows down for each column, and one that goes four columns on for each row: posts are
// whole, so theirs is a staircase. The drawn shore's r.m.s. from its straight line: posts of the staircases
// that lie farthest out have 0.25 and 0.28.
TEST_F(SurroundingsTest, ShoresAreSmoothBetweenPosts) {
    for (const double columns_a_row : {0.5, 4.0}) {
        SCOPED_TRACE(testing::Message() << columns_a_row << " columns a row");
        const HeightField field = test::square_field(46.5, 8.0, 90.0, 141, [&](int row, int column) {
            const double beyond = (column - 70) + columns_a_row * (row - 70);
            return beyond < 0.0 ? 400.0 : 406.0 + std::floor(beyond);
        });
        const Camera camera = test::straight_down(field, 90.0, 60.0, 480);
        const auto style = natural(field, camera);
        ASSERT_TRUE(style.ok()) << style.error().line();
        gpu::FrameStyle dry = style->frame;
        dry.water.on = 0;
        const DepthPicture with = picture(field, camera, style->frame), without = picture(field, camera, dry);
        const auto width = static_cast<std::size_t>(camera.width_px);
        // At a right angle to the line: posts.
        const double per_post = 1.0 / std::hypot(1.0, columns_a_row);
        double sum = 0.0, squares = 0.0, count = 0.0, farthest = -1e9;
        for (std::size_t i = 0; i + 1 < with.points.size(); ++i) {
            if (i % width + 1 == width || with.points[i].background()) continue;
            if (apart(codes_at(with, i), codes_at(without, i)) == 0 ||
                apart(codes_at(with, i + 1), codes_at(without, i + 1)) > 0)
                continue;
            const double beyond =
                ((with.points[i].column - 70.0) + columns_a_row * (with.points[i].row - 70.0)) * per_post;
            farthest = std::max(farthest, beyond);
            sum += beyond;
            squares += beyond * beyond;
            count += 1.0;
        }
        ASSERT_GT(count, 60.0);
        const double mean = sum / count, rms = std::sqrt(std::max(squares / count - mean * mean, 0.0));
        std::printf("shore %.2f posts from its line, r.m.s. %.3f, farthest %.2f\n", mean, rms, farthest);
        EXPECT_LT(rms, 0.2) << "posts";
        EXPECT_NEAR(mean, -0.5, 0.5) << "posts";
        EXPECT_LT(farthest, 0.1) << "posts: the ground rises there";
    }
}

// Noise of +-4 m around sea level is the sea where one asks for it, and so is noise far below.
TEST_F(SurroundingsTest, LowGroundIsTheSeaOnDemand) {
    constexpr unsigned seed = 20261126;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> noise(-4, 4);
    gpu::FrameStyle dry{};
    for (const double middle_m : {-0.5, -13.0}) {
        SCOPED_TRACE(testing::Message() << "around " << middle_m << " m");
        const HeightField field = test::square_field(54.3, 19.0, 90.0, 101, [&](int, int column) {
            return column < 50 ? noise(random) + middle_m : 40.0 + column % 3;
        });
        const Camera camera = test::straight_down(field, 90.0, 90.0, 200);
        for (const Sea sea : {Sea::level, Sea::low}) {
            const auto style = natural(field, camera, sea);
            ASSERT_TRUE(style.ok()) << style.error().line();
            dry = style->frame;
            dry.water.wave_variance = 0.5F;  // other water is seen where there is any
            dry.water.deep = gpu::vec3(1.0F, 0.0F, 0.0F);
            const DepthPicture one = picture(field, camera, style->frame),
                               other = picture(field, camera, dry);
            int wet = 0, sea_pixels = 0, land_wet = 0;
            for (std::size_t i = 0; i < one.points.size(); ++i) {
                const bool is_wet = apart(codes_at(one, i), codes_at(other, i)) > 0;
                if (one.points[i].column > 50.0) {
                    land_wet += is_wet ? 1 : 0;
                } else if (one.points[i].column < 47.0) {
                    ++sea_pixels;
                    wet += is_wet ? 1 : 0;
                }
            }
            EXPECT_EQ(land_wet, 0);
            if (sea == Sea::level) {
                EXPECT_EQ(wet, 0);
            } else {
                EXPECT_GT(wet, sea_pixels * 9 / 10);
            }
        }
    }
}

// Far below all posts, but not so far that ground would have the colours of a sea's bed.
TEST_F(SurroundingsTest, LowSeaReachesDownToAllPostsAndTellsNoDepths) {
    const HeightField field = test::square_field(54.3, 19.0, 90.0, 11, [](int, int) { return -13.0; });
    const auto low = natural(field, test::straight_down(field, 90.0, 9.0, 20), Sea::low);
    ASSERT_TRUE(low.ok()) << low.error().line();
    EXPECT_EQ(low->frame.water.sea_low_H_m, -20000.0F);
    EXPECT_EQ(low->frame.water.sea_high_H_m, 5.0F);
}

// Walls are seen below the rim, and are no ground; without them nothing is hatched where nothing is void.
TEST_F(SurroundingsTest, SkirtIsNoGround) {
    const HeightField field = test::square_field(46.5, 8.0, 100.0, 101, [](int row, int column) {
        return 1500.0 + 200.0 * std::sin(row / 9.0) + 150.0 * std::cos(column / 8.0);
    });
    const Camera camera = oblique(field.grid, 10.0, -30.0, 12000.0);
    const auto skirt = natural(field, camera), none = natural(field, camera, Sea::level, Rim::none);
    ASSERT_TRUE(skirt.ok() && none.ok());
    gpu::FrameStyle plain = none->frame;
    plain.voids.on = 0;
    const DepthPicture with = picture(field, camera, skirt->frame),
                       without = picture(field, camera, none->frame), bare = picture(field, camera, plain);
    EXPECT_EQ(without.rgba, bare.rgba);
    int walls = 0;
    for (std::size_t i = 0; i < with.points.size(); ++i) {
        if (apart(codes_at(with, i), codes_at(without, i)) == 0) continue;
        ++walls;
        EXPECT_TRUE(with.points[i].background());
        EXPECT_EQ(codes_at(with, i)[3], 0);
        EXPECT_EQ(with.depths[i], 0.0F);
    }
    EXPECT_GT(walls, 100);
}

}  // namespace
}  // namespace oro
