// How far into a window of a surface it is felt that what lies beyond is not known.
#pragma once

#include <vector>

#include "core/clusters/group_assignment.h"

namespace oro {

// A group is whole when nothing that decides what becomes of it depends on what lies beyond the window: no
// vertex of it is open or was touched by a group that is not whole, and no such group reaches near its tile.
// With more levels the groups that are not whole reach farther into the window.
class OpenBorder {
  public:
    explicit OpenBorder(const OriginalSurface& surface);

    // 1 for each group of a level that is whole; all are where the surface is no window. Parts: what the
    // groups of the last level made.
    [[nodiscard]] std::vector<char> complete_groups(const GroupAssignment& assignment,
                                                    GroupAssignment::Parts parts) const;
    // What the groups of the level have made, by group.
    void reach(GroupAssignment::Parts made, const std::vector<char>& whole);

  private:
    const OriginalSurface& surface_;
    std::vector<char> touched_;      // by vertex; empty where there is nothing open
    std::vector<PlaneBox> reached_;  // by groups of the last level that are not whole
};

}  // namespace oro
