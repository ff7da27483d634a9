#include "apps/vectors/view_vectors.h"

#include <filesystem>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/options/view_limits.h"
#include "apps/report/json_fields.h"
#include "apps/report/json_object.h"
#include "apps/report/progress_bar.h"
#include "apps/styles/colours.h"
#include "apps/styles/style_fields.h"
#include "apps/vectors/named_points.h"
#include "apps/vectors/vectors_in_region.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

constexpr Limits width_px = view_limits::overlay_width_px;

ordered_json files_json(const std::vector<std::string>& files) {
    ordered_json json = ordered_json::array();
    for (const std::string& file : files) json.push_back(path_json(file));
    return json;
}

std::vector<std::string> files_from(const nlohmann::json& json, const char* of) {
    const nlohmann::json& files = json_field(json, "files");
    if (!files.is_array() || files.empty() || files.size() > most_vector_files)
        throw JsonFault{"'files' of '" + std::string(of) + "' must be a list of 1 to " +
                        std::to_string(most_vector_files)};
    std::vector<std::string> all;
    for (const nlohmann::json& file : files)
        all.push_back(path_from(json_object<nlohmann::json>("files", file), "files"));
    return all;
}

Result<std::vector<VectorFile>> read_all(const std::vector<std::string>& files, const Region& region,
                                         std::vector<Fingerprints::OfSource>& fingerprints) {
    std::vector<VectorFile> all;
    for (const std::string& name : files) {
        ORO_TRY(VectorFile file, read_vectors(name));
        fingerprints.push_back({std::filesystem::path(name).filename().string(), file.fingerprint});
        if (std::string note = note_of_place(file, region); !note.empty())
            file.notes.push_back(std::move(note));
        all.push_back(std::move(file));
    }
    return all;
}

}  // namespace

std::vector<std::string*> VectorChoices::paths() {
    std::vector<std::string*> all;
    for (auto* const files : {&names, &overlay}) {
        for (std::string& file : *files) all.push_back(&file);
    }
    return all;
}

Result<void> check_vectors(const ViewOptions& options, VectorChoices& choices) {
    for (const auto& [option, files] :
         {std::pair{"--names", &options.names}, {"--overlay", &options.overlay}}) {
        if (files->size() > most_vector_files)
            return refused(option, "", "at most " + std::to_string(most_vector_files) + " files");
    }
    if (options.names_field && !choices.any())
        return refused("--names-field", "", "says nothing without --names FILE");
    for (const auto& [option, is_given] : {std::pair{"--overlay-colour", options.overlay_colour.has_value()},
                                           {"--overlay-width", options.overlay_width_px.has_value()},
                                           {"--overlay-fill", options.overlay_fill.has_value()}}) {
        if (is_given && choices.overlay.empty())
            return refused(option, "", "says nothing without --overlay FILE");
    }
    if (options.overlay_colour) {
        const auto colour = colour_from(*options.overlay_colour);
        if (!colour)
            return refused("--overlay-colour", *options.overlay_colour, "must be a colour such as #e2252b");
        choices.overlay_colour = *colour;
    }
    return {};
}

void put_vectors(const VectorChoices& choices, ordered_json& json) {
    if (!choices.names.empty()) json["names"] = json_object("files", files_json(choices.names));
    if (!choices.overlay.empty())
        json["overlay"] =
            json_object("files", files_json(choices.overlay), "colour", colour_text(choices.overlay_colour),
                        "width_px", choices.overlay_width_px, "fill", choices.overlay_fill);
    if (choices.any()) json["names_field"] = path_json(choices.names_field);
}

VectorChoices vectors_from(const nlohmann::json& json) {
    VectorChoices choices;
    if (json.contains("names")) choices.names = files_from(json_field(json, "names"), "names");
    if (json.contains("overlay")) {
        const nlohmann::json& overlay = json_field(json, "overlay");
        choices.overlay = files_from(overlay, "overlay");
        choices.overlay_colour = colour_of(overlay, "colour");
        choices.overlay_width_px = json_number(overlay, "width_px", width_px.low, width_px.high);
        constexpr Limits fill = view_limits::overlay_fill;
        choices.overlay_fill =
            overlay.contains("fill") ? json_number(overlay, "fill", fill.low, fill.high) : 0.0;
    }
    if (choices.any() && json.contains("names_field")) choices.names_field = path_from(json, "names_field");
    return choices;
}

Result<std::shared_ptr<const VectorsRead>> open_vectors(const VectorChoices& choices, const Region& region,
                                                        std::vector<Fingerprints::OfSource>& fingerprints) {
    if (!choices.any()) return std::shared_ptr<const VectorsRead>();
    auto vectors = std::make_shared<VectorsRead>();
    ORO_TRY(vectors->names, read_all(choices.names, region, fingerprints));
    ORO_TRY(vectors->overlay, read_all(choices.overlay, region, fingerprints));
    return std::shared_ptr<const VectorsRead>(std::move(vectors));
}

void say_vectors(const VectorsRead& vectors, const VectorChoices& choices, bool quiet) {
    for (const auto* const files : {&vectors.names, &vectors.overlay}) {
        for (const VectorFile& file : *files) {
            for (const std::string& note : file.notes) say(quiet, "note: " + note);
        }
    }
    for (const VectorFile& file : vectors.names) {
        if (!has_named_point(file, choices.names_field))
            say(quiet, "note: " + file.file + ": has no point with something in the field '" +
                           choices.names_field + "': nothing of it is named");
    }
}

}  // namespace oro
