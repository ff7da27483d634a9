// A panorama from its view to its file.
#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "apps/drawing/region_scene.h"
#include "apps/panorama/panorama_names.h"
#include "apps/panorama/rulers.h"
#include "apps/view/style.h"
#include "apps/view/view.h"
#include "core/earth/cylinder.h"
#include "core/truth/true_ground.h"
#include "geo/files/whole_file.h"
#include "geo/together/region_ground.h"
#include "render/frame/cylinder_picture.h"

namespace oro {

// The cylinder of a view that is a panorama: its scene, without what stands around it.
Cylinder cylinder_of(const View& view);
// How it is cut into pictures of a pinhole eye: higher and wider ones for a style with trees.
CylinderCut cut_of(const Style& style);

// How large figures and names are: the em, of a scene's size.
double panorama_em_px(const Cylinder& around);

// What stands around a scene, and the whole sheet.
struct PanoramaSheet {
    Cylinder around;
    Sheet sheet;
    Rulers rulers;
    PanoramaNames names;
    std::string standpoint;  // the name of the place that the eye stands at; "" where no file tells it
};

// Finds the names that are seen and their places, and lays the sheet out. Errors: those of text, and of pages
// that cannot be read.
Result<PanoramaSheet> lay_out(const View& view, const Region& region, const TrueGround& ground);

// Draws the scene, lines of --overlay on it. `view` names the way of drawing, or auto. Errors: those of
// render_cylinder; any message of the validation layer; too little memory for pages; asked to stop.
Result<CylinderPicture> draw_scene(const View& view, const Region& region, const TrueGround& ground,
                                   const Cylinder& around, const Gpu& gpu, Scene& scene, const Style& style,
                                   const RenderProgress& progress, const std::stop_token& stop = {});

// The sheet's rows from the top, 3 bytes a pixel: the scene, and all that stands around it and on it. Errors:
// those of text, and of `sink`.
Result<void> give_rows(const Sheet& sheet, const CylinderPicture& scene, const RowSink& sink);

// A file that is whole and has no name yet.
struct PanoramaFile {
    WholeFile file;
    std::optional<Fingerprints> fingerprints;
};

// Writes .png, .jpg, .tif (with geotags, GPano and the view) or .svg. Errors: those of the file; a view that
// could not be opened again.
Result<PanoramaFile> write_panorama(const std::string& path, bool overwrite, const View& view,
                                    const Region& region, const Style& style, const PanoramaSheet& sheet,
                                    const CylinderPicture& scene);

// True for a name that ends in .svg.
bool is_svg(const std::string& path);

}  // namespace oro
