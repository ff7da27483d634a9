// The library against arguments that cannot mean anything: each call ends with an error and its reason,
// nothing is written, and nothing else of the process is harmed.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "apps/library/orograph.h"
#include "tests/support/test_data.h"

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

oro_region open_bundled() {
    const std::string path = (oro::test::bundled_data() / "jacksboro.tif").string();
    const char* const paths[] = {path.c_str()};
    oro_region region = 0;
    EXPECT_EQ(oro_open(paths, 1, nullptr, nullptr, nullptr, &region), ORO_OK) << oro_error_text();
    return region;
}

// Chance for one thread.
class Chance {
  public:
    explicit Chance(unsigned seed) : random_(seed) {}
    int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    // A number that is no latitude, longitude, height or radius.
    double bad_number() {
        const std::array<double, 8> bad{no_number, infinity, -infinity, 1.0e300,
                                        -1.0e300,  181.0,    -180.5,    between(200.0, 1.0e9)};
        return bad[static_cast<std::size_t>(below(static_cast<int>(bad.size())))];
    }
    std::size_t bad_size(std::size_t right) {
        return static_cast<std::size_t>(below(static_cast<int>(right)));
    }
    // A region that is none: 0, closed, one that never was.
    oro_region bad_region(oro_region closed) {
        const std::array<oro_region, 5> bad{0, closed, ~oro_region{0}, 1U << 30U, oro_region{1} << 63U};
        return bad[static_cast<std::size_t>(below(static_cast<int>(bad.size())))];
    }
    std::string bad_text() {
        std::string text;
        const int length = below(40);
        for (int i = 0; i < length; ++i) text += static_cast<char>(1 + below(255));
        return "/nowhere/" + text;
    }

  private:
    std::mt19937 random_;
};

// What the calls are made with: all of it is right, until one thing is made wrong.
struct Arguments {
    oro_region region;
    oro_region closed;
    std::array<double, 3> lat_deg{36.55, 36.52, 36.57}, lon_deg{-84.25, -84.28, -84.22};
    std::array<double, 3> H_m{1.0, 2.0, 3.0}, h_m{4.0, 5.0, 6.0};
    oro_point from{36.55, -84.25, 2.0, ORO_ABOVE_GROUND}, to{36.52, -84.28, 0.0, ORO_ABOVE_GROUND};
    oro_sight_options sight = ORO_SIGHT_OPTIONS;
    oro_sight_answer answer{};
    oro_profile_options profile = ORO_PROFILE_OPTIONS;
    oro_profile_sums sums{};
    std::array<oro_profile_point, 4> points{};
    oro_viewshed_options viewshed = ORO_VIEWSHED_OPTIONS;
    oro_horizon_options horizon = ORO_HORIZON_OPTIONS;
    oro_window window{};
    oro_open_options open = ORO_OPEN_OPTIONS;
    std::array<float, 4> deficit_m{7.0F, 7.0F, 7.0F, 7.0F}, observers{8.0F, 8.0F, 8.0F, 8.0F};
    std::array<char, 8> text{'u', 'n', 'c', 'h', 'a', 'n', 'g', 0};
    std::array<std::uint8_t, 16> rgba{};
    std::size_t count{}, width_px{}, height_px{};

    Arguments(oro_region asked, oro_region gone) : region(asked), closed(gone) {
        answer.size = sizeof answer;
        sums.size = sizeof sums;
        window.size = sizeof window;
        viewshed.radius_km = 0.5;
        horizon.radius_km = 0.5;
        horizon.bbox = "-84.26,36.54,-84.24,36.56";
        rgba.fill(9);
    }
    // That nothing was written.
    void expect_untouched() const {
        EXPECT_EQ(H_m, (std::array{1.0, 2.0, 3.0}));
        EXPECT_EQ(h_m, (std::array{4.0, 5.0, 6.0}));
        EXPECT_EQ(deficit_m, (std::array{7.0F, 7.0F, 7.0F, 7.0F}));
        EXPECT_EQ(observers, (std::array{8.0F, 8.0F, 8.0F, 8.0F}));
        EXPECT_STREQ(text.data(), "unchang");
        EXPECT_EQ(answer.slant_m, 0.0);
        EXPECT_EQ(sums.length_m, 0.0);
        EXPECT_EQ(points[0].lat_deg, 0.0);
        for (const std::uint8_t byte : rgba) EXPECT_EQ(byte, 9);
    }
};

