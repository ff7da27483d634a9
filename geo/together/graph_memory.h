// What building the cluster graph of a mesh takes of a machine's memory.
#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.h"

namespace oro {

// What building takes at most where all of it is in memory, all else that is in memory then with it.
std::uint64_t graph_bytes(std::uint64_t triangles);
// What baking takes at most of the process's own memory, where all that is of the mesh's size lies in scratch
// files (write_baked_mesh(), open_region_in_scratch()).
std::uint64_t bake_bytes(std::uint64_t triangles);

// Errors: that is more than three quarters of the machine's memory; it tells both. path: of the mesh.
// memory_bytes: of the machine; 0: as the system says.
Result<void> check_graph_memory(const std::string& path, std::uint64_t triangles,
                                std::uint64_t memory_bytes = 0);
Result<void> check_bake_memory(const std::string& path, std::uint64_t triangles,
                               std::uint64_t memory_bytes = 0);

}  // namespace oro
