// The records that a picture asks for, before anybody draws it.
#pragma once

#include <stop_token>

#include "core/frame/casters.h"
#include "core/frame/frame_plan.h"
#include "core/frame/region_pages.h"

namespace oro {

// Asks pages for the records that plans of a view ask for, and of its light, so that they are known from then
// on (RegionPages::knows_record()) and plans do not wait for them. Ends early once `stop` is asked, after the
// record that it waits for. Takes what record() takes; for any thread. Errors: as plan_grid() and record().
Result<void> make_records_ahead(const RegionPages& pages, const FrameView& view, const ShadowRequest& light,
                                const std::stop_token& stop);

}  // namespace oro
