// A long flight in a window with panels open: no message of the validation layer, and nothing that grows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::Words;

// What the program's process holds after a turn of the flight.
struct Turn {
    int seconds{};
    double resident_kb{};
    double files{};
    double threads{};
};

std::vector<Turn> turns_of(const std::string& printed) {
    std::vector<Turn> turns;
    std::istringstream lines(printed);
    std::string word;
    for (Turn turn; lines >> word >> turn.seconds >> turn.resident_kb >> turn.files >> turn.threads;)
        turns.push_back(turn);
    return turns;
}

// The median over some of the turns, parts of all of them.
double median(const std::vector<Turn>& turns, double from, double to, double Turn::*value) {
    const auto at = [&](double part) {
        return static_cast<std::size_t>(part * static_cast<double>(turns.size()));
    };
    std::vector<double> values;
    for (std::size_t i = at(from); i < at(to); ++i) values.push_back(turns[i].*value);
    std::ranges::sort(values);
    return values[values.size() / 2];
}

// Flies so many seconds over a region. `more`: the share by which memory may grow from the middle of the
// flight to its end.
void fly(int seconds, const Words& paths, const std::string& places, double more) {
    oro::test::Circumstances there;
    there.folder = oro::test::scratch_folder();
    there.environment = {"SCREEN_SIZE=960x540", "WAYLAND_DISPLAY", "OROGRAPH_VALIDATION=1",
                         "FLIGHT_PLACES=" + places};
    Words words{OROGRAPH_ON_DISPLAY, OROGRAPH_WINDOW_FLIGHT, OROGRAPH_PROGRAM, std::to_string(seconds)};
    words.insert(words.end(), paths.begin(), paths.end());
    const auto flight = oro::test::run_program(words, there);
    ASSERT_EQ(flight.exit_code, 0) << flight.out << flight.err;
    const std::vector<Turn> turns = turns_of(flight.out);
    ASSERT_GE(turns.size(), 4U) << flight.out;
    const auto grows = [&](double Turn::*value) {
        return median(turns, 0.75, 1.0, value) / median(turns, 0.5, 0.75, value) - 1.0;
    };
    std::printf("%zu turns in %d s; resident memory %.1f MB, %+.2f %%; files %+.2f %%; threads %+.2f %%\n",
                turns.size(), turns.back().seconds, median(turns, 0.75, 1.0, &Turn::resident_kb) / 1000.0,
                100.0 * grows(&Turn::resident_kb), 100.0 * grows(&Turn::files),
                100.0 * grows(&Turn::threads));
    EXPECT_LE(grows(&Turn::resident_kb), more) << flight.out;
    EXPECT_LE(grows(&Turn::files), 0.0) << flight.out;
    EXPECT_LE(grows(&Turn::threads), 0.0) << flight.out;
}

// So short a flight sees its caches fill.
TEST(WindowFlight, AMinuteOverTheAlps) {
    const auto data = oro::test::real_data("alps");
    if (!data) GTEST_SKIP() << "needs alps";
    fly(60, {data->string()}, "46.54,8.00 46.02,7.70 46.90,9.30 47.20,7.50", 0.1);
}

// OROGRAPH_FLIGHT_MINUTES: how long, else 10.
TEST(WindowFlight, MinutesOverPoland) {
    const auto data = oro::test::real_data("poland");
    if (!data) GTEST_SKIP() << "needs poland";
    const char* const asked = std::getenv("OROGRAPH_FLIGHT_MINUTES");
    const int minutes = asked != nullptr ? std::atoi(asked) : 10;
    const fs::path baked = oro::test::scratch_folder() / "poland.oro";
    const auto bake = oro::test::run_orograph({"bake", data->string(), "--out", baked, "-q"});
    ASSERT_EQ(bake.exit_code, 0) << bake.err;
    fly(60 * minutes, {baked}, "49.20,20.05 50.10,15.60 52.20,21.00 54.10,18.20 50.90,22.40 51.10,13.20",
        0.02);
    fs::remove(baked);
}

}  // namespace
