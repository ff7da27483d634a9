// What the command line says, to commands that read elevation, of data that are not on this machine yet.
#pragma once

#include <string>

namespace oro {

struct FetchingOptions {
    std::string source;  // of tiles that are fetched where data are missing; "": none
    double km{30.0};     // around places
    bool network{};      // paths may lie on a network
};

}  // namespace oro
