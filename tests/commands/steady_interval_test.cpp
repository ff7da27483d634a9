// The interval of contour lines while the eye of a window moves.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "apps/styles/contour_interval.h"

namespace oro {
namespace {

// The rule of a moving eye: an interval that wavers between two steps stays, one that goes through all of
// them changes with it, by two steps at a time; nothing that is shown is off by more than one step.
TEST(SteadyInterval, StaysWhileTheViewWavers) {
    double shown_m = 0.0;
    int changes = 0;
    const auto show = [&](double wanted_m) {
        const double next_m = steady_interval_m(shown_m, wanted_m);
        changes += next_m != shown_m ? 1 : 0;
        shown_m = next_m;
    };
    show(20.0);
    EXPECT_EQ(shown_m, 20.0) << "nothing was shown before";
    for (int i = 0; i < 100; ++i) show(i % 2 == 0 ? 50.0 : 20.0);
    for (int i = 0; i < 100; ++i) show(i % 2 == 0 ? 10.0 : 20.0);
    EXPECT_EQ(changes, 1);
    const std::vector<double> steps_m{1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000};
    changes = 0;
    for (const double wanted_m : steps_m) {
        for (int i = 0; i < 10; ++i) show(wanted_m);
        EXPECT_LE(std::max(wanted_m / shown_m, shown_m / wanted_m), 2.5 + 1e-9) << wanted_m;
    }
    EXPECT_LE(changes, 6);
    for (int i = 0; i < 50; ++i) {  // and to and fro over any border
        show(5000.0);
        show(2000.0);
    }
    EXPECT_LE(changes, 7);
}

}  // namespace
}  // namespace oro
