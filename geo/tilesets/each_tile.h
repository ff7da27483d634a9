// Work on the tiles of a tileset.
#pragma once

#include <algorithm>
#include <cstddef>
#include <mutex>

#include "core/base/parallel.h"
#include "core/base/result.h"

namespace oro {

// Calls work(number) for each tile of a level on several threads, in parts, so that progress is report
// between them. Errors: the first that a call has.
template <class Work, class Report>
Result<void> each_tile(std::size_t count, int threads, const Work& work, const Report& report) {
    std::mutex mutex;
    Result<void> fault;
    const std::size_t at_once = std::size_t{16} * static_cast<std::size_t>(threads);
    for (std::size_t first = 0; first < count && fault.ok(); first += at_once) {
        const std::size_t now = std::min(at_once, count - first);
        in_parallel(static_cast<int>(now), threads, [&](int i) {
            const Result<void> one = work(first + static_cast<std::size_t>(i));
            const std::scoped_lock lock(mutex);
            if (!one.ok() && fault.ok()) fault = one.error();
        });
        report(now);
    }
    return fault;
}

}  // namespace oro
