#include "apps/report/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/result.h"

namespace oro {
using std::chrono::steady_clock;

ProgressBar::ProgressBar(bool quiet)
    : start_(steady_clock::now()), last_(start_), enabled_(!quiet && isatty(STDERR_FILENO)) {}

ProgressBar::~ProgressBar() {
    clear();
}

void ProgressBar::show(double share, const std::string& what) {
    const auto now = steady_clock::now();
    if (!enabled_ || now - start_ < std::chrono::seconds(1) || now - last_ < std::chrono::milliseconds(100))
        return;
    last_ = now;
    shown_ = true;
    constexpr int width = 30;
    const int filled = static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * width));
    std::fprintf(stderr, "\r\033[K[%s%s] %3.0f %% %.60s",
                 std::string(static_cast<std::size_t>(filled), '#').c_str(),
                 std::string(static_cast<std::size_t>(width - filled), '.').c_str(), 100.0 * share,
                 one_line(what).c_str());
    std::fflush(stderr);
}

Progress ProgressBar::progress() {
    return [this](double share, const std::string& what) { show(share, what); };
}

void ProgressBar::clear() {
    if (!shown_) return;
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    shown_ = false;
    start_ = steady_clock::now();
}

void say(bool quiet, const std::string& line) {
    if (!quiet) std::fprintf(stderr, "orograph: %s\n", one_line(line).c_str());
}

}  // namespace oro
