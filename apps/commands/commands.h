// The program's commands. Each returns an Error or has done what it says; main turns that into an exit code.
#pragma once

#include "apps/options/fetch_options.h"
#include "apps/options/options.h"
#include "core/base/result.h"

namespace CLI {
class App;
}  // namespace CLI

namespace oro {

struct BakePartOptions;     // apps/options/bake_part_options.h
struct BatchOptions;        // apps/options/batch_options.h
struct ExportOptions;       // apps/options/export_options.h
struct HorizonOptions;      // apps/options/horizon_options.h
struct ObserversOptions;    // apps/options/observers_options.h
struct RealisationOptions;  // apps/options/realisation_options.h
struct ServeOptions;        // apps/options/serve_options.h

// Writes a geotagged picture and, beside it, its view; with --verify also a picture of its errors.
Result<void> run_shot(const ShotOptions& options);
// Writes a picture all around a place, with rulers and names.
Result<void> run_panorama(const PanoramaOptions& options);
// Writes the numbered pictures of a camera's path, or a movie of them.
Result<void> run_film(const FilmOptions& options);
// Measures how far the picture of a view is from the truth; draws it again, replaces no picture.
Result<void> run_compare(const CompareOptions& options);
// Predicts how large each effect is in a view, before anything is drawn.
Result<void> run_plan(const PlanOptions& options);
// Draws views with all settings, measures time and error, and writes a report.
Result<void> run_trade(const TradeOptions& options);
// Tells when the sun first and last shows at a place.
Result<void> run_sun(const SunOptions& options);
// Tells whether one place is seen from another, by how much, and how probable that is where it is asked for.
Result<void> run_sight(const SightOptions& options, const RealisationOptions& realisations);
// Tells how high the ground is along a line, and draws it.
Result<void> run_profile(const ProfileOptions& options);
// Writes which places are seen from others, as a GeoTIFF, and how probable that is where it is asked for.
Result<void> run_viewshed(const ViewshedOptions& options, const RealisationOptions& realisations,
                          const ObserversOptions& observers);
// Writes how high the horizon stands around posts, and how much of the sky they see, as GeoTIFFs.
Result<void> run_horizon(const HorizonOptions& options);
// Opens a window to fly over a region.
Result<void> run_view(const WindowOptions& options);
// Writes a region with all its levels into a file, or goes on with one that was broken off; or a part of what
// that takes, or joins such parts.
Result<void> run_bake(const BakePartOptions& options);
// Writes the heights of a region in a format of others.
Result<void> run_export(const ExportOptions& options);
// Runs the commands of a list, one after the other, and tells which failed.
Result<void> run_batch(const BatchOptions& options);
// Serves a folder to browsers, read-only, until it is interrupted.
Result<void> run_serve(const ServeOptions& options);
// Tells what the sources of a region are and what is missing.
Result<void> run_info(const InfoOptions& options);
// Writes tiles of a public source into a folder. The only command that uses a network.
Result<void> run_fetch(const FetchOptions& options);
// Tells what the machine has and what each lack means.
Result<void> run_doctor(const DoctorOptions& options);
// Prints the script by which a shell completes command lines. app: with all its commands.
Result<void> run_completion(CLI::App& app, const CompletionOptions& options);
// Prints a page of the manual as roff: of a command, or of the program.
Result<void> run_manual(CLI::App& app, const ManualOptions& options);

}  // namespace oro
