#include "geo/region/region.h"

namespace oro {

Result<void> Region::health() const {
    ORO_CHECK(field.health());
    for (const Region& other : beside) ORO_CHECK(other.field.health());
    return {};
}

}  // namespace oro