using Call = std::function<oro_status(Arguments&, Chance&)>;

oro_status open_bad(Arguments& a, Chance& chance, const char* const* paths, std::size_t count,
                    const oro_open_options* options, oro_region* region) {
    (void)a;
    (void)chance;
    return oro_open(paths, count, options, nullptr, nullptr, region);
}

int go_on(double /*share*/, const char* /*step*/, void* /*user*/) {
    return 0;
}

std::vector<Call> calls_about_regions() {
    return {
        [](Arguments& a, Chance& c) {
            const std::string path = c.bad_text();
            const char* const paths[] = {path.c_str()};
            oro_region opened = 77;
            const oro_status status = open_bad(a, c, paths, 1, nullptr, &opened);
            EXPECT_EQ(opened, 0U);
            return status;
        },
        [](Arguments& a, Chance& c) {
            oro_region opened = 77;
            return open_bad(a, c, nullptr, static_cast<std::size_t>(c.below(3)), nullptr, &opened);
        },
        [](Arguments& a, Chance& c) {
            const char* const paths[] = {nullptr, nullptr};
            oro_region opened = 0;
            return open_bad(a, c, paths, 2, nullptr, &opened);
        },
        [](Arguments& a, Chance& c) {
            const char* const paths[] = {"/nowhere"};
            return open_bad(a, c, paths, 1, nullptr, nullptr);
        },
        [](Arguments& a, Chance& c) {
            a.open.size = c.bad_size(sizeof a.open);
            const char* const paths[] = {"/nowhere"};
            oro_region opened = 0;
            return open_bad(a, c, paths, 1, &a.open, &opened);
        },
        [](Arguments& a, Chance& c) {
            const std::string path = (oro::test::bundled_data() / "jacksboro.tif").string();
            const char* const paths[] = {path.c_str()};
            const std::string text = c.bad_text();
            const std::array<const char**, 6> members{
                &a.open.bbox, &a.open.tile, &a.open.height_unit, &a.open.source_crs, &a.open.source_vertical,
                &a.open.order};
            *members[static_cast<std::size_t>(c.below(6))] = text.c_str();
            oro_region opened = 0;
            return open_bad(a, c, paths, 1, &a.open, &opened);
        },
        [](Arguments& a, Chance& c) {
            const std::string path = (oro::test::bundled_data() / "jacksboro.tif").string();
            const char* const paths[] = {path.c_str()};
            a.open.landcover_count = c.below(2) == 0 ? 3 : std::numeric_limits<std::size_t>::max();
            oro_region opened = 0;
            return open_bad(a, c, paths, 1, &a.open, &opened);
        },
        [](Arguments& a, Chance& c) { return oro_close(c.bad_region(a.closed)); },
        [](Arguments& a, Chance& c) {
            return oro_info(c.bad_region(a.closed), a.text.data(), a.text.size(), &a.count);
        },
        [](Arguments& a, Chance&) { return oro_info(a.region, a.text.data(), a.text.size(), nullptr); },
        [](Arguments& a, Chance&) { return oro_info(a.region, nullptr, 1U << 20U, &a.count); },
        [](Arguments& a, Chance& c) {
            return oro_info(a.region, a.text.data(), static_cast<std::size_t>(c.below(8)), &a.count);
        },
        [](Arguments& a, Chance& c) {
            return oro_grid_crs(a.region, 1 + static_cast<std::size_t>(c.below(1000)), a.text.data(),
                                a.text.size(), &a.count);
        },
        [](Arguments& a, Chance& c) {
            return oro_heights(c.bad_region(a.closed), 3, a.lat_deg.data(), a.lon_deg.data(), a.H_m.data(),
                               a.h_m.data());
        },
        [](Arguments& a, Chance& c) {
            (c.below(2) == 0 ? a.lat_deg : a.lon_deg)[static_cast<std::size_t>(c.below(3))] = c.bad_number();
            return oro_heights(a.region, 3, a.lat_deg.data(), a.lon_deg.data(), a.H_m.data(), a.h_m.data());
        },
        [](Arguments& a, Chance& c) {
            const bool lat = c.below(2) == 0;
            return oro_heights(a.region, 3, lat ? nullptr : a.lat_deg.data(),
                               lat ? a.lon_deg.data() : nullptr, a.H_m.data(), a.h_m.data());
        },
        [](Arguments& a, Chance&) {
            return oro_heights(a.region, 3, a.lat_deg.data(), a.lon_deg.data(), nullptr, nullptr);
        },
        [](Arguments& a, Chance&) {
            return oro_heights(a.region, std::numeric_limits<std::size_t>::max(), a.lat_deg.data(),
                               a.lon_deg.data(), a.H_m.data(), a.h_m.data());
        },
        [](Arguments& a, Chance& c) {
            const bool place = c.below(2) == 0;
            if (place) a.lat_deg[1] = c.bad_number();
            return oro_heights_with_progress(place ? a.region : c.bad_region(a.closed), 3, a.lat_deg.data(),
                                             a.lon_deg.data(), a.H_m.data(), a.h_m.data(), go_on, nullptr);
        },
    };
}

