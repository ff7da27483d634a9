// What the command line says to bake, of a region that several machines bake together.
#pragma once

#include <string>

#include "apps/options/options.h"

namespace oro {

struct BakePartOptions : BakingOptions {
    std::string shard;  // "", or "2/4": writes that part alone
    bool join{false};   // bakes from the parts that are there
};

}  // namespace oro
