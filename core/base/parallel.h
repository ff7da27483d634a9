// Work shared between threads where the order does not matter.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <new>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace oro {

// Threads that work is worth sharing between on this machine: as many as it runs at a time, 1 .. `most`.
inline int thread_count(unsigned most = 16) {
    return static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, most));
}

// Starts threads that each do `work`, `count` more of them or as many as the system has left: it may be out
// of threads (a user's or a container's limit) or out of memory for their stacks.
template <class Work>
void start_threads(std::vector<std::jthread>& threads, int count, const Work& work) {
    try {
        for (int i = 0; i < count; ++i) threads.emplace_back(work);
    } catch (const std::system_error&) {
    } catch (const std::bad_alloc&) {
    }
}

// Calls work(i) once for each i of 0 .. count - 1, on up to `threads` threads (the caller's is one of them,
// and does it all where there is no other to be had); returns when all are done. Its calls must not depend on
// each other: the result is then the same for any number of threads. What one of them throws (there is no
// memory left) ends the work, and is thrown to the caller.
template <class Work>
void in_parallel(int count, int threads, const Work& work) {
    std::atomic<int> next{0};
    std::atomic<bool> failed{false};
    std::exception_ptr thrown;
    const auto take_turns = [&]() noexcept {
        try {
            for (int i = next++; i < count && !failed; i = next++) work(i);
        } catch (...) {
            if (!failed.exchange(true)) thrown = std::current_exception();
        }
    };
    {
        std::vector<std::jthread> others;
        start_threads(others, std::min(threads, count) - 1, take_turns);
        take_turns();
    }
    if (thrown) std::rethrow_exception(std::move(thrown));
}

// The same for work that is too small to be handed out one by one: 8,192 calls at a time.
template <class Work>
void in_chunks(std::size_t count, int threads, const Work& work) {
    constexpr std::size_t at_a_time = 8192;
    in_parallel(static_cast<int>((count + at_a_time - 1) / at_a_time), threads, [&](int chunk) {
        const std::size_t first = static_cast<std::size_t>(chunk) * at_a_time;
        for (std::size_t i = first; i < std::min(first + at_a_time, count); ++i) work(i);
    });
}

}  // namespace oro
