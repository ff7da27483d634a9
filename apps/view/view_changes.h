// What changed between a view that was written and what it is opened with now.
#pragma once

#include <string>
#include <vector>

#include "apps/view/view.h"

namespace oro {

// What a view's file tells of data, and what they are now, differ in.
enum class ChangeOf { data, geoid, program };

struct Change {
    ChangeOf of;
    Error line;  // for people: where, what
};

// All that differ; empty where nothing does, or where a view brings no fingerprints.
std::vector<Change> changes_of(const View& view);

// For commands that show something new whatever changed: says all of it, what cannot be checked, and whether
// the pixels of the picture that the view comes from were changed after it was drawn.
void say_changes(const View& view, bool quiet);

// The last of these alone.
void say_edited(const View& view, bool quiet);

// For commands that stand for the picture being the same: other data or another geoid are an error, all lines
// but its last said before, unless `data_changed`; the view then says so. All else is said.
// Data of another place altogether are no_data.
Result<void> check_unchanged(View& view, const Region& region, bool data_changed, bool quiet);

// True where a view comes from a picture, not from a .json.
bool is_from_picture(const View& view);

}  // namespace oro
