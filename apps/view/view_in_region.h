// A view of a region that is open already.
#pragma once

#include "apps/view/view.h"

namespace oro {

// The view that options ask for, as open_view() makes it, of a region that was opened for that request and is
// as open_region() gave it. The region becomes that of the view. Errors: those of open_view(), but for those
// of reading.
Result<void> open_view_in_region(const ViewOptions& options, const RegionRequest& request, View& view,
                                 Region& region);

}  // namespace oro
