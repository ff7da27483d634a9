// In which order files lie over each other: pure, tested without a window.
#pragma once

#include <string>
#include <vector>

namespace oro {

// The files that a panel lists, from the top down: those that are on, the last of which lies on top, and then
// those that are known and off, in the order in which they became known.
std::vector<std::string> layers_from_the_top(const std::vector<std::string>& known,
                                             const std::vector<std::string>& on);
// Moves one that is on up or down by one place; true where it has moved.
bool move_layer(std::vector<std::string>& on, const std::string& file, bool up);

}  // namespace oro
