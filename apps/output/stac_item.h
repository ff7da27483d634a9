// A picture as a catalogue of images knows it: an item of a SpatioTemporal Asset Catalog.
#pragma once

#include <string>
#include <vector>

#include "apps/view/view.h"

namespace oro {

// A file that a STAC item names, beside which it lies.
struct StacAsset {
    std::string key;
    std::string file_name;
    std::string media_type;
    std::string role;
};

// The media type of a picture by its name: "image/png", ... "" of another ending.
std::string picture_media_type(const std::string& name, bool is_map);

// An item as JSON. Its geometry is, of a picture from an eye, the eye's place with h above the ellipsoid; of
// a map its outline on WGS84, in two parts where it lies over the 180th meridian, and up to the pole where it
// holds one; null where PROJ has no places for it. Beside the time that the view states it has the direction
// of the view and of the sun (extension view), and of a map its CRS and its pixels (extension projection).
// Source: STAC Item Specification 1.0.0; extensions view 1.0.0 and projection 1.1.0. Not safe to ask from
// several threads.
std::string stac_item_json(const View& view, const std::string& picture_name,
                           const std::vector<StacAsset>& assets);

}  // namespace oro
