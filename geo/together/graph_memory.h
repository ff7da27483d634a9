// What building the cluster graph of a mesh takes of a machine's memory.
#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.h"

namespace oro {

// What building takes at most, all that is in memory then (measured: 1.1 KB a triangle of a scan).
std::uint64_t graph_bytes(std::uint64_t triangles);

// Errors: that is more than three quarters of the machine's memory; it tells both. path: of the mesh.
// memory_bytes: of the machine; 0: as the system says.
Result<void> check_graph_memory(const std::string& path, std::uint64_t triangles,
                                std::uint64_t memory_bytes = 0);

}  // namespace oro
