#include "apps/accuracy/pixel_check.h"

#include "apps/labels/labelled_picture.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"

namespace oro {
namespace {

// What pixels that are not as they should be tell of whom.
std::string reason_of(const View& view, const PictureDifference& difference, bool same_style) {
    const std::optional<Fingerprints>& recorded = view.recorded->fingerprints;
    if (!same_style) return "the style '" + view.style + "' is another than it was drawn with";
    if (recorded && recorded->pixels && difference.file_fingerprint == recorded->pixels)
        return recorded->program == view.fingerprints->program
                   ? "nobody changed them since they were drawn, so the device or its driver draws otherwise"
                   : "nobody changed them since they were drawn, so version " + recorded->program +
                         " of the program drew otherwise";
    if (recorded && recorded->pixels &&
        (difference.file_fingerprint || difference.drawn_fingerprint == *recorded->pixels))
        return "they were changed after it was drawn";
    return "they were changed after it was drawn, or it was drawn from other data, or by another program or "
           "device";
}

}  // namespace

bool is_drawn_one(const PictureDifference& difference) {
    const PixelsOff& beyond = difference.beyond;
    return static_cast<double>(beyond.count) <= most_off_share * static_cast<double>(difference.pixels) &&
           beyond.most_in_a_square <= most_off_in_a_square;
}

Result<PictureDifference> compare_pixels(const std::string& picture, const View& view,
                                         const TrueGround& ground, const Gpu& gpu, Scene& scene,
                                         RasterPath path, const Style& style,
                                         std::span<const std::uint8_t> strip,
                                         const RenderProgress& progress) {
    const Camera& camera = view.camera;
    ORO_TRY(
        PictureComparison comparison,
        PictureComparison::open(picture, camera.width_px, camera.height_px + view.legend_px, device_slack));
    const auto take = [&](std::span<const std::uint8_t> rgb) { return comparison.add_drawn_row(rgb); };
    ORO_CHECK(render_labelled(gpu, scene, view, ground, style, path, take, progress));
    const auto row_bytes = static_cast<std::size_t>(camera.width_px) * 3;
    for (std::size_t at = 0; at < strip.size(); at += row_bytes)
        ORO_CHECK(take(strip.subspan(at, row_bytes)));
    return comparison.finish();
}

std::optional<std::string> fault_of_pixels(const View& view, const PictureDifference& difference,
                                           bool same_style) {
    const std::optional<Fingerprints>& recorded = view.recorded->fingerprints;
    const bool repeats = recorded && recorded->pixels && difference.drawn_fingerprint == *recorded->pixels;
    const bool edited = recorded && recorded->pixels && difference.file_fingerprint &&
                        difference.file_fingerprint != recorded->pixels;
    // Where the very pixels are drawn again, any that differs was changed; a JPEG's loss is the same then,
    // but other programs lose more when they write it anew.
    if (!edited && is_drawn_one(difference)) return std::nullopt;
    const bool any = repeats && !difference.lossy;
    const PixelsOff& off = any || difference.beyond.count == 0 ? difference.any : difference.beyond;
    const std::string which = "its pixels are not what its view draws: " +
                              (off.count > 0 ? pixels_words(off, difference.pixels) + " differ"
                                             : std::string("too little to say where"));
    return which + "; " + reason_of(view, difference, same_style);
}

std::string pixels_words(const PixelsOff& off, std::uint64_t pixels) {
    return grouped(off.count) + " of " + counted(pixels, "pixel", "pixels") + " (columns " +
           std::to_string(off.left) + " to " + std::to_string(off.right) + ", rows " +
           std::to_string(off.top) + " to " + std::to_string(off.bottom) + ")";
}

std::string pixels_text(const PictureDifference& difference) {
    std::string text = "Pixels: as the view draws them here";
    if (difference.any.count == 0) return text + (difference.lossy ? ", but for the JPEG's loss.\n" : ".\n");
    return text + ", within what " + (difference.lossy ? "a JPEG and another device" : "another device") +
           " may change: " + grouped(difference.any.count) + " of " +
           counted(difference.pixels, "pixel", "pixels") + " differ, by " +
           std::to_string(difference.largest) + " of 255 at most.\n";
}

nlohmann::ordered_json pixels_json(const PictureDifference& difference) {
    return json_object("all", difference.pixels, "lossy", difference.lossy, "differ", difference.any.count,
                       "differ_beyond_slack", difference.beyond.count, "slack_of_255",
                       difference.lossy ? device_slack.lossy : device_slack.lossless, "largest_of_255",
                       difference.largest, "most_in_a_square", difference.beyond.most_in_a_square);
}

}  // namespace oro
