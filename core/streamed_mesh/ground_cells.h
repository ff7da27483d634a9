// Which cells of a region's grids the ground below a mesh's small parts lies in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace oro {

struct GroundCells {
    // Cells of a row one after another; at least one.
    struct Run {
        std::uint32_t row{}, column{}, count{};
        bool operator==(const Run&) const = default;
    };
    struct Grid {
        std::uint64_t posts{};  // tells where its posts lie (fingerprint_of_posts())
        std::vector<Run> runs;  // by rows and columns, and apart from each other
        bool operator==(const Grid&) const = default;
    };
    // Of all places of the parts. Grids that do not reach into it are not among `grids`.
    double south_deg{}, north_deg{}, west_deg{}, east_deg{};
    std::vector<Grid> grids;  // in the order of the region's

    [[nodiscard]] std::size_t count() const;  // cells of all grids
    bool operator==(const GroundCells&) const = default;
};

// What bytes hold at most, of all grids together.
inline constexpr std::size_t most_ground_cells = 4'000'000, most_ground_grids = 4096;

// Of cells within these bounds. The same cells give the same bytes.
[[nodiscard]] std::vector<std::byte> ground_cells_to_bytes(const GroundCells& cells);
// The inverse. Any bytes may be given: nothing when they are cells in order, within the bounds; else what is
// wrong with them, in words that follow "the mesh".
[[nodiscard]] std::optional<std::string> ground_cells_from_bytes(std::span<const std::byte> bytes,
                                                                 GroundCells& cells);

}  // namespace oro
