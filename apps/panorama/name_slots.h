// Where names stand side by side above a panorama: as near to their summits as there is room.
#pragma once

#include <optional>
#include <vector>

namespace oro {

// The row that names stand in.
struct SlotRow {
    double low_px{};       // no slot is left of this
    double high_px{};      // or right of this
    double apart_px{};     // the least distance between two slots
    double farthest_px{};  // the most that a slot may be from its place
};

// A slot for each place, or none where there is no room. `places_px` come by rank: who comes first has a slot
// for certain if any can have one. Slots stand in the order of their places, so that lines from one to the
// other do not cross; of all such slots they are those whose squared distances from their places have the
// least sum.
std::vector<std::optional<double>> name_slots(const std::vector<double>& places_px, const SlotRow& row);

}  // namespace oro