oro_status look(Arguments& a) {
    return oro_sight(a.region, &a.from, &a.to, &a.sight, &a.answer);
}
oro_status follow(Arguments& a) {
    return oro_profile(a.region, 3, a.lat_deg.data(), a.lon_deg.data(), &a.profile, a.points.data(),
                       a.points.size(), &a.count, &a.sums);
}

std::vector<Call> calls_about_sights() {
    return {
        [](Arguments& a, Chance& c) { return a.region = c.bad_region(a.closed), look(a); },
        [](Arguments& a, Chance& c) {
            const std::array<double*, 6> members{&a.from.lat_deg, &a.from.lon_deg, &a.from.height_m,
                                                 &a.to.lat_deg,   &a.to.lon_deg,   &a.to.height_m};
            *members[static_cast<std::size_t>(c.below(6))] = no_number;
            return look(a);
        },
        [](Arguments& a, Chance& c) { return a.from.lat_deg = c.bad_number(), look(a); },
        [](Arguments& a, Chance& c) { return a.from.height_m = -c.between(0.1, 1.0e9), look(a); },
        [](Arguments& a, Chance& c) {
            a.to.above = ORO_ABOVE_ELLIPSOID;
            a.to.height_m = c.below(2) == 0 ? 1.0e300 : -c.between(1000.0, 1.0e9);
            return look(a);
        },
        [](Arguments& a, Chance& c) { return a.to.above = 3 + c.below(1000), look(a); },
        [](Arguments& a, Chance& c) { return a.sight.size = c.bad_size(sizeof a.sight), look(a); },
        [](Arguments& a, Chance& c) { return a.answer.size = c.bad_size(sizeof a.answer), look(a); },
        [](Arguments& a, Chance& c) { return a.sight.air = 2 + c.below(9), look(a); },
        [](Arguments& a, Chance& c) {
            a.sight.air = ORO_AIR_CONSTANT;
            a.sight.refraction_k = c.bad_number();
            return look(a);
        },
        [](Arguments& a, Chance&) { return oro_sight(a.region, nullptr, &a.to, &a.sight, &a.answer); },
        [](Arguments& a, Chance&) { return oro_sight(a.region, &a.from, nullptr, &a.sight, &a.answer); },
        [](Arguments& a, Chance&) { return oro_sight(a.region, &a.from, &a.to, &a.sight, nullptr); },
    };
}

