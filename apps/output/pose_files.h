// What other programs read beside a picture: where it was taken from, or where a map lies, as KML, as a
// GeoPose and as a STAC item.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/output/map_middle.h"
#include "apps/view/view.h"
#include "core/base/result.h"
#include "core/earth/camera.h"
#include "geo/files/whole_file.h"
#include "geo/region/region.h"

namespace oro {

// Which of them are written.
struct PoseChoice {
    bool kml{};
    bool geopose{};
    bool stac{};
};

// Those that a command's options ask for: of shot, panorama, film and view.
template <class Options>
PoseChoice poses_asked(const Options& options) {
    return {options.kml, options.geopose, options.stac};
}

// What they say that the view does not.
struct PoseFacts {
    double N_m{};               // the geoid's undulation at the eye: KML's altitudes are above sea level
    std::string attribution{};  // who is to be named for the data; "": nobody
    double above_level_px{};    // of a panorama: the picture's rows above the eye's level
    double ground_h_m{};        // of a map: the ground in its middle, above the ellipsoid; 0 where is none
};

// What they say of any picture from an eye over a region: its N, and who is to be named.
PoseFacts pose_facts(const View& view, const Region& region);

// A unit quaternion (x, y, z, w) with w not below 0: the rotation from the camera's axes to east, north, up
// of its place. The camera's axes are those of yaw, pitch and roll in GeoPose: x ahead along the line of
// sight, y to the left of the picture, z to its top. A level camera that faces east has (0, 0, 0, 1). Source:
// OGC GeoPose 1.0 (21-056r11), Basic-YPR: rotations of a frame that lies east, north, up about its own axes
// z, y and x, in that order; here by 90 degrees less the heading, the pitch downwards, and the roll.
std::array<double, 4> geopose_quaternion(const Attitude& attitude);
// A camera's pose as JSON of GeoPose 1.0, Basic-Quaternion: degrees, h in metres above the ellipsoid.
std::string geopose_json(const Camera& camera);

// The same of a map: the rotation from the map's axes (x to the right of the map, y to its top, z up from the
// ground) to east, north, up. A map whose top is north has (0, 0, 0, 1). Its axes are turned clockwise by
// up_azimuth_deg (MapMiddle), which is a rotation about z by as much the other way.
std::array<double, 4> map_geopose_quaternion(double up_azimuth_deg);
// h_m: above the ellipsoid.
std::string map_geopose_json(const MapMiddle& middle, double h_m);

// A PhotoOverlay (OGC KML 2.2, 07-147r2, 11.4) that shows the picture of that file name, beside which it
// lies, where the view's camera took it. A panorama is on a cylinder around the eye, because its rows are as
// far apart as the tangents of their elevations: it ends at the sector's azimuths, and above and below where
// the file's first and last row lie on that cylinder, with what stands around the scene.
std::string photo_overlay_kml(const View& view, const PoseFacts& facts, const std::string& picture_name);

// NAME.kml, NAME.geopose.json and NAME.stac.json beside NAME.png; NAME.jpg.kml and so on beside other
// pictures. Each with what it holds.
struct PoseText {
    std::string file;
    std::string text;
    std::string note{};  // what a user must know of it; "": nothing
};
// The KML of a map is a GroundOverlay. A panorama's camera has the size of its file. Errors: those of
// ground_overlay() and map_middle(), of maps.
Result<std::vector<PoseText>> pose_texts(const std::string& picture, PoseChoice choice, const View& view,
                                         const PoseFacts& facts);
// Their names alone.
std::vector<std::string> pose_paths(const std::string& picture, PoseChoice choice);
// The files, which have no names yet. Errors: those of WholeFile.
Result<std::vector<WholeFile>> pose_files(const std::vector<PoseText>& texts, bool overwrite);

}  // namespace oro
