// What other programs read beside a picture: where it was taken from, as a KML PhotoOverlay, as a GeoPose and
// as a STAC item.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/view/view.h"
#include "core/base/result.h"
#include "core/earth/camera.h"
#include "geo/files/whole_file.h"

namespace oro {

// Which of them are written.
struct PoseChoice {
    bool kml{};
    bool geopose{};
    bool stac{};
};

// A unit quaternion (x, y, z, w) with w not below 0: the rotation from the camera's axes to east, north, up
// of its place. The camera's axes are those of yaw, pitch and roll in GeoPose: x ahead along the line of
// sight, y to the left of the picture, z to its top. A level camera that faces east has (0, 0, 0, 1). Source:
// OGC GeoPose 1.0 (21-056r11), Basic-YPR: rotations of a frame that lies east, north, up about its own axes
// z, y and x, in that order; here by 90 degrees less the heading, the pitch downwards, and the roll.
std::array<double, 4> geopose_quaternion(const Attitude& attitude);
// A camera's pose as JSON of GeoPose 1.0, Basic-Quaternion: degrees, h in metres above the ellipsoid.
std::string geopose_json(const Camera& camera);

// A PhotoOverlay (OGC KML 2.2, 07-147r2, 11.4) that shows the picture of that file name, beside which it
// lies, where the view's camera took it. N_m: the geoid's undulation at the eye, for KML's altitudes are
// above sea level.
std::string photo_overlay_kml(const View& view, double N_m, const std::string& picture_name);

// NAME.kml, NAME.geopose.json and NAME.stac.json beside NAME.png; NAME.jpg.kml and so on beside other
// pictures. Each with what it holds.
struct PoseText {
    std::string file;
    std::string text;
};
std::vector<PoseText> pose_texts(const std::string& picture, PoseChoice choice, const View& view, double N_m);
// Their names alone.
std::vector<std::string> pose_paths(const std::string& picture, PoseChoice choice);
// The files, which have no names yet. Errors: those of WholeFile.
Result<std::vector<WholeFile>> pose_files(const std::vector<PoseText>& texts, bool overwrite);

}  // namespace oro
