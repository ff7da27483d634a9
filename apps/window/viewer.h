// All that lives while a window is open, and the questions that everybody there asks of it.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/commands/commands.h"
#include "apps/drawing/background_pyramid_build.h"
#include "apps/drawing/picking.h"
#include "apps/drawing/pipeline_choice.h"
#include "apps/drawing/region_scene.h"
#include "apps/legend/colour_key.h"
#include "apps/navigation/gestures.h"
#include "apps/navigation/home.h"
#include "apps/output/pose_files.h"
#include "apps/overlay/lines_in_motion.h"
#include "apps/search/gazetteer_reading.h"
#include "apps/search/search_index.h"
#include "apps/settings/window_settings.h"
#include "apps/view/style.h"
#include "apps/window/begun_command.h"
#include "apps/window/comparing.h"
#include "apps/window/detail.h"
#include "apps/window/films.h"
#include "apps/window/jump.h"
#include "apps/window/looking_around.h"
#include "apps/window/maps.h"
#include "apps/window/measure.h"
#include "apps/window/panoramas.h"
#include "apps/window/place_certificates.h"
#include "apps/window/playing.h"
#include "apps/window/region_opening.h"
#include "apps/window/second_view.h"
#include "apps/window/window_start.h"
#include "apps/window/world_levels.h"
#include "core/base/elapsed.h"
#include "render/frame/frame_renderer.h"
#include "render/window.h"

namespace oro {

// One line of the log, and of the toasts in the window's corner.
struct Message {
    std::string text;
    Clock::time_point since{};
    bool is_error{false};
    bool is_toast{true};
};

// The field that takes a place.
struct SearchField {
    bool is_open{false};
    bool takes_focus{false};  // from the next frame on
    std::string text;
    std::string error;                  // why it is no place, shown beside it
    std::vector<SearchMatch> matches;   // of the text, as it is typed
    std::optional<std::size_t> chosen;  // of these, by the arrows
};

// What is seen at a point of the picture, and how the ground lies there.
struct PickedPlace {
    glm::dvec2 point_px{0.0};
    std::optional<SeenPlace> seen;
    std::optional<double> slope_deg;
    std::optional<double>
        aspect_deg;  // where the ground falls to, clockwise from true north; none where level
    std::optional<double> source_spacing_m;  // from post to post, of the source that its height comes from
    std::string source_crs;                  // of that: "EPSG:4326 WGS 84"
    std::string geoid;                       // what N is: "EGM96 (egm96_15.gtx)"
    // How far what is drawn there may be from the full resolution; nothing while levels are being measured,
    // and where clusters draw the ground.
    std::optional<SampledDetail::Bound> certificate;
};

// What the panel of the sun shows: a time by a clock.
struct SunClock {
    std::string date;  // "2026-06-21", there
    int minute{};      // of the day
    int zone_h{};      // ahead of UTC
};

// A picture that is asked for in a dialog.
struct PictureChoice {
    int width_px{};
    int height_px{};
    int samples{1};
    std::string ending{".png"};
    PoseChoice poses;  // the files beside it
};

// The line that is measured, and where its picture goes.
struct Measuring {
    Measurement found;
    std::vector<Ecef> line_ecef, corners_ecef;
};

// When a frame came about.
struct FrameTimes {
    Clock::time_point input{};    // what the user had done until then is in it
    Clock::time_point begun{};    // it was begun to be planned
    Clock::time_point planned{};  // ... and was
    Clock::time_point drawn{};    // the device was done with it, as far as is known
};

// A frame that was submitted.
struct SubmittedFrame {
    FrameTimes times{};
    DetailStep step{};
    bool is_settled{};  // what it was planned from is as fine as the view asks
    bool is_of_moving_eye{};
    bool is_chosen_by_gpu{};           // its pages are: what of them it lacks it tells
    std::vector<StrokedLine> lines{};  // over the ground, until they are in the picture itself
};

// Which panels are open.
struct Panels {
    bool hidden{false};  // all of them, and what is always there
    bool keys{false}, layers{false}, sun{false}, statistics{false}, messages{false}, measure{false},
        files{false}, picture{false};
    bool place{false};     // about what was picked
    bool viewshed{false};  // what is seen from there
    bool panorama{false};  // all around from there
    bool film{false};
    bool project{false};
    bool two_views{false};

