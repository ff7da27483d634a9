// Times as people write them, into seconds.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/base/result.h"

namespace oro {

// Seconds since 1970-01-01T00:00:00Z of a time with its distance from UTC, as ISO 8601 and RFC 3339 write it:
// 2026-06-21T05:30+02:00, 2026-06-21T03:30:00Z. Seconds may be left out and have no fractions; the distance
// may not be left out, is at most 15:59, and -00:00 is Z. Years 0000 to 9999, of the Gregorian calendar
// throughout, also in UTC. What goes wrong is `usage` with the reason alone: whoever asks knows the text and
// where it stands: no such form, or no such day or hour (leap seconds and 24:00 among them).
Result<std::int64_t> utc_time_from(std::string_view text);

}  // namespace oro