std::vector<Call> calls_about_profiles() {
    return {
        [](Arguments& a, Chance& c) { return a.region = c.bad_region(a.closed), follow(a); },
        [](Arguments& a, Chance& c) { return a.profile.size = c.bad_size(sizeof a.profile), follow(a); },
        [](Arguments& a, Chance& c) { return a.sums.size = c.bad_size(sizeof a.sums), follow(a); },
        [](Arguments& a, Chance& c) {
            a.profile.step_m = c.below(2) == 0 ? no_number : -c.between(1.0e-9, 10.0);
            return follow(a);
        },
        [](Arguments& a, Chance& c) { return a.profile.step_m = c.between(1.0e-12, 1.0e-6), follow(a); },
        [](Arguments& a, Chance& c) {
            a.profile.climb_threshold_m = c.below(2) == 0 ? no_number : -c.between(0.1, 10.0);
            return follow(a);
        },
        [](Arguments& a, Chance& c) {
            return a.lon_deg[static_cast<std::size_t>(c.below(3))] = c.bad_number(), follow(a);
        },
        // More points than there is room for.
        [](Arguments& a, Chance&) { return follow(a); },
        [](Arguments& a, Chance& c) {
            return oro_profile(a.region, static_cast<std::size_t>(c.below(2)), a.lat_deg.data(),
                               a.lon_deg.data(), nullptr, a.points.data(), a.points.size(), &a.count,
                               nullptr);
        },
        [](Arguments& a, Chance&) {
            return oro_profile(a.region, 3, a.lat_deg.data(), a.lon_deg.data(), nullptr, nullptr, 1U << 20U,
                               &a.count, nullptr);
        },
        [](Arguments& a, Chance&) {
            return oro_profile(a.region, 3, a.lat_deg.data(), a.lon_deg.data(), nullptr, nullptr, 0, nullptr,
                               nullptr);
        },
        [](Arguments& a, Chance& c) {
            a.profile.step_m = -c.between(1.0e-9, 10.0);
            return oro_profile_with_progress(a.region, 3, a.lat_deg.data(), a.lon_deg.data(), &a.profile,
                                             a.points.data(), a.points.size(), &a.count, &a.sums, go_on,
                                             nullptr);
        },
        [](Arguments& a, Chance&) {
            a.lat_deg.fill(36.55);
            a.lon_deg.fill(-84.25);
            return follow(a);
        },
    };
}

oro_status look_around(Arguments& a) {
    return oro_viewshed(a.region, 1, &a.from, &a.viewshed, a.deficit_m.data(), a.observers.data(),
                        a.deficit_m.size(), &a.window, nullptr, nullptr);
}

std::vector<Call> calls_about_viewsheds() {
    return {
        [](Arguments& a, Chance& c) { return a.region = c.bad_region(a.closed), look_around(a); },
        // More posts than there is room for.
        [](Arguments& a, Chance&) { return look_around(a); },
        [](Arguments& a, Chance& c) {
            return a.viewshed.size = c.bad_size(sizeof a.viewshed), look_around(a);
        },
        [](Arguments& a, Chance& c) { return a.window.size = c.bad_size(sizeof a.window), look_around(a); },
        [](Arguments& a, Chance& c) {
            const std::array<double, 5> bad{no_number, 0.0, -1.0, infinity, 1000.1};
            return a.viewshed.radius_km = bad[static_cast<std::size_t>(c.below(5))], look_around(a);
        },
        [](Arguments& a, Chance& c) {
            const std::array<double, 4> bad{no_number, -0.5, infinity, -infinity};
            return a.viewshed.target_m = bad[static_cast<std::size_t>(c.below(4))], look_around(a);
        },
        [](Arguments& a, Chance& c) { return a.viewshed.air = -1 - c.below(9), look_around(a); },
        [](Arguments& a, Chance&) { return a.viewshed.targets_on_canopy = 1, look_around(a); },
        [](Arguments& a, Chance& c) { return a.from.lon_deg = c.bad_number(), look_around(a); },
        [](Arguments& a, Chance& c) {
            return oro_viewshed_window(a.region,
                                       c.below(2) == 0 ? 0 : std::numeric_limits<std::size_t>::max(), &a.from,
                                       &a.viewshed, &a.window);
        },
        [](Arguments& a, Chance&) { return oro_viewshed_window(a.region, 1, nullptr, nullptr, &a.window); },
        [](Arguments& a, Chance&) { return oro_viewshed_window(a.region, 1, &a.from, nullptr, nullptr); },
        [](Arguments& a, Chance& c) {
            const bool first = c.below(2) == 0;
            return oro_viewshed(a.region, 1, &a.from, &a.viewshed, first ? nullptr : a.deficit_m.data(),
                                first ? a.observers.data() : nullptr, 1U << 30U, &a.window, nullptr, nullptr);
        },
    };
}

oro_status look_at_horizons(Arguments& a) {
    return oro_horizon(a.region, &a.horizon, a.deficit_m.data(), a.observers.data(), a.observers.size(),
                       &a.window, nullptr, nullptr);
}

