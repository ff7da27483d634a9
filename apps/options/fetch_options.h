// What the command line says to `fetch`.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace oro {

struct FetchOptions {
    std::string source;
    std::vector<std::string> tiles;
    std::string bbox;
    std::string out;           // a folder; of places, a file
    std::string sources_file;  // a table of the user's, or ""
    std::string key_file;      // with the user's key, or ""
    int retries{4};
    int jobs{4};
    std::optional<double> cache_limit_gb;
    bool cache{};  // tells of the cache alone
    bool dry_run{};
    bool overwrite{};  // of places
    bool json{};
    bool quiet{};
};

}  // namespace oro
