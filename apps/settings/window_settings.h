// What a user's window remembers from one run to the next.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// In which units a window tells heights and distances.
enum class UnitSystem { metric, imperial };

struct WindowSettings {
    int width_px{1280};
    int height_px{720};
    bool is_maximised{false};
    double ui_scale{1.0};  // of text and panels over the picture, 0.5 to 4, beside the monitor's own
    UnitSystem units{UnitSystem::metric};
    std::map<std::string, bool>
        panels;  // by name, whether each is shown; one that is not here is as it likes

    bool operator==(const WindowSettings&) const = default;
};

// Reads settings from an object. A key that is missing, or has a value that is none, leaves the default; of
// the latter one line each is added to `notes`. Other keys are passed over.
WindowSettings window_settings_in(const nlohmann::json& object, std::vector<std::string>& notes);
// Puts settings into an object, whose other keys stay.
void put_window_settings(const WindowSettings& settings, nlohmann::json& object);

// Reads the file of a user's settings, window.json in user_config_folder(); the defaults where there is none.
// `notes` gets what was wrong in it, and what was done about that. Errors: as of read_user_json().
Result<WindowSettings> read_window_settings(std::vector<std::string>& notes);
// Writes that file; keys of another version of the program stay. Errors: as of write_user_json().
Result<void> write_window_settings(const WindowSettings& settings);

}  // namespace oro