std::vector<Call> calls_about_horizons() {
    return {
        [](Arguments& a, Chance& c) { return a.region = c.bad_region(a.closed), look_at_horizons(a); },
        // More posts than there is room for.
        [](Arguments& a, Chance&) { return look_at_horizons(a); },
        [](Arguments& a, Chance& c) {
            return a.horizon.size = c.bad_size(sizeof a.horizon), look_at_horizons(a);
        },
        [](Arguments& a, Chance& c) {
            return a.window.size = c.bad_size(sizeof a.window), look_at_horizons(a);
        },
        [](Arguments& a, Chance& c) {
            const std::array<int, 5> bad{0, 2, -1, 721, std::numeric_limits<int>::max()};
            return a.horizon.directions = bad[static_cast<std::size_t>(c.below(5))], look_at_horizons(a);
        },
        [](Arguments& a, Chance& c) {
            const std::array<double, 5> bad{no_number, 0.0, -1.0, infinity, 500.1};
            return a.horizon.radius_km = bad[static_cast<std::size_t>(c.below(5))], look_at_horizons(a);
        },
        [](Arguments& a, Chance& c) {
            const std::array<double, 4> bad{no_number, -0.5, infinity, -infinity};
            return a.horizon.above_m = bad[static_cast<std::size_t>(c.below(4))], look_at_horizons(a);
        },
        [](Arguments& a, Chance& c) { return a.horizon.air = -1 - c.below(9), look_at_horizons(a); },
        [](Arguments& a, Chance& c) {
            const std::array<const char*, 4> bad{"8,46,9,47", "1,2,3", "here", "0,91,1,92"};
            return a.horizon.bbox = bad[static_cast<std::size_t>(c.below(4))], look_at_horizons(a);
        },
        [](Arguments& a, Chance&) { return oro_horizon_window(a.region, &a.horizon, nullptr); },
        [](Arguments& a, Chance&) {
            return oro_horizon(a.region, &a.horizon, nullptr, nullptr, 1U << 30U, &a.window, nullptr,
                               nullptr);
        },
    };
}

template <class Draw>
std::vector<Call> calls_about_pictures(Draw draw) {
    const auto with = [draw](std::vector<const char*> words) {
        return [draw, words](Arguments& a, Chance&) {
            return draw(a.region, words.size(), words.data(), a.rgba.data(), a.rgba.size(), &a.width_px,
                        &a.height_px, nullptr, nullptr);
        };
    };
    return {
        with({"--wrong"}),
        with({"--size"}),
        with({"--at", "36.55,-84.25", "--out", "/nowhere/p.png"}),
        with({"--at", "36.55,-84.25", "--bbox", "1,2,3,4"}),
        with({"--at", "\xff\xfe\x01"}),
        with({"--at", "1,2"}),
        with({"--help"}),
        with({"more.tif"}),
        with({nullptr}),
        with({"--at", "36.55,-84.25", "--tau", "nan"}),
        with({"--at", "36.55,-84.25", "--time", "never"}),
        [draw](Arguments& a, Chance& c) {
            return draw(c.bad_region(a.closed), 0, nullptr, a.rgba.data(), a.rgba.size(), &a.width_px,
                        &a.height_px, nullptr, nullptr);
        },
        [draw](Arguments& a, Chance& c) {
            const bool width = c.below(2) == 0;
            return draw(a.region, 0, nullptr, a.rgba.data(), a.rgba.size(), width ? nullptr : &a.width_px,
                        width ? &a.height_px : nullptr, nullptr, nullptr);
        },
        [draw](Arguments& a, Chance&) {
            return draw(a.region, 3, nullptr, a.rgba.data(), a.rgba.size(), &a.width_px, &a.height_px,
                        nullptr, nullptr);
        },
    };
}

std::vector<Call> calls_about_layers() {
    const auto find = [](Arguments& a, const oro_layers* layers) {
        return oro_shot_layers(a.region, 0, nullptr, layers, &a.width_px, &a.height_px, nullptr, nullptr);
    };
    return {
        [find](Arguments& a, Chance& c) {
            oro_layers layers{};
            layers.size = sizeof layers;
            a.region = c.bad_region(a.closed);
            return find(a, &layers);
        },
        [find](Arguments& a, Chance& c) {
            oro_layers layers{};
            layers.size = c.bad_size(sizeof layers);
            return find(a, &layers);
        },
        [find](Arguments& a, Chance&) { return find(a, nullptr); },
        // No room, and a layer that the view has not.
        [find](Arguments& a, Chance& c) {
            oro_layers layers{};
            layers.size = sizeof layers;
            layers.capacity = a.deficit_m.size();
            (c.below(2) == 0 ? layers.cover : layers.H_m) = a.deficit_m.data();
            return find(a, &layers);
        },
    };
}

