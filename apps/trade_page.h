// The parts of a trade's page: not for use outside trade_*.cpp.
#pragma once

#include <string>

#include "apps/trade_report.h"

namespace oro {

// Sections with a heading, plots and what they show.
std::string settings_plots_html(const TradeReport& report);  // time, triangles, bytes
std::string effects_plot_html(const TradeReport& report);
std::string views_plots_html(const TradeReport& report);  // interior, skyline
inline constexpr int page_plots = 6;

std::string settings_table_html(const TradeReport& report);
std::string effects_table_html(const TradeReport& report);
std::string shots_table_html(const TradeReport& report);

// What the page looks like, light and dark.
const char* page_style();

}  // namespace oro
