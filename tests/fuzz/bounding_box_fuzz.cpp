// Any bytes as a bounding box, a range of tiles and the name of a tile: values within their ranges, or one
// line of usage error.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "geo/region/region.h"
#include "geo/sources/hgt_source.h"

namespace {

void check(const oro::Result<oro::BoundingBox>& box) {
    if (box.ok()) {
        const bool lat = box->south_deg >= -90 && box->north_deg <= 90 && box->south_deg < box->north_deg;
        const bool lon = std::abs(box->west_deg) <= 180 && std::abs(box->east_deg) <= 180 &&
                         box->west_deg != box->east_deg;
        if (!lat || !lon) std::abort();
        return;
    }
    if (box.error().kind != oro::ErrorKind::usage || box.error().what.empty()) std::abort();
    for (const char c : box.error().line())
        if (static_cast<unsigned char>(c) < 0x20) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    check(oro::parse_bounding_box(text));
    check(oro::parse_tile_range(text));
    if (const auto tile = oro::parse_tile_name(text)) {
        const auto again = oro::parse_tile_name(oro::tile_name(tile->lat_deg, tile->lon_deg));
        if (!again || again->lat_deg != tile->lat_deg || again->lon_deg != tile->lon_deg) std::abort();
    }
    if (const auto name = oro::parse_hgt_name(text)) {
        if (name->tile.lat_deg < -90 || name->tile.lat_deg > 89 || name->tile.lon_deg < -180 ||
            name->tile.lon_deg > 179)
            std::abort();
    }
    return 0;
}
