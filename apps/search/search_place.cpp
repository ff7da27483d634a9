#include "apps/search/search_place.h"

#include <algorithm>
#include <cmath>

namespace oro {

double importance_of(const SearchPlace& place) {
    if (place.kind == PlaceClass::settlement && place.population > 0.0)
        return 1000.0 * std::log10(std::max(place.population, 1.0));
    return place.H_m.value_or(0.0);
}

}  // namespace oro
