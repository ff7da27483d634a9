#include "geo/together/graph_memory.h"

#include <cstdio>

#include "core/base/system_room.h"

namespace oro {

std::uint64_t graph_bytes(std::uint64_t triangles) {
    constexpr std::uint64_t bytes_a_triangle = 1200, bytes_besides = 100'000'000;
    return bytes_besides + bytes_a_triangle * triangles;
}

Result<void> check_graph_memory(const std::string& path, std::uint64_t triangles,
                                std::uint64_t memory_bytes) {
    const std::uint64_t there = memory_bytes > 0 ? memory_bytes : machine_memory_bytes().value_or(0);
    const std::uint64_t needed = graph_bytes(triangles);
    if (there == 0 || needed <= there / 4 * 3) return {};
    const double gb = 1.0e9, most = 0.75 * static_cast<double>(there);
    const double fitting =
        (most - static_cast<double>(graph_bytes(0))) / static_cast<double>(graph_bytes(1) - graph_bytes(0));
    char text[300];
    std::snprintf(
        text, sizeof text,
        "building the cluster graph of its %llu triangles needs %.1f GB of memory, and this machine "
        "has %.1f GB, enough for %llu: give a part of the mesh, or bake it on a larger machine",
        static_cast<unsigned long long>(triangles), static_cast<double>(needed) / gb,
        static_cast<double>(there) / gb, static_cast<unsigned long long>(fitting > 0.0 ? fitting : 0.0));
    return Error{ErrorKind::failed, path, text};
}

}  // namespace oro
