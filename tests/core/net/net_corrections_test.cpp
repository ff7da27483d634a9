// Nets over kinks: places of posts, the way back, parts, and what jumps.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "core/net/lattice_georeference.h"
#include "tests/support/net_terrain.h"

namespace oro {
namespace {

using test::KinkedPlane;

double distance_m(const PostPlace& a, const PostPlace& b) {
    return glm::length(ecef_from_geodetic({a.lat_deg, a.lon_deg, 0.0}).m -
                       ecef_from_geodetic({b.lat_deg, b.lon_deg, 0.0}).m);
}

bool same_bits(const glm::dvec3& a, const glm::dvec3& b) {
    return std::memcmp(&a, &b, sizeof(a)) == 0;
}

// Nodes as close as those of OSTN15 are to posts every 25 m, and far apart; few posts between kinks, and
// posts close together.
const KinkedPlane kinked[] = {{{700, 900, {50.0, 11.0}, 25.0, 0.0}, 440.3, 0.2},
                              {{300, 420, {46.5, 8.0}, 25.0, 12.0}, 40.3, 0.02},
                              {{130, 200, {-41.0, 174.0}, 90.0, 33.0}, 61.1, 0.3},
                              {{200, 150, {52.0, 179.999}, 5.0, -7.0}, 81.7, 0.1},
                              {{3, 500, {48.0, 2.0}, 30.0, 90.0}, 110.7, 0.05}};

TEST(NetCorrections, PutEveryPostWhereItIs) {
    for (const KinkedPlane& of : kinked) {
        const auto net = kinked_net_of(of);
        ASSERT_TRUE(net);
        EXPECT_LE(net->error_m(), LatticeGeoreference::largest_error_m);
        EXPECT_GT(net->kink(), 0.0);
        double worst_m = 0.0, worst_back = 0.0;
        for (int row = 0; row < of.plane.rows; ++row) {
            for (int column = 0; column < of.plane.columns; ++column) {
                const PostPlace placed = net->place_at(row, column);
                worst_m = std::max(worst_m, distance_m(of.place_of(row, column), placed));
                const PostNumber back = net->post_at(placed.lat_deg, placed.lon_deg);
                worst_back = std::max({worst_back, std::abs(back.row - row), std::abs(back.column - column)});
            }
        }
        const LatticeGeoreference::Stored stored = net->stored();
        std::printf(
            "%dx%d posts every %g m, shifts every %g: %zu of %d patches of %d x %d corrected, %.1e m "
            "off, %.1e of a post on the way back\n",
            of.plane.rows, of.plane.columns, of.plane.post_m, of.node_posts, stored.corrections.size(),
            stored.down.patches * stored.across.patches, stored.down.patch_posts, stored.across.patch_posts,
            worst_m, worst_back);
        EXPECT_LE(worst_m, LatticeGeoreference::largest_error_m + 1.0e-8);
        EXPECT_LE(worst_back, 1.0e-9 + 3.0e-9 / of.plane.post_m) << "or what doubles of degrees are off";
    }
}

// Between posts, too, on patches' rims as elsewhere; and near the truth there.
TEST(NetCorrections, GoOnBetweenPosts) {
    constexpr unsigned seed = 612;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const KinkedPlane& of : kinked) {
        const auto net = kinked_net_of(of);
        const LatticeGeoreference::Stored stored = net->stored();
        double worst_m = 0.0, worst_back = 0.0;
        for (int i = 0; i < 40000; ++i) {
            double row = unit(random) * (of.plane.rows - 1), column = unit(random) * (of.plane.columns - 1);
            if (i % 4 == 0) {  // a hair beside a rim
                const double rim = stored.down.patch_posts * std::round(row / stored.down.patch_posts);
                row = std::clamp(rim + (unit(random) - 0.5) * 1.0e-6, 0.0, of.plane.rows - 1.0);
            }
            const PostPlace placed = net->place_at(row, column);
            worst_m = std::max(worst_m, distance_m(of.place_of(row, column), placed));
            const PostNumber back = net->post_at(placed.lat_deg, placed.lon_deg);
            const PostPlace again = net->place_at(back.row, back.column);
            worst_back = std::max(worst_back, distance_m(again, placed));
        }
        std::printf("seed %u, shifts every %g: %.1e m off between posts, %.1e m on the way back\n", seed,
                    of.node_posts, worst_m, worst_back);
        // A kink between two posts turns the way by up to four shifts in a node's distance.
        EXPECT_LE(worst_m, LatticeGeoreference::largest_error_m + 2.0 * of.shift_m / of.node_posts);
        EXPECT_LE(worst_back, 2.0e-5);
    }
}

// A row's posts one by one, together and from a part: the same bits.
TEST(NetCorrections, GiveAPostOnePlace) {
    for (const KinkedPlane& of : {kinked[0], kinked[1]}) {
        const auto whole = kinked_net_of(of);
        constexpr int rows = 180, columns = 250;
        const int top = of.plane.rows / 3, left = of.plane.columns / 3;
        const auto part = whole->part(top, left, rows, columns);
        ASSERT_TRUE(part.ok()) << part.error().line();
        ASSERT_TRUE((*part)->is_corrected());
        const auto middle = (*part)->part(5, 80, 120, 100);
        ASSERT_TRUE(middle.ok()) << middle.error().line();
        const auto stored = LatticeGeoreference::from((*part)->stored());
        ASSERT_TRUE(stored.ok()) << stored.error().line();
        std::vector<glm::dvec3> row(columns);
        for (int i = 0; i < rows; ++i) {
            whole->normals_of_row(top + i, left, row);
            for (int j = 0; j < columns; ++j) {
                const glm::dvec3 expected = row[static_cast<std::size_t>(j)];
                glm::dvec3 one;
                for (const auto& net : {*part, *stored}) {
                    net->normals_of_row(i, j, {&one, 1});
                    ASSERT_TRUE(same_bits(one, expected)) << i << ", " << j;
                    ASSERT_TRUE(same_bits(net->normal_at(i, j), whole->normal_at(top + i, left + j)));
                }
                ASSERT_LT(glm::length(one - (*part)->normal_at(i, j)), 1.0e-15);
                if (i < 5 || i >= 125 || j < 80 || j >= 180) continue;
                (*middle)->normals_of_row(i - 5, j - 80, {&one, 1});
                ASSERT_TRUE(same_bits(one, expected)) << i << ", " << j;
            }
        }
    }
}

// A part without kinks keeps no correction.
TEST(NetCorrections, StayWhereTheirPatchesAre) {
    const auto whole = kinked_net_of(kinked[0]);
    const std::size_t all = whole->stored().corrections.size();
    const auto part = whole->part(5, 5, 60, 400);
    ASSERT_TRUE(part.ok());
    EXPECT_LT((*part)->stored().corrections.size(), all);
    const auto smooth = whole->part(5, 5, 60, 300);
    ASSERT_TRUE(smooth.ok());
    EXPECT_FALSE((*smooth)->is_corrected());
    EXPECT_EQ((*smooth)->kink(), 0.0);
}

// The bound of what ways are off their chords, which certificates count.
TEST(NetCorrections, TurnNoMoreThanIsSaid) {
    for (const KinkedPlane& of : kinked) {
        const auto net = kinked_net_of(of);
        constexpr unsigned seed = 613;
        std::mt19937_64 random(seed);
        const auto any = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
        double most = 0.0;
        for (int i = 0; i < 20000; ++i) {
            const int length = 1 << any(7);
            const bool down = i % 2 == 0;
            const int row = any(of.plane.rows), column = any(of.plane.columns);
            if ((down ? row + length : row) >= of.plane.rows ||
                (down ? column : column + length) >= of.plane.columns)
                continue;
            const auto at = [&](double share) {
                return net->normal_at(row + (down ? share * length : 0.0),
                                      column + (down ? 0.0 : share * length));
            };
            const double stretch = length * (down ? net->row_m() : net->column_m()) / 6.33e6;
            const double bound = net->bend() * stretch * stretch / 8.0 + net->kink() * stretch / 4.0;
            for (const double share : {0.25, 0.5, 0.625}) {
                const glm::dvec3 chord = at(0.0) + share * (at(1.0) - at(0.0));
                most = std::max(most, glm::distance(at(share), chord) / bound);
            }
        }
        std::printf("shifts every %g: at most %.2f of the bound; bend %.3f, kink %.1e\n", of.node_posts, most,
                    net->bend(), net->kink());
        EXPECT_LE(most, 1.0);
    }
}

std::string refusal(const std::function<double(double row)>& moved_m) {
    const test::PlaneOfPosts plane{200, 200, {46.5, 8.0}, 25.0, 0.0};
    const auto net = test::fit_of(200, 200, [&](double row, double column) {
        return plane.place_of(row + moved_m(row) / 25.0, column);
    });
    return net.ok() ? "" : net.error().what;
}

TEST(NetCorrections, AreNoneForWhatJumps) {
    const std::string jumps = "its places on the Earth do not follow smoothly from row and column: they jump";
    EXPECT_EQ(refusal([](double row) { return row > 37.3 ? 1.0e-4 * (row - 37.3) : 0.0; }), "");
    EXPECT_EQ(refusal([](double row) { return row > 37.3 ? 0.04 : 0.0; }), jumps);
    EXPECT_EQ(refusal([](double row) { return row > 48.0 ? -0.08 : 0.0; }), jumps);
    EXPECT_EQ(refusal([](double row) { return row > 37.3 ? 10.0 : 0.0; }), jumps);
    EXPECT_EQ(refusal([](double row) { return row > 190.5 ? std::nan("") : 0.0; }), jumps);
    // Smaller than any triangle would show.
    EXPECT_EQ(refusal([](double row) { return row > 37.3 ? 0.005 : 0.0; }), "");
}

}  // namespace
}  // namespace oro
