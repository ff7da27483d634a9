#include "apps/window/kept_settings.h"

#include <array>
#include <utility>

#include "apps/report/progress_bar.h"

namespace oro {
namespace {

constexpr std::array<std::pair<const char*, bool Panels::*>, 6> panel_names{
    {{"layers", &Panels::layers},
     {"sun", &Panels::sun},
     {"statistics", &Panels::statistics},
     {"log", &Panels::messages},
     {"measure", &Panels::measure},
     {"two views", &Panels::two_views}}};

}  // namespace

std::map<std::string, bool> panels_by_name(const Panels& panels) {
    std::map<std::string, bool> names;
    for (const auto& [name, panel] : panel_names) names[name] = panels.*panel;
    return names;
}

Panels panels_of_names(const std::map<std::string, bool>& names) {
    Panels panels;
    for (const auto& [name, panel] : panel_names) {
        const auto found = names.find(name);
        if (found != names.end() && found->second) panels.open(panel);
    }
    return panels;
}

WindowSettings settings_of_user(std::vector<std::string>& notes) {
    const Result<WindowSettings> settings = read_window_settings(notes);
    return settings.ok() ? *settings : WindowSettings();
}

WindowOptions with_kept_size(const WindowOptions& options, const WindowSettings& settings) {
    WindowOptions kept = options;
    if (!kept.view.size && kept.view_file.empty())
        kept.view.size = std::to_string(settings.width_px) + "x" + std::to_string(settings.height_px);
    return kept;
}

void keep_settings(Viewer& viewer) {
    WindowSettings& settings = viewer.settings;
    const VkExtent2D extent = viewer.window.extent();
    if (viewer.keeps_size && extent.width > 0 && extent.height > 0 && !viewer.window.is_full_screen()) {
        settings.width_px = static_cast<int>(extent.width);
        settings.height_px = static_cast<int>(extent.height);
    }
    for (const auto& [name, is_open] : panels_by_name(viewer.panels)) settings.panels[name] = is_open;
    const Result<void> written = write_window_settings(settings);
    if (!written.ok()) say(viewer.options.quiet, "note: " + written.error().line());
}

}  // namespace oro
