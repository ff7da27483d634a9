// What the command line says to batch.
#pragma once

#include <string>

namespace oro {

struct BatchOptions {
    std::string jobs;   // the list's file
    std::string each;   // a file of places; "": none
    std::string shard;  // "", or "2/4"
    std::string log;    // "": beside the list
    bool check{false};
    bool overwrite{false};
    bool json{false};
    bool quiet{false};
};

}  // namespace oro
