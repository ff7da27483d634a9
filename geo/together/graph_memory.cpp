#include "geo/together/graph_memory.h"

#include <cstdio>

#include "core/base/system_room.h"

namespace oro {
namespace {

constexpr std::uint64_t bytes_besides = 100'000'000;
// Measured over scans: docs/notes/2026-11-30-baking-meshes-by-boxes.md,
// 2026-11-30-writing-meshes-from-files.md.
constexpr std::uint64_t graph_bytes_a_triangle = 750, bake_bytes_a_triangle = 12;

// what: is done; advice: where there is too little memory for it.
Result<void> check(const std::string& path, std::uint64_t triangles, std::uint64_t memory_bytes,
                   std::uint64_t bytes_a_triangle, const char* what, const char* advice) {
    const std::uint64_t there = memory_bytes > 0 ? memory_bytes : machine_memory_bytes().value_or(0);
    const std::uint64_t needed = bytes_besides + bytes_a_triangle * triangles, most = there / 4 * 3;
    if (there == 0 || needed <= most) return {};
    const std::uint64_t fitting = most > bytes_besides ? (most - bytes_besides) / bytes_a_triangle : 0;
    constexpr double gb = 1.0e9;
    char text[300];
    std::snprintf(text, sizeof text,
                  "%s its %llu triangles needs %.1f GB of memory, and this machine has %.1f GB, enough for "
                  "%llu: %s",
                  what, static_cast<unsigned long long>(triangles), static_cast<double>(needed) / gb,
                  static_cast<double>(there) / gb, static_cast<unsigned long long>(fitting), advice);
    return Error{ErrorKind::failed, path, text};
}

}  // namespace

std::uint64_t graph_bytes(std::uint64_t triangles) {
    return bytes_besides + graph_bytes_a_triangle * triangles;
}

std::uint64_t bake_bytes(std::uint64_t triangles) {
    return bytes_besides + bake_bytes_a_triangle * triangles;
}

Result<void> check_graph_memory(const std::string& path, std::uint64_t triangles,
                                std::uint64_t memory_bytes) {
    return check(path, triangles, memory_bytes, graph_bytes_a_triangle, "building the cluster graph of",
                 "bake it, which takes less, or give a part of the mesh");
}

Result<void> check_bake_memory(const std::string& path, std::uint64_t triangles, std::uint64_t memory_bytes) {
    return check(path, triangles, memory_bytes, bake_bytes_a_triangle, "baking",
                 "give a part of the mesh, or bake it on a larger machine");
}

}  // namespace oro
