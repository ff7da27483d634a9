#include "apps/settings/window_settings.h"

#include <filesystem>

#include "apps/report/json_fields.h"
#include "apps/settings/user_file.h"
#include "apps/settings/user_folders.h"

namespace oro {
namespace {

using nlohmann::json;

constexpr int narrowest_px = 64, widest_px = 65500;
constexpr double smallest_scale = 0.5, largest_scale = 4.0;

// Reads one key where it is there; a fault of it becomes a note.
template <class Read>
void take_setting(const json& object, const char* key, std::vector<std::string>& notes, Read read) {
    if (!object.contains(key)) return;
    try {
        read(key);
    } catch (const JsonFault& fault) {
        notes.push_back("window settings: " + fault.what + "; the default holds");
    }
}

UnitSystem units_in(const json& object, const char* key) {
    const std::string word = json_string(object, key);
    if (word == "metric") return UnitSystem::metric;
    if (word == "imperial") return UnitSystem::imperial;
    throw JsonFault{"'" + std::string(key) + "' is '" + word + "', neither metric nor imperial"};
}

std::map<std::string, bool> panels_in(const json& object, const char* key, std::vector<std::string>& notes) {
    const json& all = json_field(object, key);
    if (!all.is_object()) throw JsonFault{"'" + std::string(key) + "' must be an object"};
    std::map<std::string, bool> panels;
    for (const auto& [name, shown] : all.items())
        take_setting(all, name.c_str(), notes,
                     [&](const char* panel) { panels[panel] = json_flag(all, panel); });
    return panels;
}

Result<std::filesystem::path> settings_file() {
    ORO_TRY(const std::filesystem::path folder, user_config_folder());
    return folder / "window.json";
}

}  // namespace

WindowSettings window_settings_in(const json& object, std::vector<std::string>& notes) {
    WindowSettings settings;
    const auto side = [&](int& side_px) {
        return [&](const char* key) {
            side_px = static_cast<int>(json_whole(object, key, narrowest_px, widest_px));
        };
    };
    take_setting(object, "width_px", notes, side(settings.width_px));
    take_setting(object, "height_px", notes, side(settings.height_px));
    take_setting(object, "maximised", notes,
                 [&](const char* key) { settings.is_maximised = json_flag(object, key); });
    take_setting(object, "ui_scale", notes, [&](const char* key) {
        settings.ui_scale = json_number(object, key, smallest_scale, largest_scale);
    });
    take_setting(object, "units", notes, [&](const char* key) { settings.units = units_in(object, key); });
    take_setting(object, "panels", notes,
                 [&](const char* key) { settings.panels = panels_in(object, key, notes); });
    return settings;
}

void put_window_settings(const WindowSettings& settings, json& object) {
    object["width_px"] = settings.width_px;
    object["height_px"] = settings.height_px;
    object["maximised"] = settings.is_maximised;
    object["ui_scale"] = settings.ui_scale;
    object["units"] = settings.units == UnitSystem::metric ? "metric" : "imperial";
    object["panels"] = json::object();
    for (const auto& [name, shown] : settings.panels) object["panels"][name] = shown;
}

Result<WindowSettings> read_window_settings(std::vector<std::string>& notes) {
    ORO_TRY(const std::filesystem::path file, settings_file());
    ORO_TRY(const json object, read_user_json(file, notes));
    return window_settings_in(object, notes);
}

Result<void> write_window_settings(const WindowSettings& settings) {
    ORO_TRY(const std::filesystem::path file, settings_file());
    std::vector<std::string> said_before;
    ORO_TRY(json object, read_user_json(file, said_before));
    put_window_settings(settings, object);
    return write_user_json(file, object);
}

}  // namespace oro
