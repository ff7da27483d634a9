// Any bytes as a place: a place within its ranges, or one line of usage error.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "geo/places/place.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto place = oro::parse_place(std::string(reinterpret_cast<const char*>(data), size));
    if (place.ok()) {
        const bool within = std::abs(place->lat_deg) <= 90 && place->lon_deg > -180 && place->lon_deg <= 180;
        const bool height = !place->height_m || std::isfinite(*place->height_m);
        if (!within || !height || place->form.empty()) std::abort();
        return 0;
    }
    if (place.error().kind != oro::ErrorKind::usage || place.error().what.empty()) std::abort();
    for (const char c : place.error().line())
        if (static_cast<unsigned char>(c) < 0x20) std::abort();
    return 0;
}
