// Points of vector files that have a name: peaks, huts, whatever a layer holds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geo/vectors/vector_file.h"

namespace oro {

struct NamedPoint {
    std::string name;
    double lat_deg{};
    double lon_deg{};
    // The height that the point's geometry has; HeightAbove::nothing: none.
    HeightAbove heights{HeightAbove::nothing};
    double height_m{};
    std::optional<double> stated_H_m;    // field `ele`, as OpenStreetMap and GPX have it
    std::optional<double> prominence_m;  // field `prominence`
    // A field natural, class, type or sym says peak, saddle or the like, or it tells a height: its own or
    // that of a field `ele`, or a prominence.
    bool may_be_summit{};
};

// The points of a file that have something in the field of the name. A name is one line.
std::vector<NamedPoint> named_points(const VectorFile& file, const std::string& name_field);
// Whether there is one.
bool has_named_point(const VectorFile& file, const std::string& name_field);

// Metres from what people write into such fields: "2962", "2962 m", "2,962.5"; nothing of what is none.
std::optional<double> metres_from(std::string_view text);

}  // namespace oro
