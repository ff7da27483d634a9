// What the command line says to `fetch`.
#pragma once

#include <string>
#include <vector>

namespace oro {

struct FetchOptions {
    std::string source;
    std::vector<std::string> tiles;
    std::string bbox;
    std::string out;           // a folder; of places, a file
    std::string sources_file;  // a table of the user's, or ""
    int retries{4};
    int jobs{4};
    bool dry_run{};
    bool overwrite{};  // of places
    bool json{};
    bool quiet{};
};

}  // namespace oro
