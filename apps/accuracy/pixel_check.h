// Whether the pixels of a picture's file are what its view draws.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>

#include "apps/styles/style.h"
#include "apps/view/view.h"
#include "core/truth/true_ground.h"
#include "geo/pixels/picture_difference.h"
#include "render/frame/picture_renderer.h"

namespace oro {

// What another device may draw otherwise, and no more. Rounding moves a colour by one or two of 255, and at
// the rims of triangles a pixel may show one or the other: single pixels, all over the picture. Measured: the
// golden pictures, drawn by another build, differ by 3 at most; the two ways of drawing in at most one pixel
// of 230,400 (tests/apps/accuracy/pixels_test.cpp). What a JPEG loses is done to the fresh drawing first. Of
// JPEGs that were read and written once more, at qualities from 25 to 95, no more than 233 of 230,400 pixels
// were off by more than 24, and 6 in a square.
inline constexpr PixelSlack device_slack{3, 24};  // of 255
inline constexpr double most_off_share = 0.002;   // of all pixels: beyond the slack
inline constexpr int most_off_in_a_square = 32;   // of 8 x 8 pixels

// True where a picture is the drawn one as far as another device may tell.
bool is_drawn_one(const PictureDifference& difference);

// Draws a view as its picture is drawn, and compares that, with the strip below it, with the picture's file.
// Errors: those of open_picture_rows and of the device.
Result<PictureDifference> compare_pixels(const std::string& picture, const View& view,
                                         const TrueGround& ground, const Gpu& gpu, Scene& scene,
                                         RasterPath path, const Style& style,
                                         std::span<const std::uint8_t> strip, const RenderProgress& progress);

// What is wrong with the pixels of the picture that a view comes from; nothing where they are as its view
// draws them. `same_style`: colours and light are those that it was drawn with.
std::optional<std::string> fault_of_pixels(const View& view, const PictureDifference& difference,
                                           bool same_style);

// "400 of 80,000 pixels (columns 100 to 119, rows 60 to 79)"
std::string pixels_words(const PixelsOff& off, std::uint64_t pixels);
// For people: a line with its end, of pixels without fault.
std::string pixels_text(const PictureDifference& difference);
nlohmann::ordered_json pixels_json(const PictureDifference& difference);

}  // namespace oro
