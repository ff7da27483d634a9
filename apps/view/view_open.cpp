// From options, or from a view's file, to a view and its region: what shot and view begin with.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/cover/canopy_words.h"
#include "apps/eye/standpoint.h"
#include "apps/report/figures.h"
#include "apps/report/option_words.h"
#include "apps/view/mesh_parts.h"
#include "apps/view/style.h"
#include "apps/view/view.h"
#include "apps/view/view_in_region.h"
#include "apps/view/view_option_table.h"
#include "core/base/file_there.h"
#include "core/terrain/ground.h"
#include "geo/canopy/raised_region.h"
#include "geo/coordinates/crs_places.h"
#include "geo/opening/open_region.h"
#include "geo/opening/source_crs.h"
#include "geo/refined/refined_region.h"
#include "geo/together/covered_grids.h"

namespace oro {

void leave_geoid_out(Region& region) {
    for (RegionGrid& grid : region.grids) {
        grid.geoid_left_out = std::exchange(grid.field.undulation, {});
        grid.N_of_posts_left_out_m = std::exchange(grid.field.N_of_posts_m, {});
        grid.geoid = "none";
    }
}

bool keeps_own_posts(const Region& region) {
    return std::ranges::any_of(region.grids,
                               [](const RegionGrid& grid) { return grid.field.grid.net != nullptr; });
}

namespace {

// Changes places of the first grid and another one. The first has the notes on all.
void swap_first_grid(std::size_t number, Region& region) {
    if (number == 0) return;
    std::vector<std::string> notes = std::move(region.grids.front().notes);
    std::swap(region.grids.front(), region.grids[number]);
    region.grids.front().notes = std::move(notes);
}

// Where the data that a view names are gone: what to do about it.
Error with_way_out(Error fault, const View& view, const RegionOptions& options) {
    if (!options.paths.empty()) return fault;
    for (const std::string& path : view.region.paths) {
        const auto there = is_there(path);
        if (!there.ok() || *there || path.starts_with("/vsi")) continue;
        fault.what +=
            "; name the data after the picture: orograph compare PICTURE PATH... (or shot --view PICTURE "
            "PATH...)";
        break;
    }
    return fault;
}

// That the command draws pictures of the view's kind.
Result<void> check_kind(const View& view, const std::string& view_file, PictureKind kind) {
    const bool is_panorama = view.panorama.has_value();
    if (is_panorama == (kind == PictureKind::panorama)) return {};
    return Error{ErrorKind::usage, "--view " + view_file,
                 is_panorama ? "is a panorama: orograph panorama --view draws it again"
                             : "is no panorama: orograph shot --view draws it again"};
}

// The same for all that a view names beside its elevation data.
Result<void> open_files(const Region& region, View& view) {
    ORO_TRY(view.images, open_images(view.drape, view.drape_values, view.fingerprints->images));
    ORO_TRY(view.cover, open_cover(view.cover_choice, view.fingerprints->cover));
    ORO_TRY(view.canopy, open_canopy(view.canopy_choice, view.cover, view.fingerprints->canopy));
    ORO_TRY(view.vectors_read, open_vectors(view.vectors, region, view.fingerprints->vectors));
    return {};
}

// A file of land cover that is not there, perhaps because what follows its comma is no table.
Error no_such_cover(const std::string& file) {
    const std::size_t comma = file.rfind(',');
    const Result<bool> there = is_there(file.substr(0, comma));
    if (comma != std::string::npos && there.ok() && *there)
        return refused("--landcover", file,
                       "there is no table " + file.substr(comma + 1) + ": choose " +
                           listed(cover_table_names()) + ", or name a .json file");
    return {ErrorKind::failed, file, "no such raster of land cover"};
}

// Raises the region of a view by its canopy, unless it is raised already.
Result<void> raise_by_canopy_of(const View& view, Region& region) {
    if (!view.canopy || region.grids.front().canopy) return {};
    ORO_CHECK(raise_by_canopy(region, *view.canopy, view.canopy_choice.held));
    std::vector<std::string>& notes = region.grids.front().notes;
    for (const std::string& note : view.canopy->notes()) notes.push_back(note);
    for (const std::string& note : notes_of_canopy(region)) notes.push_back(note);
    return {};
}

// Puts ground between the posts around the place that a view has for that, or around its eye, unless the
// region has it already.
Result<void> add_detail_of(View& view, Region& region) {
    if (!view.detail || detail_of(region) != nullptr) return {};
    const Geodetic& eye = view.camera.eye;
    if (!view.detail->middle) view.detail->middle = DetailMiddle{eye.lat_deg, eye.lon_deg};
    DetailRequest request{view.detail->halvings, view.detail->middle->lat_deg, view.detail->middle->lon_deg,
                          std::nullopt};
    if (view.detail->radius_km) request.radius_m = 1000.0 * *view.detail->radius_km;
    return add_detail(region, request, view.cover);
}

// Raises the region under an eye that options placed over its ground. Errors: an eye that comes to be in the
// canopy (usage), where it sees nothing.
Result<void> raise_around_eye(const View& view, const ViewOptions& options, Region& region) {
    if (!view.canopy) return {};
    const auto above_m = [&] {
        const Geodetic& eye = view.camera.eye;
        const auto ground_m = ground_h_m(grid_at(region, eye.lat_deg, eye.lon_deg).field, eye.lat_deg,
                                         eye.lon_deg, view.exaggeration);
        return ground_m ? eye.h_m - *ground_m : 0.0;
    };
    const double above_ground_m = above_m();
    ORO_CHECK(raise_by_canopy_of(view, region));
    const double above_canopy_m = above_m();
    if (!options.at || view.map || above_ground_m < 0.0 || above_canopy_m >= 0.0) return {};
    return refused("--at", *options.at,
                   "the eye stands in the canopy, " + metres_words(-above_canopy_m) +
                       " below its top, and sees nothing: --above " +
                       figure(std::ceil(10.0 * (above_ground_m - above_canopy_m) + 0.01) / 10.0) +
                       " looks over it");
}

// Over which place the sun stands as a view's light says: the eye's, or the middle of a map.
Geodetic eye_for_sun(const View& view) {
    const Geodetic& eye = view.camera.eye;
    return view.map ? Geodetic{eye.lat_deg, eye.lon_deg, 0.0} : eye;
}

// Of a view that asks for no sun, in a style whose sun goes by the place.
void take_usual_sun(View& view) {
    if (!view.sun && has_sun_by_place(view)) view.sun = usual_sun();
}

// A map has no eye that something else could look from.
Result<void> check_map(const View& view, const ViewOptions& options, const std::string& view_file) {
    if (!view.map) return {};
    if (!options.takes_maps)
        return Error{ErrorKind::usage, view_file, "is a map from straight above; only shot draws it again"};
    if (options.size)
        return Error{ErrorKind::usage, "--size",
                     "not together with a map's view, which has a size of its own"};
    return {};
}

}  // namespace

Result<std::vector<ImageSource>> open_images(const std::vector<std::string>& files, ImageValues values,
                                             std::vector<Fingerprints::OfSource>& fingerprints) {
    std::vector<ImageSource> images;
    for (const std::string& file : files) {
        ORO_TRY(const bool there, is_there(file));
        if (!there && !file.starts_with("/vsi")) return Error{ErrorKind::failed, file, "no such image"};
        ORO_TRY(ImageSource image, open_image(file, values));
        fingerprints.push_back({std::filesystem::path(file).filename().string(), image.fingerprint});
        images.push_back(std::move(image));
    }
    return images;
}

Result<std::shared_ptr<const CoverMap>> open_cover(CoverChoice& choice,
                                                   std::vector<Fingerprints::OfSource>& fingerprints) {
    if (choice.files.empty()) return std::shared_ptr<const CoverMap>();
    std::vector<CoverSource> sources;
    for (const std::string& file : choice.files) {
        ORO_TRY(const bool there, is_there(file));
        if (!there && !file.starts_with("/vsi")) return no_such_cover(file);
        ORO_TRY(CoverSource source, open_cover_source(file));
        fingerprints.push_back({std::filesystem::path(file).filename().string(), source.fingerprint});
        sources.push_back(std::move(source));
    }
    std::vector<CoverTableRead> read;
    for (const std::string& table :
         choice.table.empty() ? cover_table_names() : std::vector<std::string>{choice.table}) {
        ORO_TRY(CoverTableRead one, read_cover_table(table));
        read.push_back(std::move(one));
    }
    std::vector<CoverTable> tables;
    for (const CoverTableRead& one : read) tables.push_back(one.table);
    ORO_TRY(std::shared_ptr<const CoverMap> cover,
            CoverMap::of(std::move(sources), tables, choice.table.empty() ? nullptr : tables.data()));
    choice.table = cover->table().name;
    const auto taken = std::ranges::find(tables, choice.table, &CoverTable::name);
    fingerprints.push_back({std::filesystem::path(choice.table).filename().string(),
                            read[static_cast<std::size_t>(taken - tables.begin())].fingerprint});
    return cover;
}

Result<std::shared_ptr<const CanopyMap>> open_canopy(const CanopyChoice& choice,
                                                     const std::shared_ptr<const CoverMap>& cover,
                                                     std::vector<Fingerprints::OfSource>& fingerprints) {
    if (!choice.asked()) return std::shared_ptr<const CanopyMap>();
    if (choice.by_class) return CanopyMap::of_classes(cover);
    std::vector<CanopySource> sources;
    for (const std::string& file : choice.files) {
        ORO_TRY(const bool there, is_there(file));
        if (!there && !file.starts_with("/vsi"))
            return Error{ErrorKind::failed, file, "no such raster of canopy heights"};
        ORO_TRY(CanopySource source, open_canopy_source(file));
        fingerprints.push_back({std::filesystem::path(file).filename().string(), source.fingerprint});
        sources.push_back(std::move(source));
    }
    return CanopyMap::of_files(std::move(sources));
}

Result<void> find_graticule_crs(View& view, const Region& region) {
    view.graticule_crs.clear();
    if (view.graticule != Graticule::projected) return {};
    const std::vector<std::string> all = source_crs_of(region);
    if (all.size() == 1) {
        const Result<CrsPlaces> crs = CrsPlaces::of(all.front(), CrsPlaces::Reach::anywhere);
        if (crs.ok() && crs->is_projected()) {
            view.graticule_crs = all.front();
            return {};
        }
    }
    return refused("--graticule", "projected",
                   "is for data in one projected CRS: these have geographic ones, or several");
}

void begin_with_grid_at(const Geodetic& eye, View& view, Region& region) {
    swap_first_grid(view.first_grid, region);
    view.first_grid =
        static_cast<std::size_t>(&data_grid_at(region, eye.lat_deg, eye.lon_deg) - region.grids.data());
    swap_first_grid(view.first_grid, region);
}

namespace {

// How the meshes of a baked file are read for a view: group by group where it draws them by clusters, where
// the file has them, and places nothing on their roofs.
MeshReading meshes_of(const View& view, const ViewOptions& options) {
    const bool by_clusters =
        view.mesh == "clusters" || view.mesh_level || (is_of_clusters(view.show) && view.mesh != "grid");
    const bool streams =
        by_clusters && view.exaggeration == 1.0 && view.has_geoid && options.stand_on != "top";
    return streams ? MeshReading::streamed : MeshReading::whole;
}

// The region of a view that comes from a file, and its fingerprints; `held` as of open_recorded_view().
Result<void> open_region_of(const RegionOptions& region_options, const Progress& progress, const View* held,
                            View& view, Region& region) {
    if (held != nullptr && asks_for_same_region(view, *held)) {
        view.fingerprints = held->fingerprints;
        view.fingerprints->images.clear();
        view.fingerprints->cover.clear();
        view.fingerprints->canopy.clear();
        view.fingerprints->vectors.clear();
        view.first_grid = held->first_grid;
        begin_with_grid_at(view.camera.eye, view, region);
        settle_mesh_parts(region, view);
        return check_own_posts(view, region);
    }
    auto opened = open_region(view.region, progress, meshes_of(view, {}));
    if (!opened) return with_way_out(opened.error(), view, region_options);
    region = std::move(*opened);
    settle_mesh_parts(region, view);
    view.own_posts = keeps_own_posts(region);
    view.several_grids = region.grids.size() > 1;
    view.fingerprints = fingerprints_of(region);
    ORO_CHECK(check_own_posts(view, region));
    leave_covered_grids_out(region);
    begin_with_grid_at(view.camera.eye, view, region);
    if (!view.has_geoid) leave_geoid_out(region);
    return {};
}

// All of a view from options that needs its region, which was opened for it.
Result<void> look_at_region(const ViewOptions& options, View& view, Region& region) {
    settle_mesh_parts(region, view);
    view.own_posts = keeps_own_posts(region);
    view.several_grids = region.grids.size() > 1;
    view.fingerprints = fingerprints_of(region);
    ORO_CHECK(check_own_posts(view, region));
    leave_covered_grids_out(region);
    ORO_CHECK(open_files(region, view));
    ORO_CHECK(find_graticule_crs(view, region));
    if (!view.has_geoid) leave_geoid_out(region);
    const Result<void> placed = place_eye(view, options, region);
    begin_with_grid_at(view.camera.eye, view, region);
    if (view.detail && placed.ok()) {
        ORO_CHECK(add_detail_of(view, region));
        // On the ground that there is now.
        ORO_CHECK(place_eye(view, options, region));
    }
    if (placed.ok()) aim_sun(view.sun, view.camera.eye);
    // Ground that could not be read is no ground to stand on, but that is not why there is none.
    ORO_CHECK(region.grids.front().field.health());
    ORO_CHECK(placed);
    return raise_around_eye(view, options, region);
}

}  // namespace

Result<void> open_recorded_view(const std::string& where, const ViewOptions& view_options,
                                const RegionOptions& region_options, const Progress& progress, View& view,
                                Region& region, PictureKind kind, const View* held) {
    ORO_CHECK(check_map(view, view_options, where));
    ORO_CHECK(check_kind(view, where, kind));
    view.recorded = RecordedView{where, view.camera.width_px, view.camera.height_px + view.legend_px,
                                 !first_given(view_option_table(), view_options, is_look), view.fingerprints};
    const std::string recorded_style = view.style;
    ORO_CHECK(change_view(view, view_options));
    // With another style goes another usual sun.
    if (view.style != recorded_style && (!view.sun || view.sun->is_usual)) {
        view.sun.reset();
        take_usual_sun(view);
        aim_sun(view.sun, eye_for_sun(view));
    }
    // A sun that its file told stays where the file has it: the same view, the same bytes.
    if (view_options.sun_time) aim_sun(view.sun, eye_for_sun(view));
    ORO_CHECK(change_region(view, region_options));
    view.region.allow_multiple_grids = view.several_grids;
    if (view.region.paths.empty())
        return Error{ErrorKind::usage, "--view " + where,
                     "does not tell where its elevation data lie: name them, too"};
    ORO_CHECK(open_region_of(region_options, progress, held, view, region));
    // Those that somebody names instead are others on purpose.
    if (!view_options.drape.empty() && view.recorded->fingerprints)
        view.recorded->fingerprints->images.clear();
    if (!view_options.landcover.empty() && view.recorded->fingerprints)
        view.recorded->fingerprints->cover.clear();
    if (!view_options.canopy.empty() && view.recorded->fingerprints)
        view.recorded->fingerprints->canopy.clear();
    if ((!view_options.names.empty() || !view_options.overlay.empty()) && view.recorded->fingerprints)
        view.recorded->fingerprints->vectors.clear();
    ORO_CHECK(find_graticule_crs(view, region));
    ORO_CHECK(open_files(region, view));
    ORO_CHECK(add_detail_of(view, region));
    return raise_by_canopy_of(view, region);
}

Result<void> open_view(const std::string& view_file, const ViewOptions& view_options,
                       const RegionOptions& region_options, const Progress& progress, View& view,
                       Region& region, PictureKind kind) {
    if (!view_file.empty()) {
        if (view.read_from != view_file) {
            ORO_TRY(view, read_view(view_file));
        }
        return open_recorded_view(view_file, view_options, region_options, progress, view, region, kind,
                                  nullptr);
    }
    ORO_TRY(RegionRequest request, region_request(region_options));
    ORO_TRY(view, view_without_eye(view_options, std::move(request)));
    take_usual_sun(view);
    ORO_TRY(region, open_region(view.region, progress, meshes_of(view, view_options)));
    return look_at_region(view_options, view, region);
}

Result<void> open_view_in_region(const ViewOptions& options, const RegionRequest& request, View& view,
                                 Region& region) {
    ORO_TRY(view, view_without_eye(options, request));
    take_usual_sun(view);
    return look_at_region(options, view, region);
}

}  // namespace oro