std::vector<Call> all_calls() {
    std::vector<Call> calls = calls_about_regions();
    for (const auto& more :
         {calls_about_sights(), calls_about_profiles(), calls_about_viewsheds(), calls_about_horizons(),
          calls_about_layers(), calls_about_pictures(oro_shot), calls_about_pictures(oro_panorama)})
        calls.insert(calls.end(), more.begin(), more.end());
    return calls;
}

// Makes calls by turns, each wrong in one thing, and between them one that is right.
void make_calls(oro_region region, oro_region closed, unsigned seed, int count) {
    Chance chance(seed);
    const std::vector<Call> calls = all_calls();
    for (int i = 0; i < count; ++i) {
        const auto number = static_cast<std::size_t>(i) % calls.size();
        Arguments arguments(region, closed);
        const oro_status status = calls[number](arguments, chance);
        ASSERT_NE(status, ORO_OK) << "call " << number << ", seed " << seed;
        EXPECT_EQ(oro_error_code(), status);
        EXPECT_GT(std::strlen(oro_error_text()), 5U) << "call " << number;
        EXPECT_EQ(std::strchr(oro_error_text(), '\n'), nullptr) << oro_error_text();
        arguments.expect_untouched();
        Arguments right(region, closed);
        ASSERT_EQ(look(right), ORO_OK) << oro_error_text() << " after call " << number;
        EXPECT_STREQ(oro_error_text(), "");
        EXPECT_EQ(oro_error_code(), ORO_OK);
    }
}

TEST(LibraryCalls, AThousandBadOnesEndWithErrors) {
    const unsigned seed = std::random_device{}();
    std::printf("seed %u\n", seed);
    const oro_region region = open_bundled(), closed = open_bundled();
    ASSERT_EQ(oro_close(closed), ORO_OK);
    make_calls(region, closed, seed, 1000);
    EXPECT_EQ(oro_close(region), ORO_OK);
    EXPECT_EQ(oro_close(region), ORO_USAGE);
}

// It has no command line whose options could be named.
TEST(LibraryCalls, PathsOnANetworkAreRefusedInItsOwnWords) {
    for (const char* const path : {"/vsicurl/http://127.0.0.1:9/a.tif", "/vsis3/bucket/a.tif"}) {
        oro_region region = 0;
        EXPECT_EQ(oro_open(&path, 1, nullptr, nullptr, nullptr, &region), ORO_USAGE) << path;
        const std::string text = oro_error_text();
        EXPECT_NE(text.find("lies on a network, and only files of this machine are opened"),
                  std::string::npos)
            << text;
        EXPECT_EQ(text.find("--"), std::string::npos) << text;
    }
}

TEST(LibraryCalls, SeveralThreadsHaveErrorsOfTheirOwn) {
    const unsigned seed = std::random_device{}();
    std::printf("seed %u\n", seed);
    const oro_region region = open_bundled(), closed = open_bundled();
    ASSERT_EQ(oro_close(closed), ORO_OK);
    ASSERT_EQ(oro_close(0), ORO_USAGE);
    const std::string mine = oro_error_text();
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < 4; ++i) threads.emplace_back(make_calls, region, closed, seed + i, 150);
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(oro_error_text(), mine);
    // A region of one thread is closed by another.
    std::thread([&] { EXPECT_EQ(oro_close(region), ORO_OK); }).join();
    EXPECT_EQ(oro_close(region), ORO_USAGE);
}

