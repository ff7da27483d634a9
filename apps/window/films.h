// A film that a window's user makes: the keys of a camera's path, from and to the files that orograph film
// takes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "apps/commands/sight/line_along.h"
#include "apps/film/camera_path.h"
#include "apps/view/view.h"

namespace oro {

struct Viewer;

// How somebody follows a line.
struct LineWalk {
    double speed_m_s{10.0};
    double ahead_m{60.0};  // where they look: so far along the line
    double above_m{1.7};   // the eye over the ground
};

// What its user makes.
struct Film {
    std::vector<CameraKey> keys{};
    double gap_s{5.0};              // between keys that are added
    std::string file{"film.json"};  // that is opened, and saved to
    std::string own_file{};         // that was opened or saved last: it may be written anew
    LineWalk walk{};
    int line{1};       // of a file with several
    double fps{25.0};  // of the film that is drawn
};

// The path of somebody who follows a line, a person's eye over the ground, as keys_along_track() makes it.
// Errors: those of keys_along_track(); a speed or a way ahead that is none (usage).
Result<std::vector<CameraKey>> keys_of_walk(const LineAlong& line, const LineWalk& walk, const Region& region,
                                            double exaggeration, double vertical_fov_deg);
// The line that draws a film of a file: orograph film FILE, the data and the looks of a view.
std::string film_command(const std::string& file, const View& view);

// Adds the view that is shown.
void add_shown_view(Viewer& viewer);
// Plays the keys from one of them on.
void play_film(Viewer& viewer, std::size_t from);
// Opens the file that the film names; what is wrong with it is told, and the keys stay.
void open_film(Viewer& viewer);
// Saves the keys under a name of its own, and begins `orograph film` with them, beside the window: a movie
// where ffmpeg is there, else a folder of frames. What goes wrong is told.
void draw_film(Viewer& viewer);
// Saves the keys there: as KML where its name says so, else as JSON. What goes wrong is told.
void save_film(Viewer& viewer);
// Follows a line of a vector file, by its number from 1; or the line that was measured.
void follow_file(Viewer& viewer, const std::string& file, int line);
void follow_measured_line(Viewer& viewer);

}  // namespace oro
