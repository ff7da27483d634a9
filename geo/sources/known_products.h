// Products that people download, known by the names of their files: which hold heights, what the others hold
// that lie beside them, and what the heights refer to.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace oro {

// What a file of a known product is. All texts are constants.
struct KnownFile {
    std::string_view product;  // "TanDEM-X DEM"
    // What it holds instead of heights: "radar amplitude". "" for a file of heights.
    std::string_view holds;
    // What its heights refer to, by the product's own specification: a CRS that PROJ reads ("EPSG:4979",
    // "EPSG:4326+3855"), and its name for people ("EGM2008 height"). Both are "" for what holds no heights,
    // and where the product leaves it open; the CRS alone is "" for EGM96, which needs no way.
    std::string_view heights_crs, heights_name;
};

// What stands between the words of a file's name.
inline constexpr std::string_view between_words = "_-. ()";

// A name in small letters, without its ending, without what browsers and file managers add to the names of
// copies: "x_dem (1)", "x_dem - copy", "x_dem copy 2" and "copy of x_dem" are "x_dem".
std::string_view without_copy_marks(std::string_view stem);

// A file of a known product by its name (no folders; letters in any case; copies count as the file itself),
// or nothing. A name that says that its heights were turned into others ("_egm96", "_navd88", "_orthometric",
// ...) brings no datum.
std::optional<KnownFile> known_file(std::string_view name);

}  // namespace oro
