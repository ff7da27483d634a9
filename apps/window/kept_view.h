// What of a view holds on where a window's user opens another region.
#pragma once

#include "apps/options/options.h"
#include "apps/view/view.h"

namespace oro {

// The options that another region is opened with, of a window that shows `shown`: those of the window, but
// for what says where its own data and eye are; the size, the angle of view, the heights' factor and the
// canopy are those that are shown.
WindowOptions options_for_other_region(const WindowOptions& options, const View& shown,
                                       const std::vector<std::string>& paths);

// open_flight() with such options. A canopy that is known nowhere over the other region is left out, and the
// options have none then. Errors: those of open_flight().
Result<void> open_other_region(WindowOptions& options, const Progress& progress, View& view, Region& region);

// Puts into the view of another region, as open_view() made it with those options, what its user chose for
// the one that is shown: style and light, tau, the air, names, lines and images, which are not read again.
// Eye, data and the model of the Earth are its own.
void keep_choices(const View& shown, View& view);

}  // namespace oro
