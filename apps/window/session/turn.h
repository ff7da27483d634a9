// One turn of a window's loop: input, a picture where something has changed, and what lies over it.
#pragma once

#include "apps/window/interface.h"
#include "apps/window/viewer.h"

namespace oro {

// What a loop knows from one turn to the next.
struct Session {
    Viewer& viewer;
    Interface& interface;
    bool changed{true};               // another picture is wanted
    int frames_due{2};                // panels to be shown again, also where nothing else changes
    bool looks_under_pointer{false};  // what is there is not known any more
};

// False when the user leaves.
Result<bool> turn(Session& session);

}  // namespace oro
