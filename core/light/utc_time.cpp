#include "core/light/utc_time.h"

#include <chrono>
#include <optional>
#include <string>

namespace oro {
namespace {

// Takes a text apart from its front.
class Reader {
  public:
    explicit Reader(std::string_view text) : rest_(text) {}

    // Exactly so many digits, or nothing.
    std::optional<int> digits(std::size_t count) {
        if (rest_.size() < count) return std::nullopt;
        int value = 0;
        for (const char c : rest_.substr(0, count)) {
            if (c < '0' || c > '9') return std::nullopt;
            value = value * 10 + (c - '0');
        }
        rest_.remove_prefix(count);
        return value;
    }

    bool take(char c) {
        if (!rest_.starts_with(c)) return false;
        rest_.remove_prefix(1);
        return true;
    }

    [[nodiscard]] bool done() const { return rest_.empty(); }

  private:
    std::string_view rest_;
};

struct Written {
    int year{}, month{}, day{}, hour{}, minute{}, second{};
    int east_sign{1}, east_hours{}, east_minutes{};
};

bool read_date_and_clock(Reader& reader, Written& written) {
    const auto part = [&reader](std::size_t count, int& value) {
        const std::optional<int> read = reader.digits(count);
        if (read) value = *read;
        return read.has_value();
    };
    return part(4, written.year) && reader.take('-') && part(2, written.month) && reader.take('-') &&
           part(2, written.day) && reader.take('T') && part(2, written.hour) && reader.take(':') &&
           part(2, written.minute) && (!reader.take(':') || part(2, written.second));
}

bool read_distance_from_utc(Reader& reader, Written& written) {
    if (reader.take('Z')) return true;
    if (reader.take('-'))
        written.east_sign = -1;
    else if (!reader.take('+'))
        return false;
    const std::optional<int> hours = reader.digits(2);
    if (!hours || !reader.take(':')) return false;
    const std::optional<int> minutes = reader.digits(2);
    if (!minutes) return false;
    written.east_hours = *hours;
    written.east_minutes = *minutes;
    return true;
}

Error refused(const char* why) {
    return {ErrorKind::usage, "", why};
}

}  // namespace

Result<std::int64_t> utc_time_from(std::string_view text) {
    using namespace std::chrono;
    Reader reader(text);
    Written w;
    if (!read_date_and_clock(reader, w) || !read_distance_from_utc(reader, w) || !reader.done())
        return refused("must be a time like 2026-06-21T05:30+02:00 or 2026-06-21T03:30:00Z");
    const year_month_day date{year{w.year}, month{static_cast<unsigned>(w.month)},
                              day{static_cast<unsigned>(w.day)}};
    if (!date.ok() || w.hour > 23 || w.minute > 59 || w.second > 59)
        return refused("is no time of the calendar");
    if (w.east_hours > 15 || w.east_minutes > 59)
        return refused("has a distance from UTC that no clock has (15:59 is the most)");
    const seconds clock = hours{w.hour} + minutes{w.minute} + seconds{w.second};
    const seconds east = w.east_sign * (hours{w.east_hours} + minutes{w.east_minutes});
    const sys_seconds utc = sys_days{date} + clock - east;
    const year_month_day utc_date{floor<days>(utc)};
    if (utc_date.year() < year{0} || utc_date.year() > year{9999})
        return refused("is outside the years 0 to 9999 in UTC");
    return static_cast<std::int64_t>(utc.time_since_epoch().count());
}

}  // namespace oro
