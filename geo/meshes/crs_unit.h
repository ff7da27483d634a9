// The unit of a CRS's axes.
#pragma once

#include <optional>
#include <string>

namespace oro {

// Metres of a projected CRS's unit, of a compound one that of its horizontal part, by PROJ; nothing of one in
// degrees, or that PROJ does not know. From any thread.
std::optional<double> crs_unit_m(const std::string& crs);

}  // namespace oro
