// What a user must know of a region, one line each.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace oro {

// Adds a line that is not there yet and not empty.
inline void add_note(std::vector<std::string>& notes, const std::string& note) {
    if (!note.empty() && std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
}

}  // namespace oro
