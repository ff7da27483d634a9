// Fingerprints: what ties a picture to the data, the geoid and the program that it was drawn with, and to its
// own pixels. XXH64: they tell what was swapped or changed, not a forger who writes fingerprints anew.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/styles/style.h"
#include "geo/measures/region_resampling.h"
#include "geo/region/region.h"
#include "shaders/shared.h"

namespace oro {

struct Fingerprints {
    struct OfSource {
        std::string name;                    // without its folder; "" where a view tells no paths
        std::optional<std::uint64_t> posts;  // of its posts as they were laid; older pictures may tell none
    };

    std::string program;                 // its version, and a fingerprint of the code that makes pictures
    std::uint64_t grid{};                // where the region's posts lie
    std::optional<std::uint64_t> posts;  // what they are: decides whether data are the same. As above
    std::vector<OfSource> sources;       // to name the ones that changed; none where there are too many
    std::optional<RegionResampling> resampling;  // what the region lost by it; nothing where nothing was
    std::string geoid;                           // its name
    std::uint64_t undulation{};                  // N over the region
    std::vector<OfSource> images;                // over the ground, as the view names them
    std::vector<OfSource> cover;                 // land cover: the files, likewise, and their table
    std::vector<OfSource> canopy;                // files of canopy heights, likewise
    std::vector<OfSource> vectors;               // names and lines, likewise
    std::optional<std::uint64_t> style;          // colours and light; of drawn pictures alone, as
    std::optional<std::uint64_t> pixels;         // what was drawn, before a JPEG's loss
    bool
        data_changed{};  // the view was made for other data, and is drawn with these because somebody said so
};

// A view's JSON must fit into a JPEG's 65,000 bytes: of more sources none is told by itself.
inline constexpr std::size_t most_sources_with_fingerprints = 256;

// Images over the ground that a view may have.
inline constexpr std::size_t most_images = 64;

// "0.1.0 4f1d22a09c3e": the version, and twelve digits of the SHA-256 of all code between files and pixels.
std::string program_fingerprint();

// The fingerprints of a region that was just opened, without style and pixels.
Fingerprints fingerprints_of(const Region& region);
std::uint64_t style_fingerprint(const Style& style);

nlohmann::ordered_json fingerprints_json(const Fingerprints& fingerprints);
// Throws JsonFault.
Fingerprints fingerprints_from(const nlohmann::json& json);

// The pixels' fingerprint as a view's text has it: known when the last of them is drawn, and put where it was
// 0 until then.
std::string pixels_field(std::uint64_t pixels);

}  // namespace oro
