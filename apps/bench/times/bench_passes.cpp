#include "apps/bench/times/bench_passes.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/bench/times/bench_random.h"
#include "apps/bench/times/bench_times.h"
#include "core/base/median.h"

namespace oro {

using nlohmann::ordered_json;

void TimesOfPasses::add(std::span<const PassTime> passes) {
    ++count_;
    for (const PassTime& one : passes) {
        const auto known = std::ranges::find_if(times_, [&](const auto& of) { return of.first == one.pass; });
        if (known == times_.end())
            times_.push_back({one.pass, {one.s}});
        else
            known->second.push_back(one.s);
    }
}

std::vector<PassTime> TimesOfPasses::medians() const {
    std::vector<PassTime> medians;
    for (const auto& [pass, times] : times_) medians.push_back({pass, median_of(std::vector<double>(times))});
    return medians;
}

std::vector<std::pair<std::string, std::vector<double>>> TimesOfPasses::all() const {
    auto all = times_;
    for (auto& [pass, times] : all) times.resize(count_);
    return all;
}

ordered_json passes_of_eyes(std::span<const BenchTimes> eyes, bool as_json) {
    TimesOfPasses passes;
    for (const BenchTimes& eye : eyes) passes.add(eye.passes);
    ordered_json json = ordered_json::object();
    if (!as_json) std::printf("  %-28s %8s %8s %8s ms\n", "pass", "median", "95 %", "worst");
    for (const auto& [pass, times] : passes.all()) {
        const SpreadOfEyes spread = spread_of(times);
        json[pass] = {{"median_ms", 1e3 * spread.median},
                      {"at_95_percent_ms", 1e3 * spread.high},
                      {"worst_ms", 1e3 * spread.worst}};
        if (!as_json)
            std::printf("  %-28s %8.3f %8.3f %8.3f\n", pass.c_str(), 1e3 * spread.median, 1e3 * spread.high,
                        1e3 * spread.worst);
    }
    return json;
}

}  // namespace oro
