#include "apps/fetch/fetch_progress.h"

#include <cstdio>

namespace oro {

std::string fetch_progress_words(const FetchProgress& progress) {
    constexpr double least_seconds = 0.2;  // before that a rate says nothing
    std::string words = std::to_string(progress.done) + " of " + std::to_string(progress.all) + " tiles, " +
                        megabytes_text(progress.bytes);
    if (progress.bytes == 0 || progress.seconds < least_seconds) return words;
    char rate[40];
    std::snprintf(rate, sizeof rate, ", %.1f MB/s",
                  static_cast<double>(progress.bytes) / 1e6 / progress.seconds);
    return words + rate;
}

std::string megabytes_text(std::uint64_t bytes) {
    char text[40];
    std::snprintf(text, sizeof text, "%.1f MB", static_cast<double>(bytes) / 1e6);
    return text;
}

}  // namespace oro
