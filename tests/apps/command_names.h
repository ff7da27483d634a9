// The commands of the program, in the order in which help lists them.
#pragma once

#include "tests/apps/program.h"

namespace oro::test {

inline const Words& command_names() {
    static const Words names{"shot",  "panorama", "film",    "view",     "compare", "plan", "trade",
                             "sun",   "sight",    "profile", "viewshed", "horizon", "bake", "export",
                             "batch", "serve",    "info",    "fetch",    "doctor"};
    return names;
}

// As a message lists them: "shot, panorama ... and doctor".
inline std::string list_of_commands() {
    const Words& names = command_names();
    std::string list = names.front();
    for (std::size_t i = 1; i < names.size(); ++i)
        list += (i + 1 == names.size() ? " and " : ", ") + names[i];
    return list;
}

}  // namespace oro::test
