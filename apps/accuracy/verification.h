// A view drawn and measured against the truth: what shot --verify and compare tell.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/accuracy/beyond_data.h"
#include "apps/view/truth.h"
#include "apps/view/view.h"
#include "core/measure/picture_errors.h"
#include "geo/meshes/placed_mesh.h"
#include "render/frame/depth_picture.h"

namespace oro {

// How far the ground that a picture shows is from the data's surface where it lies between their posts and is
// invented (--detail), by pixels that show such ground.
struct InventedGround {
    std::uint64_t pixels{};
    double rms_m{};
    double largest_m{};
    double largest_px{};  // as the eye sees it
};

struct Verification {
    DepthPicture picture;
    Skyline true_skyline;
    PictureErrors errors;
    std::optional<InventedGround> invented{};  // of a view with --detail
    double slack_px{};                         // besides tau: what drawing may round off in this view
};

// Draws a view as its picture is drawn, one sample a pixel and with depths, and measures it. Errors: those of
// the device; a region that cannot be read; a scene that does not fit into --gpu-memory.
// meshes: what is drawn in the place of the view's; null: they themselves.
Result<Verification> verify_view(const View& view, const TrueScene& truth, const Gpu& gpu, Scene& scene,
                                 RasterPath path, const gpu::FrameStyle& style,
                                 const std::vector<PlacedMesh>* meshes);

// Measures the invented ground of a picture that was drawn and measured, of a region with --detail; of others
// nothing.
void measure_invented(Verification& done, const View& view, const Region& region);

// The measuring alone, of a picture that is drawn. `truth`: of the same camera. drawn: as picture_errors().
void measure(Verification& done, const TruePicture& truth, std::span<const TrueMesh> drawn = {});

// For people: a table of some lines, each with its line end, and what the data cannot tell. view: that was
// drawn.
std::string verification_text(const Verification& verification, const View& view, const UnseenGround& unseen);
nlohmann::ordered_json verification_json(const Verification& verification);

// What is in an error picture, where it is not a colour of the scale.
inline constexpr double error_scale_from_px = 0.001, error_scale_to_px = 10.0;
enum class ErrorPanels { four, displacement };
// The picture of errors: displacement, surface, seen and skyline, a picture each, two beside two; or the
// first alone. Colours are those of a logarithmic scale; sky is grey, ground that could not be measured is
// hatched magenta. A legend with the figures stands below. At least 320 px wide.
Result<std::vector<std::uint8_t>> error_picture_png(const Verification& verification, double tau_px,
                                                    ErrorPanels panels);
// All four as a file.
Result<void> write_error_picture(const std::string& path, const Verification& verification, double tau_px,
                                 bool overwrite);
// The legend's lines: what the colours mean, then what stands below the scale.
std::vector<std::string> error_legend(const Verification& verification, double tau_px);

}  // namespace oro
