// Places of the lattice as keys of a hash table.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/mesh_file/stored_mesh.h"

namespace oro {

struct PlaceHash {
    std::size_t operator()(const LatticeSteps& at) const {
        std::uint64_t sum = 0;
        for (const std::int64_t step : at) {
            // The finaliser of SplitMix64 (Steele, Lea and Flood, 2014).
            sum += static_cast<std::uint64_t>(step) + 0x9e3779b97f4a7c15U;
            sum = (sum ^ (sum >> 30U)) * 0xbf58476d1ce4e5b9U;
            sum = (sum ^ (sum >> 27U)) * 0x94d049bb133111ebU;
            sum ^= sum >> 31U;
        }
        return sum;
    }
};

}  // namespace oro
