// The settings of a view that are plain values: each is one field here, both of a view and of a command line,
// and one row of the table of options (apps/view/view_option_table.cpp).
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/frame/height_quantization.h"
#include "geo/drape/image_source.h"

namespace oro {

// What a style that has water takes for the sea: level ground alone; low ground, too (posts up to 5 m above
// sea level, and all below it, whose mean over 3 x 3 of them is at most 1 m: heights of the sea with noise);
// or, beside level ground, what has no height.
enum class Sea { level, low, voids };
// What is below the rim of a region, in styles that draw voids: walls down to the ellipsoid, or nothing.
enum class Rim { skirt, none };
// Where ground ends before the sky or before farther ground, in pictures of one sample: a pixel shows what it
// has of both, or what is in its middle.
enum class Edges { smooth, steps };
// What a picture shows of its own making, in the place of colours: whether the last of a frame's rounds drew
// it, how coarse, which meshlet, which triangle, how many triangles, which cluster, which group of clusters.
enum class Show { visible, levels, meshlets, triangles, overdraw, clusters, groups };
// Whether what is shown is there of clusters alone.
constexpr bool is_of_clusters(std::optional<Show> show) {
    return show == Show::clusters || show == Show::groups;
}

// Which lines lie over the ground: of latitude and longitude, or of the CRS of the data.
enum class Graticule { geographic, projected };

// The type in which a command line gives a value of type T, or does not give it: numbers are optional
// numbers, lists are lists, and all else is the word that was typed.
template <class T>
struct AskedAs {
    using Type = std::conditional_t<std::is_arithmetic_v<T> && !std::is_same_v<T, bool>, std::optional<T>,
                                    std::optional<std::string>>;
};
template <class T>
struct AskedAs<std::optional<T>> : AskedAs<T> {};
template <class T>
struct AskedAs<std::vector<T>> {
    using Type = std::vector<T>;
};

// The settings as a command line gives them: as they were typed, none unless they were.
struct OnCommandLine {
    template <class T>
    using Field = typename AskedAs<T>::Type;
    template <class T>
    static constexpr std::nullopt_t usual(T /*in_views*/) {
        return std::nullopt;
    }
};
// The settings as a view has them: all of them, each with its default.
struct OfView {
    template <class T>
    using Field = T;
    template <class T>
    static constexpr T usual(T value) {
        return value;
    }
};

template <class Where>
struct ViewSettings {
    template <class T>
    using Field = typename Where::template Field<T>;

    Field<int> samples = Where::usual(1);
    Field<double> exaggeration = Where::usual(1.0);
    Field<std::optional<double>> visibility_km;  // nothing: the style's
    Field<std::string> style = Where::usual("natural");
    Field<Sea> sea = Where::usual(Sea::level);
    Field<Rim> rim = Where::usual(Rim::skirt);
    Field<std::vector<std::string>> drape;  // images over the ground, the last on top
    Field<double> drape_opacity = Where::usual(1.0);
    Field<ImageValues> drape_values = Where::usual(ImageValues::by_file);
    Field<std::optional<bool>> shadows;               // nothing: as the style has it
    Field<std::optional<bool>> sky_openness;          // likewise
    Field<std::optional<bool>> trees;                 // likewise: those that a style invents
    Field<std::optional<bool>> labels;                // likewise: heights on contour lines
    Field<std::optional<double>> contour_interval_m;  // nothing: the style's, or by the view
    Field<std::optional<Edges>> edges;                // likewise
    Field<std::optional<Show>> show;                  // nothing: the ground
    Field<std::optional<Graticule>> graticule;
    // "auto", "mesh" or "compute": written views name the one that drew them.
    Field<std::string> pipeline = Where::usual("auto");
    // "auto", "clusters" or "grid": what triangles are taken from (apps/drawing).
    Field<std::string> mesh = Where::usual("auto");
    // The clusters of this level of the graph alone, instead of those that tau_px asks for.
    Field<std::optional<int>> mesh_level;
    Field<double> tau_px = Where::usual(1.0);  // largest error of what is drawn; 0: full resolution
    Field<HeightStorage> heights = Where::usual(HeightStorage::f32);
};

}  // namespace oro