// Opening reads files, by libraries that have a state of their own.
TEST(LibraryCalls, SeveralThreadsOpenAndLookAroundAtOnce) {
    const oro_region shared = open_bundled();
    Arguments first(shared, 0);
    ASSERT_EQ(look(first), ORO_OK) << oro_error_text();
    const auto open_and_ask = [&] {
        for (int i = 0; i < 4; ++i) {
            const oro_region own = open_bundled();
            for (const oro_region region : {own, shared}) {
                Arguments a(region, 0);
                EXPECT_EQ(look(a), ORO_OK) << oro_error_text();
                EXPECT_EQ(a.answer.target_deficit_m, first.answer.target_deficit_m);
                EXPECT_EQ(oro_viewshed_window(region, 1, &a.from, &a.viewshed, &a.window), ORO_OK);
                std::vector<float> deficit_m(a.window.rows * a.window.columns), observers(deficit_m.size());
                EXPECT_EQ(oro_viewshed(region, 1, &a.from, &a.viewshed, deficit_m.data(), observers.data(),
                                       deficit_m.size(), &a.window, nullptr, nullptr),
                          ORO_OK);
            }
            EXPECT_EQ(oro_close(own), ORO_OK);
        }
    };
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) threads.emplace_back(open_and_ask);
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(oro_close(shared), ORO_OK);
}

// Answers 1 to the second call, and counts them.
int stop_at_second(double share, const char* step, void* user) {
    EXPECT_GT(share, 0.0);
    EXPECT_LE(share, 1.0);
    EXPECT_GT(std::strlen(step), 5U);
    int& calls = *static_cast<int*>(user);
    return ++calls >= 2 ? 1 : 0;
}

TEST(LibraryCalls, HeightsAndProfilesAreStopped) {
    const oro_region region = open_bundled();
    constexpr std::size_t count = 2'000'000;
    const std::vector<double> lat_deg(count, 36.55), lon_deg(count, -84.25);
    std::vector<double> H_m(count, 1.0);
    int calls = 0;
    EXPECT_EQ(oro_heights_with_progress(region, count, lat_deg.data(), lon_deg.data(), H_m.data(), nullptr,
                                        stop_at_second, &calls),
              ORO_CANCELLED);
    // Others of the threads may be at work on a block of their own.
    EXPECT_GE(calls, 2);
    EXPECT_LT(calls, 100);
    EXPECT_EQ(H_m.back(), 1.0);

    Arguments a(region, 0);
    a.profile.step_m = 0.1;
    calls = 0;
    EXPECT_EQ(
        oro_profile_with_progress(region, 3, a.lat_deg.data(), a.lon_deg.data(), &a.profile, a.points.data(),
                                  a.points.size(), &a.count, &a.sums, stop_at_second, &calls),
        ORO_CANCELLED);
    EXPECT_EQ(calls, 2);
    a.expect_untouched();
    EXPECT_EQ(oro_close(region), ORO_OK);
}

TEST(LibraryCalls, NumbersOfClosedRegionsAreNotGivenAgain) {
    const oro_region first = open_bundled();
    ASSERT_EQ(oro_close(first), ORO_OK);
    const oro_region second = open_bundled();
    EXPECT_NE(first, second);
    EXPECT_EQ(oro_close(first), ORO_USAGE);
    EXPECT_EQ(oro_close(second), ORO_OK);
}

TEST(LibraryCalls, ASizeThatIsAskedForIsTheSizeThatIsTaken) {
    const oro_region region = open_bundled();
    std::size_t length = 0, again = 0;
    ASSERT_EQ(oro_info(region, nullptr, 0, &length), ORO_OK);
    std::vector<char> text(length + 1, 'x');
    EXPECT_EQ(oro_info(region, text.data(), length, &again), ORO_TOO_SMALL);
    EXPECT_EQ(again, length);
    ASSERT_EQ(oro_info(region, text.data(), text.size(), &again), ORO_OK);
    EXPECT_EQ(std::strlen(text.data()), length);

    Arguments a(region, 0);
    ASSERT_EQ(
        oro_profile(region, 3, a.lat_deg.data(), a.lon_deg.data(), nullptr, nullptr, 0, &a.count, nullptr),
        ORO_OK);
    std::vector<oro_profile_point> points(a.count);
    std::size_t count = 0;
    EXPECT_EQ(oro_profile(region, 3, a.lat_deg.data(), a.lon_deg.data(), nullptr, points.data(), a.count - 1,
                          &count, nullptr),
              ORO_TOO_SMALL);
    EXPECT_EQ(count, a.count);
    ASSERT_EQ(oro_profile(region, 3, a.lat_deg.data(), a.lon_deg.data(), nullptr, points.data(), a.count,
                          &count, nullptr),
              ORO_OK);
    EXPECT_EQ(points.back().lat_deg, a.lat_deg.back());

    ASSERT_EQ(oro_viewshed_window(region, 1, &a.from, &a.viewshed, &a.window), ORO_OK);
    const std::size_t posts = a.window.rows * a.window.columns;
    std::vector<float> deficit_m(posts + 1, 5.0F), observers(posts + 1, 5.0F);
    ASSERT_EQ(oro_viewshed(region, 1, &a.from, &a.viewshed, deficit_m.data(), observers.data(), posts,
                           &a.window, nullptr, nullptr),
              ORO_OK);
    EXPECT_EQ(deficit_m.back(), 5.0F);
    EXPECT_EQ(observers.back(), 5.0F);
    EXPECT_GT(a.window.seen, 0U);
    EXPECT_LE(a.window.seen, a.window.known);
    EXPECT_EQ(oro_close(region), ORO_OK);
}

