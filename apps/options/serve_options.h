// What the command line says to serve.
#pragma once

#include <string>

namespace oro {

struct ServeOptions {
    std::string folder;
    std::string host{"127.0.0.1"};
    int port{8080};          // 0: any that is free
    bool any_origin{false};  // pages of other sites may read what is served
    bool quiet{false};
};

}  // namespace oro
