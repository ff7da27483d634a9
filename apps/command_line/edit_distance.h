// How unlike two words are.
#pragma once

#include <cstddef>
#include <string_view>

namespace oro {

// How many characters must be put in, left out or changed, or swap with their neighbour, to make one word of
// the other. Of bytes.
// Source: F. J. Damerau, A technique for computer detection and correction of spelling errors, Communications
// of the ACM 7(3), 1964, in which no part is changed twice.
std::size_t edit_distance(std::string_view from, std::string_view to);

}  // namespace oro
