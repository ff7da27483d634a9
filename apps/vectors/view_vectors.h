// The vector files of a view: named points, and lines and polygons over the ground.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/fingerprints/fingerprints.h"
#include "apps/options/options.h"
#include "apps/styles/colours.h"
#include "core/base/result.h"
#include "geo/region/region.h"
#include "geo/vectors/vector_file.h"

namespace oro {

// What a view says of them.
struct VectorChoices {
    std::vector<std::string> names;   // files whose points are named
    std::string names_field{"name"};  // which of their fields is the name
    std::vector<std::string>
        overlay;  // files whose lines and polygons lie on the ground, and points are named
    ColourCodes overlay_colour{226, 37, 43};
    double overlay_width_px{2.0};
    double overlay_fill{0.2};  // opacity of polygons' areas; 0 in views of before there was any

    [[nodiscard]] bool any() const { return !names.empty() || !overlay.empty(); }
    // All paths, to be looked at or changed.
    [[nodiscard]] std::vector<std::string*> paths();
};

// What is in these files.
struct VectorsRead {
    std::vector<VectorFile> names;
    std::vector<VectorFile> overlay;
};

// Files of each kind that a view may have.
inline constexpr std::size_t most_vector_files = 64;

// Checks the choices, which have what options give, and takes the colour. Errors: a colour that is none, too
// many files, a detail of files that are not named (usage).
Result<void> check_vectors(const ViewOptions& options, VectorChoices& choices);

// Puts the choices into a view's JSON, where there are any, and takes them out of it. Throws JsonFault.
void put_vectors(const VectorChoices& choices, nlohmann::ordered_json& json);
VectorChoices vectors_from(const nlohmann::json& json);

// Reads the files; their names and fingerprints go to `fingerprints`. Each has a note where its features do
// not lie in the region (note_of_place()). Errors: those of read_vectors.
Result<std::shared_ptr<const VectorsRead>> open_vectors(const VectorChoices& choices, const Region& region,
                                                        std::vector<Fingerprints::OfSource>& fingerprints);

// Says the notes of the files, and which of them cannot give anything.
void say_vectors(const VectorsRead& vectors, const VectorChoices& choices, bool quiet);

}  // namespace oro
