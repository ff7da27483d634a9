// What stands between C and the program's functions: no exception passes, and each failure is told as a code
// and a text of the calling thread.
#pragma once

#include <functional>

#include "apps/library/orograph.h"
#include "core/base/progress.h"
#include "core/base/result.h"

namespace oro {

// What a progress function of the library throws where its caller wants to stop. It is no std::exception, so
// that nothing on the way takes it for a fault of the data; guarded_call() turns it into ORO_CANCELLED.
struct Cancelled {};

// An answer that the caller's buffer has no room for.
struct TooSmall {
    std::string what;
};

// Does `work` and returns its status, which the thread's next oro_error_code() and oro_error_text() tell,
// too. Whatever is thrown ends here. While it works the thread has the C locale, whichever the process has.
oro_status guarded_call(const std::function<Result<void>()>& work) noexcept;

// The caller's progress function as reading takes it; it throws Cancelled. Nothing for NULL.
Progress progress_to(oro_progress progress, void* user);

// The status and the text of the thread's last guarded call.
oro_status last_status() noexcept;
const char* last_text() noexcept;

// An argument that cannot mean anything: "name: what".
Error bad_argument(const char* name, const std::string& what);
// Errors: null.
Result<void> check_given(const char* name, const void* pointer);
// That a structure of the caller's is as long as the first version of this interface has it, or longer.
Result<void> check_size(const char* name, std::size_t size, std::size_t least);
// Options of a caller, or the usual ones where it gives none. Errors: a structure that is too short.
template <class Options>
Result<Options> options_of(const Options* given, const Options& usual) {
    if (given == nullptr) return usual;
    ORO_CHECK(check_size("options", given->size, sizeof(Options)));
    return *given;
}
// Errors: a latitude or longitude that is none; `name` with `number` where that is 0 or more.
Result<void> check_place(const char* name, double lat_deg, double lon_deg, std::ptrdiff_t number = -1);

}  // namespace oro
