// The horizon around one place, azimuth by azimuth, as a table.
#pragma once

#include "apps/options/horizon_options.h"
#include "core/base/result.h"

namespace oro {

// Prints how high the horizon stands around the place of --at in each azimuth, how far away and where it is;
// the horizon is that of horizon_by_lines_deg(). With --out also writes it as a .csv. Errors: those of the
// options, of the place, of reading, and of writing.
Result<void> run_horizon_around(const HorizonOptions& options);

}  // namespace oro
