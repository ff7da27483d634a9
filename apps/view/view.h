// A view: all that decides a picture, complete and resolved. Written into every picture and read back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/cover/canopy_choice.h"
#include "apps/cover/cover_tables.h"
#include "apps/detail/detail_choice.h"
#include "apps/fingerprints/fingerprints.h"
#include "apps/light/sun.h"
#include "apps/options/options.h"
#include "apps/vectors/view_vectors.h"
#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/earth/camera.h"
#include "core/earth/world_model.h"
#include "core/frame/height_quantization.h"
#include "core/terrain/page.h"
#include "core/terrain/summit.h"
#include "geo/canopy/canopy_map.h"
#include "geo/cover/cover_map.h"
#include "geo/drape/image_source.h"
#include "geo/rasters/map_frame.h"
#include "geo/region/region.h"

namespace oro {

// What a view's file told, before options changed the view.
struct RecordedView {
    std::string file;
    int width_px{};
    int height_px{};
    bool own_look{true};                       // no option of this command changes its colours or its light
    std::optional<Fingerprints> fingerprints;  // none of before there were any
};

// Which part of all around a panorama shows: azimuths from the left border clockwise, elevations from its
// lowest row to its highest. The view's camera then tells the eye, the middle and the whole picture's size.
struct PanoramaFrame {
    double from_deg{};
    double sweep_deg{360.0};
    double low_deg{};
    double high_deg{};
    bool ridges{true};  // lines where nearer ground ends before farther ground or the sky
};
// What a picture is drawn on.
enum class PictureKind { plane, panorama };

// What the file of a style holds.
struct StyleText {
    std::string path;
    std::string text;
};

// How the eye came to stand where --at says, of a view that options place; both nothing of any other.
struct Stood {
    std::optional<MovedToSummit> summit;  // what --on-summit did
    std::optional<MovedToSummit> wall;    // without it: the post near that is a wall (Standpoint::wall)
};

struct View : ViewSettings<OfView> {
    RegionRequest region;
    bool own_posts{};      // its region keeps the posts of files in a CRS of their own
    bool several_grids{};  // ... and those of files that lie apart, or over each other, as grids of their own
    Camera camera;         // the eye's h is above the ellipsoid
    Stood stood;           // the ground's, whatever grows there
    std::optional<MapFrame> map;  // a map from straight above; the camera then only says about where
    std::optional<PanoramaFrame> panorama;  // nothing: a picture on a plane
    bool legend{};                          // a strip below the picture
    int legend_px{};                        // its height, of pictures that were drawn
    std::optional<SunDirection> sun;        // nothing: the style's
    // An option of this command says it, and not the view's file alone, which names both for any style.
    bool sea_asked{};
    bool rim_asked{};
    std::vector<ImageSource> images;          // the files of drape, from open_view on
    CoverChoice cover_choice;                 // the files of land cover, and their table
    std::shared_ptr<const CoverMap> cover;    // what is in them, from open_view on; null: none
    CanopyChoice canopy_choice;               // what stands on the ground, and hides what is behind it
    std::shared_ptr<const CanopyMap> canopy;  // what is known of it, from open_view on; null: none
    std::optional<DetailChoice> detail;       // ground between the posts that is invented; nothing: none
    VectorChoices vectors;                    // names and lines from files
    std::shared_ptr<const VectorsRead> vectors_read;  // what is in them, from open_view on; null: no files
    // The CRS of a projected graticule, as CrsPlaces::of() takes it, from open_view on.
    std::string graticule_crs;
    WorldModel model;
    bool has_geoid{true};  // false: N is 0 everywhere, heights are above the ellipsoid
    std::string accuracy;  // the bundle that these come from; empty when they were chosen one by one
    std::int64_t time_utc_s{};
    bool tells_paths{true};  // false: its picture names neither sources nor the folder of a style
    std::string read_from;   // the file, of a view that read_view() gave
    std::optional<StyleText> style_text;  // of its style, where that was read already
    bool paths_from_own_file{false};      // relative paths start from the file that the view is in
    // --show is of the clusters of the region's meshes, from open_view on: their triangles have its colours,
    // and the ground is plain (settle_mesh_parts()).
    bool shows_mesh_parts{};
    // What it was drawn from, as its file tells; from open_view on, what it is drawn from here.
    std::optional<Fingerprints> fingerprints;
    std::optional<RecordedView> recorded;  // of a view from a file, from open_view on
    // Which of its region's grids stands first (begin_with_grid_at), by its number when the region was
    // opened.
    std::size_t first_grid{};
};

// What to read, from the options. Usage errors: no path, a malformed box or tile.
Result<RegionRequest> region_request(const RegionOptions& options);

// The air that options ask for, `usual` where they say nothing.
Result<Air> air_asked_for(const std::optional<double>& refraction_k, const std::optional<std::string>& air,
                          const Air& usual);

// Everything of a view that needs no terrain, checked: sizes, ranges, times. The camera has no eye yet, and a
// sun by time no direction: aim_sun() gives it one.
Result<View> view_without_eye(const ViewOptions& options, RegionRequest region);

// Puts the eye of a view where the options say: at a place over the ground or above sea level, or so that the
// whole region is in the picture (apps/view/overview.h). Errors: no data under an eye that is placed over the
// ground (no_data); an eye beyond view_limits (usage).
Result<void> place_eye(View& view, const ViewOptions& options, const Region& region);

// Nothing of a region is in a view: an error where the eye is not over the region's box (a view of another
// place: no_data), a note for eyes over it, which may look into the sky. `view_file` is where the view comes
// from, if from one.
Result<std::string> nothing_in_view(const View& view, const Region& region, const std::string& view_file);

// Changes a view read from a file as far as options other than the eye's are given; those of the eye are
// usage errors.
Result<void> change_view(View& view, const ViewOptions& options);
// The same for its region: other paths to the same data may be given, all else is a usage error.
Result<void> change_region(View& view, const RegionOptions& options);

// A view as JSON text, every double with all its digits; on one line unless `pretty`.
std::string view_to_json(const View& view, bool pretty);
// Errors name what is missing or wrong, and `where` it was read from.
Result<View> view_from_json(const std::string& text, const std::string& where);
// From a .json file, or from a picture that carries its view; its paths then lead from the working folder.
// open_view() does not read the file once more where it gets such a view.
Result<View> read_view(const std::string& path);
// That the view, written, is read back as it is. Errors: what the reader would say of it. To be asked before
// a picture is drawn that nobody could open again.
Result<void> check_view_opens(const View& view, const std::string& where);

// Puts the grid first whose ground the eye is over, or else the nearest: what is told of ground around the
// eye is told of that, and what a style asks of the ground. All others stand as they did when the region was
// opened for the view, which keeps the grid's number then.
void begin_with_grid_at(const Geodetic& eye, View& view, Region& region);

// Takes N out of a region: heights are then above the ellipsoid, for the eye's place as for the terrain's.
void leave_geoid_out(Region& region);
// Whether one of its grids has posts where their own CRS has them.
bool keeps_own_posts(const Region& region);

// The view that a command's options ask for, and the region it looks at: from `view_file` where one is named,
// changed as far as the options may, else from the options alone. Errors: all of the above and those of
// open_region; a view of a file that is drawn on something else (usage).
Result<void> open_view(const std::string& view_file, const ViewOptions& view_options,
                       const RegionOptions& region_options, const Progress& progress, View& view,
                       Region& region, PictureKind kind = PictureKind::plane);

// Opens the images over the ground that a view names, and adds their fingerprints. Errors: a file that is not
// there, and those of open_image().
Result<std::vector<ImageSource>> open_images(const std::vector<std::string>& files, ImageValues values,
                                             std::vector<Fingerprints::OfSource>& fingerprints);

// Opens the land cover that is chosen; null where none is. The choice then names the table that was taken.
// Adds fingerprints of the files and of the table. Errors: a file that is not there, those of
// open_cover_source(), of a table and of CoverMap::of().
Result<std::shared_ptr<const CoverMap>> open_cover(CoverChoice& choice,
                                                   std::vector<Fingerprints::OfSource>& fingerprints);

// Opens the canopy that is chosen; null where none is. cover: the land cover of the view, for a canopy of
// classes. Adds fingerprints of files. Errors: a file that is not there, and those of open_canopy_source().
Result<std::shared_ptr<const CanopyMap>> open_canopy(const CanopyChoice& choice,
                                                     const std::shared_ptr<const CoverMap>& cover,
                                                     std::vector<Fingerprints::OfSource>& fingerprints);

// Finds the CRS of a view's graticule, where it has a projected one. Errors (usage): the data are in none, or
// in several.
Result<void> find_graticule_crs(View& view, const Region& region);

// Whether two views ask for the same region: the same data, read in the same way, with or without a geoid.
bool asks_for_same_region(const View& one, const View& other);

// The same for a view that was read already; `where` is the file that it stands in. held: the view, as it
// came out of here, for which `region` was opened, which then stays if this view asks for the same one; null:
// `region` is none. Errors: as above.
Result<void> open_recorded_view(const std::string& where, const ViewOptions& view_options,
                                const RegionOptions& region_options, const Progress& progress, View& view,
                                Region& region, PictureKind kind, const View* held);

// A usage error where a view of such a region asks for what only regions of latitudes and longitudes have:
// another model of the Earth or of placing.
Result<void> check_own_posts(const View& view, const Region& region);

}  // namespace oro
