// Viewsheds held against lines of sight, post by post.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/base/elapsed.h"
#include "core/base/parallel.h"
#include "core/sight/viewshed.h"

namespace oro::test {

struct Tally {
    std::size_t posts{}, seen{}, differing{}, unknown{}, misses{};
    double worst_m{};
};

// Each post of the window by Observer; of each `stride`th hidden one also by how much it is missed.
inline Tally held_against_observer(const TrueSurface& surface, const ViewshedRequest& request,
                                   const Viewshed& shed, int stride) {
    const Observer observer(surface, request.eye, request.air);
    const GridPart& window = shed.window;
    std::vector<Tally> rows(static_cast<std::size_t>(window.rows));
    in_parallel(window.rows, thread_count(), [&](int i) {
        Tally& tally = rows[static_cast<std::size_t>(i)];
        for (int c = window.first_column; c < window.first_column + window.columns; ++c) {
            const int row = window.first_row + i;
            const float missed_m = shed.clearance_deficit_m[window.number(row, c)];
            if (missed_m == Viewshed::unknown) {
                ++tally.unknown;
                continue;
            }
            const Geodetic target = target_over_post(surface, row, c, request.target_m);
            ++tally.posts;
            const bool sees = observer.sees(target);
            tally.seen += sees;
            tally.differing += sees != (missed_m == 0.0F);
            if (sees || (row * 7 + c) % stride != 0) continue;
            const auto by_m = observer.clearance_deficit_m(target);
            if (!by_m || !std::isfinite(missed_m)) continue;
            ++tally.misses;
            tally.worst_m = std::max(
                tally.worst_m, std::abs(static_cast<double>(missed_m) - *by_m) / std::max(1.0, 1e-3 * *by_m));
        }
    });
    Tally sum;
    for (const Tally& row : rows) {
        sum.posts += row.posts;
        sum.seen += row.seen;
        sum.differing += row.differing;
        sum.unknown += row.unknown;
        sum.misses += row.misses;
        sum.worst_m = std::max(sum.worst_m, row.worst_m);
    }
    return sum;
}

inline Geodetic eye_over(const TrueSurface& surface, double lat_deg, double lon_deg, double above_m) {
    const auto h_m = surface.h_m(lat_deg, lon_deg);
    EXPECT_TRUE(h_m) << lat_deg << "," << lon_deg;
    return {lat_deg, lon_deg, h_m.value_or(0.0) + above_m};
}

inline void expect_observers(const char* name, const TrueSurface& surface, const ViewshedRequest& request,
                             std::size_t least_posts, double most_off_m = 0.1) {
    const auto begin = Clock::now();
    const Viewshed shed = viewshed(surface, 0, request);
    const double took_s = seconds_since(begin);
    const Tally tally = held_against_observer(surface, request, shed, 31);
    const double observer_s = seconds_since(begin) - took_s;
    std::printf(
        "%s: %zu posts, %zu seen, %zu differ; of %zu hidden ones missed by %.2e m off at most; the "
        "oracle was asked %zu times (%.3f %%); %.3f s, sight lines %.1f s\n",
        name, tally.posts, tally.seen, tally.differing, tally.misses, tally.worst_m, shed.asked,
        100.0 * static_cast<double>(shed.asked) / static_cast<double>(std::max<std::size_t>(1, tally.posts)),
        took_s, observer_s);
    EXPECT_GE(tally.posts, least_posts) << name;
    EXPECT_EQ(tally.differing, 0U) << name;
    EXPECT_LE(tally.worst_m, most_off_m) << name;
    EXPECT_GT(tally.seen, 0U) << name;
    EXPECT_LT(tally.seen, tally.posts) << name;
}

}  // namespace oro::test
