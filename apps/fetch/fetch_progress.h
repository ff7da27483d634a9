// How far the fetching of tiles has come, for people.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace oro {

struct FetchProgress {
    std::size_t done{};     // tiles: fetched, kept, missing or failed
    std::size_t all{};      // tiles
    std::uint64_t bytes{};  // that were fetched
    double seconds{};       // since the first request
};

// "3 of 8 tiles, 25.1 MB, 2.1 MB/s"; without the rate in the first moments, and where nothing has come.
std::string fetch_progress_words(const FetchProgress& progress);

// "25.1 MB", of a million bytes each.
std::string megabytes_text(std::uint64_t bytes);

}  // namespace oro
