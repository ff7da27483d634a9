// JSON as the program prints it.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/one_line.h"

namespace oro {

// Text of a JSON value; bytes that are no UTF-8 (in file names) are replaced, not refused. Characters that a
// terminal would obey, or show nothing of, are written as escapes.
inline std::string json_text(const nlohmann::ordered_json& json, bool pretty) {
    return with_unseen_escaped(
        json.dump(pretty ? 2 : -1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

// "2026-11-21T09:00:00Z"
std::string time_text(std::int64_t time_utc_s);
// The clock, or SOURCE_DATE_EPOCH for builds that must repeat; seconds since 1970, UTC.
std::int64_t time_now_s();

}  // namespace oro
