#include "apps/film/tour_kml.h"

#include <cstdio>

#include "apps/report/json_text.h"
#include "apps/report/xml_escape.h"
#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

std::string kml_number(const char* name, double value, int decimals) {
    char text[120];
    std::snprintf(text, sizeof text, "<%s>%.*f</%s>", name, decimals, value, name);
    return text;
}

}  // namespace

std::string keys_to_kml(const std::vector<CameraKey>& keys, const std::string& name,
                        const std::function<double(double lat_deg, double lon_deg)>& N_m) {
    std::string text =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<kml xmlns=\"http://www.opengis.net/kml/2.2\" xmlns:gx=\"http://www.google.com/kml/ext/2.2\">\n"
        "<gx:Tour>\n  <name>" +
        xml_escaped(name) + "</name>\n  <gx:Playlist>\n";
    double before_s = keys.empty() ? 0.0 : keys.front().time_s;
    for (const CameraKey& key : keys) {
        const Geodetic& eye = key.eye;
        text += "    <gx:FlyTo>" + kml_number("gx:duration", key.time_s - before_s, 6) +
                "<gx:flyToMode>smooth</gx:flyToMode>\n      <Camera>";
        if (key.time_utc_s)
            text += "<gx:TimeStamp><when>" + time_text(*key.time_utc_s) + "</when></gx:TimeStamp>\n        ";
        text += kml_number("longitude", normalised_lon_deg(eye.lon_deg), 9) +
                kml_number("latitude", eye.lat_deg, 9) +
                kml_number("altitude", eye.h_m - N_m(eye.lat_deg, eye.lon_deg), 6) +
                kml_number("heading", key.attitude.heading_deg, 9) +
                kml_number("tilt", key.attitude.pitch_deg + 90.0, 9) +
                kml_number("roll", key.attitude.roll_deg, 9) +
                "<altitudeMode>absolute</altitudeMode></Camera>\n    </gx:FlyTo>\n";
        before_s = key.time_s;
    }
    return text + "  </gx:Playlist>\n</gx:Tour>\n</kml>\n";
}

}  // namespace oro