    // Opens one, or closes it; others that would lie over it are closed.
    void toggle(bool Panels::*panel);
    void open(bool Panels::*panel);
};

// The way back to a region that is out of the picture.
struct WayHome {
    std::optional<GroundBox> ground;  // of the region, once it was asked for
    Camera of;                        // the arrow is this view's
    std::optional<HomeArrow> arrow;
};

struct Viewer {
    WindowOptions options;
    View view;
    Region region;
    RegionCuts cuts;  // of all its grids
    Style style;
    const Gpu& gpu;
    std::unique_ptr<Scene> scene;  // of every n-th post while `finer` is being measured
    Window& window;
    FrameRenderer& renderer;
    RasterPath path;
    std::string name{};     // of what is shown, in the title
    std::string message{};  // what was said last, until the eye moves
    std::deque<Message> log{};
    SearchField search{};
    SearchIndex index{};
    std::unique_ptr<GazetteerReading> gazetteers{};  // until they are in the index
    bool reads_gazetteers{};                         // they were asked for
    std::vector<Bookmark> bookmarks{};
    std::string bookmark_name{};  // as it is typed
    Panels panels{};
    WindowSettings settings{};  // of the user
    bool keeps_size{};          // no option says how large the window is
    std::optional<PickedPlace> under_pointer{};
    std::optional<PickedPlace> picked{};
    std::optional<Ecef> jumped_to{};  // on the ground, as drawn: the point that the last jump went to
    std::optional<PickedPlace> in_middle{};
    WayHome way_home{};
    PlaceCertificates certificates{};
    Measuring measuring{};
    LookingAround looking{};    // ends before the region that it reads
    PanoramaAround panorama{};  // likewise
    TwoViews two{};             // likewise
    Comparing comparing{};      // likewise
    BegunCommand begun{};       // a film or a map that is drawn beside the window
    bool leaves_tints_out{};    // of the ground, for a picture
    std::optional<SunClock> sun_clock{};
    std::optional<PictureChoice> picture_choice{};   // of the dialog
    std::optional<MapChoice> map_choice{};           // likewise
    std::vector<std::vector<std::string>> recent{};  // what was opened last, each together
    std::string folder{};                            // that the panel of files lists
    std::optional<VectorChoices> vectors_known{};    // all files of names and lines, shown or not
    std::vector<std::string> images_known{};         // likewise
    std::vector<std::string> cover_known{};          // of land cover, likewise
    bool is_missing{};                               // something that the last frame should have had
    std::unique_ptr<const RegionGround> ground{};    // made when it is first asked, for all questions after
    std::unique_ptr<BackgroundWork<std::unique_ptr<const RegionGround>>> ground_work{};  // that makes it
    bool waits_for_writing{};  // over the picture, until the ground is there
    // The levels that the view asks for, until they are here.
    std::unique_ptr<BackgroundPyramidBuild> finer{};
    std::unique_ptr<RegionOpening> opening{};  // another region, until it is read
    std::unique_ptr<Scene> coming{};           // of them, until what a picture needs is on the GPU
    Clock::time_point coming_since{};
    Clock::time_point started{};
    bool is_shown{};          // once ground is, or a view that has none
    bool is_whole{};          // once all detail is
    bool is_exposed{};        // what the window shows was lost
    bool is_settled{};        // the picture that is shown is as fine as the view asks
    bool is_outdated{};       // ... and is not what the user asks for now: another is about to be drawn
    bool lacks_memory{};      // what it lacks does not fit on the GPU, since something was asked for last
    bool shows_all{};         // what it lacks is hidden, as far as is known
    bool waits_for_ground{};  // what is in view is not on the GPU yet
    Clock::time_point waiting_since{};
    bool has_picture{};  // the renderer's picture is drawn
    Image kept{};        // the picture from before the window's size changed, while no other is there
    VkExtent2D part{};   // of the picture that is shown, or of `kept`
    Jumps jumps{};
    std::optional<Gestures> gestures{};  // from the window's start on
    bool flies{false};                   // to where a jump leads
    std::string arrival{};               // what is said there
    std::optional<Playing> playing{};    // a path that the eye goes along
    Film film{};
    std::string project_file{"project.json"};  // that the work is saved to
    std::string own_project{};                 // that it was opened from or saved to: it may be written anew
    Clock::time_point moved{};                 // when the eye last did
    bool follows_eye{};  // what is fitted to a view is that of an eye that moved, until it rests
    ColourKey legend{};  // of a frame that explains itself (--show)
    MovingDetail detail{};
    DetailStep drawn_at{};                   // of the last frame
    std::deque<SubmittedFrame> under_way{};  // frames that the renderer draws, in their order
    Clock::time_point polled{};              // when the user's input was asked for last
    Clock::time_point drawn{};               // when the last frame was that is done
    FrameReport report{};                    // of that
    std::vector<StrokedLine> lines{};        // over that
    LinesInMotion lines_in_motion{};
    double frame_s{};  // that it took: since it was begun, or since the one before it was drawn
    std::optional<SubmittedFrame> to_trace{};  // that was drawn and not shown yet
    std::string traced{};                      // the line that trace_state() printed last
    EyeMeshes meshes{};                        // that the scene draws
    WorldLevels world{};                       // of a world that nobody stores
    bool keeps_means{};         // the scene has means of the ground, whatever the style asks for now
    bool wants_picture{false};  // something has changed that pictures show
    bool leaves{false};         // the user wants to
    // What panels ask for: done once their frame is built.
    std::vector<std::function<Result<void>(Viewer&)>> wishes{};
    // Whose pages the GPU is going to choose, and how many records of them are read.
    const Scene* records_of{};
    std::uint64_t records_read{};
};

// The finest grid below the eye.
const HeightField& field_below(const Viewer& viewer);
// Made when it is first asked, and after forget_ground(); waited for. Errors: damage in a baked region.
Result<const RegionGround*> ground_of(Viewer& viewer);
// The same for what is looked for unasked: without waiting; null while it is being made. Errors: as above.
Result<const RegionGround*> ground_so_far(Viewer& viewer);
// The region is another, or its heights are.
void forget_ground(Viewer& viewer);
Result<std::optional<SeenPlace>> seen_at(Viewer& viewer, glm::dvec2 point_px);
// The same with how the ground lies there.
Result<PickedPlace> picked_at(Viewer& viewer, glm::dvec2 point_px);

// Where the region is, from a view that shows nothing of it; inset_px: of the arrow from the window's border.
const std::optional<HomeArrow>& way_home(Viewer& viewer, double inset_px);

// Whether the eye has just moved: detail yields then, and frames are drawn while the next ones are planned.
bool is_moving(const Viewer& viewer);
// Whether what is shown is of every n-th post.
bool is_coarse(const Viewer& viewer);
// "preparing full detail, 42 %", "loading"; "" where all is there.
std::string progress_words(const Viewer& viewer);

// Says something to the user: a toast, a line of the log.
void tell(Viewer& viewer, const std::string& text, bool is_error = false);
// The same of an error, which is printed, too.
void tell(Viewer& viewer, const Error& why);
// "wrote track.csv into /home/me": files of the working folder, which nobody sees who began with an icon.
std::string written_words(const std::string& file);
// Says that a file was written, or why not.
void tell_written(Viewer& viewer, const std::string& file, const Result<void>& written);

// With OROGRAPH_TRACE_WINDOW set, prints "state: ..." where that has changed: what was said last, and where
// the eye is. For programs that play a user.
void trace_state(Viewer& viewer);
// Likewise "frame: ..." of a frame that is shown now: when its input was asked for, when it was begun,
// planned, drawn and shown, in seconds of the steady clock, then its detail and whether its eye moved. Where
// this thread has measured levels of made terrain, which it should not, "levels: ..." says how many blocks.
void trace_frame(const SubmittedFrame& frame);

}  // namespace oro
