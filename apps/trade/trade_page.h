// The page of a trade: text of the static page in apps/trade_page, put together when the program is built.
// Not for use outside trade_page.cpp and tests.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/trade/trade_report.h"

namespace oro {

// The page, with a gap for what <main> states of itself and another one for the data.
extern const char* const trade_page_before;
extern const char* const trade_page_middle;
extern const char* const trade_page_after;
// Its script by itself.
extern const char* const trade_page_script;

inline constexpr int trade_page_plots = 6;

// All that the page shows, as its script reads it (apps/trade/page/page.js). Numbers that are none are null;
// those beyond all are "inf" and "-inf". Text is UTF-8 without control characters.
nlohmann::ordered_json trade_page_json(const TradeReport& report);

}  // namespace oro
