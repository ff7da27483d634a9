// Geotags as XMP: what EXIF has no tag for, and the view to draw the picture again.
#pragma once

#include <string>

#include "core/base/result.h"
#include "geo/pictures/picture.h"

namespace oro {

// An XMP packet (ISO 16684-1) with dc:rights, dc:format, xmp:CreatorTool, xmp:CreateDate and, in
// "urn:orograph:1.0/": Yaw, Pitch, Roll, VerticalFieldOfView (degrees), OrthometricHeight (H),
// EllipsoidalHeight (h), GeoidUndulation (N) (metres), Geoid, View (JSON). Panoramas have the fields of
// GPano, too. Source: Google, Photo Sphere XMP Metadata, "Cylindrical projections". Numbers are written so
// that reading gives back the same double. Errors: text that is not UTF-8 or holds characters that XML
// forbids (control characters).
Result<std::string> xmp_packet(const Geotags& tags, PictureFormat format);

// The View of a packet written by xmp_packet, also when another program has written the packet anew.
// Errors: no View in it; a View that is cut off or holds a broken entity. `where` is named in them.
Result<std::string> view_in_xmp(const std::string& packet, const std::string& where);

}  // namespace oro
