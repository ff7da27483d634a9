// What people see while something takes its time: on standard error, never on standard output.
#pragma once

#include <chrono>
#include <string>

#include "core/base/progress.h"

namespace oro {

// A bar on a terminal for steps that take over a second; nothing where standard error is no terminal, or when
// quiet.
class ProgressBar {
  public:
    explicit ProgressBar(bool quiet);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    void show(double share, const std::string& what);
    // What reading reports goes to this bar, which outlives it.
    [[nodiscard]] Progress progress();
    void clear();

  private:
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point last_;
    bool shown_{false};
    bool enabled_;
};

// A line for a person on standard error, unless quiet.
void say(bool quiet, const std::string& line);

}  // namespace oro
