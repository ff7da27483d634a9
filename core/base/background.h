// Work on a thread of its own.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <system_error>
#include <type_traits>

namespace oro {

// This begins `work` on a thread of its own. Where no thread is to be had, get() of what is given does it.
// What the work uses outlives the future, whose end waits for it.
template <class Work>
[[nodiscard]] std::future<std::invoke_result_t<const Work&>> begin_in_background(const Work& work) {
    try {
        return std::async(std::launch::async, work);
    } catch (const std::system_error&) {
        return std::async(std::launch::deferred, work);
    }
}

// This says whether get() would not wait for a thread: the work is done, or is yet to be done by get().
template <class T>
[[nodiscard]] bool is_ready(const std::future<T>& future) {
    return future.valid() && future.wait_for(std::chrono::seconds(0)) != std::future_status::timeout;
}

}  // namespace oro
