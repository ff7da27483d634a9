// The graph of a region of any size: its first levels window by window, the rest over what these leave.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/cluster_windows/region_windows.h"
#include "core/terrain/post_grid.h"

namespace oro {

struct WindowedBake {
    std::string path;             // of the cluster file; windows lie beside it until they are put together
    std::uint64_t fingerprint{};  // of the region whose posts these are
    bool overwrite{};
    int threads{1};
    // Windows of the first levels, then those of the next over what these have left, and so on: margins are
    // as wide as tiles of the levels that are built at once, and the fewer triangles are left, the more posts
    // a window may have. Each stage's `above` follows from the one before it.
    std::vector<WindowSizes> stages{{.levels = 4}, {.levels = 8, .posts = 30'000'000}};
    // Told what is done of all windows, 0..1.
    std::function<void(double share)> progress{};
};

// The name of a window's file.
[[nodiscard]] std::string path_of_window(const std::string& path, std::size_t number);

// Writes the graph of a field that does not go round the Earth and whose posts lie on latitudes and
// longitudes: the bytes that the graph in one go would be written as, whatever the windows. Windows that an
// earlier go has left behind are taken. Memory: what one window takes (some 100 bytes a post of it), or 5
// bytes a post of the region and some 60 for each triangle that windows leave at their last level. Errors:
// as write_cluster_graph(); windows that are damaged, or do not agree.
Result<void> bake_in_windows(const HeightField& field, const WindowedBake& how);

// Builds every count-th of the first stage's windows, from window number - 1 on (number: 1 .. count), and
// leaves them for bake_in_windows() of the same region, which takes them. Gives their number; none where the
// region is built in one go. Errors: as bake_in_windows().
Result<std::size_t> bake_windows_of_part(const HeightField& field, const WindowedBake& how,
                                         std::size_t number, std::size_t count);

}  // namespace oro