// What a program that was compiled with the first version of the interface gives: it must be taken for as
// long as the library has that name. Sizes and offsets are those of x86-64 and Arm, 64 bits, as version 1 had
// them.
TEST(LibraryCalls, StructuresOfTheFirstVersionAreTaken) {
    EXPECT_EQ(offsetof(oro_open_options, canopy_held), 112U);
    EXPECT_EQ(offsetof(oro_point, above), 24U);
    EXPECT_EQ(offsetof(oro_position, h_m), 24U);
    EXPECT_EQ(offsetof(oro_sight_options, on_summit), 24U);
    EXPECT_EQ(offsetof(oro_sight_answer, without_data_m), 208U);
    EXPECT_EQ(sizeof(oro_profile_point), 40U);
    EXPECT_EQ(offsetof(oro_profile_options, climb_threshold_m), 16U);
    EXPECT_EQ(offsetof(oro_profile_sums, lowest), 64U);
    EXPECT_EQ(offsetof(oro_viewshed_options, targets_on_canopy), 44U);
    EXPECT_EQ(offsetof(oro_horizon_options, refraction_k), 48U);
    EXPECT_EQ(offsetof(oro_window, seen), 104U);
    EXPECT_EQ(offsetof(oro_layers, cover), 80U);
    const std::string path = (oro::test::bundled_data() / "jacksboro.tif").string();
    const char* const paths[] = {path.c_str()};
    oro_region region = 0;
    Arguments a(0, 0);
    a.open.size = 120;
    ASSERT_EQ(oro_open(paths, 1, &a.open, nullptr, nullptr, &region), ORO_OK) << oro_error_text();
    a.region = region;
    a.sight.size = 32;
    a.answer.size = 216;
    EXPECT_EQ(look(a), ORO_OK) << oro_error_text();
    a.profile.size = 24;
    a.sums.size = 72;
    EXPECT_EQ(
        oro_profile(region, 3, a.lat_deg.data(), a.lon_deg.data(), &a.profile, nullptr, 0, &a.count, &a.sums),
        ORO_OK)
        << oro_error_text();
    a.viewshed.size = 48;
    a.window.size = 112;
    EXPECT_EQ(oro_viewshed_window(region, 1, &a.from, &a.viewshed, &a.window), ORO_OK) << oro_error_text();
    a.horizon.size = 56;
    EXPECT_EQ(oro_horizon_window(region, &a.horizon, &a.window), ORO_OK) << oro_error_text();
    oro_layers layers{};
    layers.size = 88;
    EXPECT_EQ(oro_shot_layers(region, 0, nullptr, &layers, &a.width_px, &a.height_px, nullptr, nullptr),
              ORO_TOO_SMALL);
    EXPECT_EQ(oro_close(region), ORO_OK);
}

// A caller of a later version gives longer structures.
TEST(LibraryCalls, LongerStructuresAreTaken) {
    const oro_region region = open_bundled();
    Arguments a(region, 0);
    a.sight.size += 64;
    a.answer.size += 64;
    EXPECT_EQ(look(a), ORO_OK) << oro_error_text();
    EXPECT_EQ(oro_close(region), ORO_OK);
}

}  // namespace
