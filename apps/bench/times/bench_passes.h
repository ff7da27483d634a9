// Times of a frame's passes, over frames and over eyes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/device/pass_times.h"

namespace oro {

struct BenchTimes;

// What each kind of pass took in several frames, or of several eyes.
class TimesOfPasses {
  public:
    void add(std::span<const PassTime> passes);
    // Of those that had the pass, in the order in which they came first.
    [[nodiscard]] std::vector<PassTime> medians() const;
    // All times of each kind, seconds; 0 of what did not have it.
    [[nodiscard]] std::vector<std::pair<std::string, std::vector<double>>> all() const;

  private:
    std::size_t count_{};  // of what was added
    std::vector<std::pair<std::string, std::vector<double>>> times_;
};

// Over eyes: of each pass the median, 95 % of them and the worst, milliseconds. Eyes without the pass count
// as 0. Prints a table of them, unless that is left to a JSON object.
nlohmann::ordered_json passes_of_eyes(std::span<const BenchTimes> eyes, bool as_json);

}  // namespace oro
