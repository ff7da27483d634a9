#include "geo/region/region.h"

namespace oro {

Result<void> Region::health() const {
    for (const RegionGrid& grid : grids) ORO_CHECK(grid.field.health());
    return {};
}

}  // namespace oro
