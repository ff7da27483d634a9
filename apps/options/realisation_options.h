// What the command line says of realisations: ground as it may truly be.
#pragma once

#include <optional>

namespace oro {

struct RealisationOptions {
    std::optional<int> count;             // 2 to 10,000; nothing: none
    std::optional<double> le90_m;         // the bound of 90 % of height errors
    std::optional<double> correlation_m;  // distance over which errors' correlation falls to 1 / e
    std::optional<int> seed;
    std::optional<int> finer;  // posts of realisations in place of one, each way, 1 to 4; nothing: 1
};

}  // namespace oro
