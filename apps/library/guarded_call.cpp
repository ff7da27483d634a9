#include "apps/library/guarded_call.h"

#include <locale.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

namespace oro {
namespace {

struct LastCall {
    oro_status status{ORO_OK};
    std::string text;
    const char* fixed{nullptr};  // instead of `text`, where there is no memory for one
};

LastCall& last_call() noexcept {
    thread_local LastCall call;
    return call;
}

oro_status keep(oro_status status, const std::string& text) noexcept {
    LastCall& call = last_call();
    call.status = status;
    call.fixed = nullptr;
    try {
        call.text = text;
    } catch (...) {
        call.fixed = "there is not enough memory";
    }
    return status;
}

oro_status keep_fixed(oro_status status, const char* text) noexcept {
    LastCall& call = last_call();
    call.status = status;
    call.fixed = text;
    return status;
}

// The C locale for one thread while it lives: numbers are written and read with a point.
class PlainLocale {
  public:
    PlainLocale() noexcept : before_(plain() != nullptr ? uselocale(plain()) : nullptr) {}
    ~PlainLocale() {
        if (before_ != nullptr) uselocale(before_);
    }
    PlainLocale(const PlainLocale&) = delete;
    PlainLocale& operator=(const PlainLocale&) = delete;

  private:
    static locale_t plain() noexcept {
        static const locale_t locale = newlocale(LC_ALL_MASK, "C", nullptr);
        return locale;
    }
    locale_t before_;
};

}  // namespace

oro_status guarded_call(const std::function<Result<void>()>& work) noexcept {
    const PlainLocale locale;
    try {
        const Result<void> done = work();
        if (done.ok()) return keep_fixed(ORO_OK, "");
        return keep(static_cast<oro_status>(done.error().kind), done.error().line());
    } catch (const Cancelled&) {
        return keep_fixed(ORO_CANCELLED, "cancelled");
    } catch (const TooSmall& room) {
        return keep(ORO_TOO_SMALL, room.what);
    } catch (const std::bad_alloc&) {
        return keep_fixed(ORO_FAILED, "memory: there is not enough of it for this");
    } catch (const std::exception& fault) {
        return keep(ORO_FAILED, std::string("failed: ") + fault.what());
    } catch (...) {
        return keep_fixed(ORO_FAILED, "failed: for a reason that nobody gave");
    }
}

Progress progress_to(oro_progress progress, void* user) {
    if (progress == nullptr) return {};
    return [progress, user](double share, const std::string& what) {
        if (progress(share, what.c_str(), user) != 0) throw Cancelled{};
    };
}

oro_status last_status() noexcept {
    return last_call().status;
}

const char* last_text() noexcept {
    const LastCall& call = last_call();
    return call.fixed != nullptr ? call.fixed : call.text.c_str();
}

Error bad_argument(const char* name, const std::string& what) {
    return {ErrorKind::usage, name, what};
}

Result<void> check_given(const char* name, const void* pointer) {
    if (pointer == nullptr) return bad_argument(name, "is NULL");
    return {};
}

Result<void> check_size(const char* name, std::size_t size, std::size_t least) {
    if (size >= least) return {};
    return bad_argument(name, "has the size " + std::to_string(size) + ", less than " +
                                  std::to_string(least) + ": begin with its initializer");
}

Result<void> check_place(const char* name, double lat_deg, double lon_deg, std::ptrdiff_t number) {
    const bool is_lat = lat_deg >= -90.0 && lat_deg <= 90.0, is_lon = lon_deg >= -180.0 && lon_deg <= 180.0;
    if (is_lat && is_lon) return {};
    std::string where = name;
    if (number >= 0) where += " " + std::to_string(number);
    char text[120];
    std::snprintf(text, sizeof text, "%s %.15g is not between %s", is_lat ? "longitude" : "latitude",
                  is_lat ? lon_deg : lat_deg, is_lat ? "-180 and 180" : "-90 and 90");
    return Error{ErrorKind::usage, where, text};
}

}  // namespace oro
