// Work shared between threads where the order does not matter.
#pragma once

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace oro {

// Threads that work is worth sharing between on this machine: as many as it runs at a time, 1 .. `most`.
inline int thread_count(unsigned most = 16) {
    return static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, most));
}

// Calls work(i) once for each i of 0 .. count - 1, on up to `threads` threads (the caller's is one of them);
// returns when all are done. work must not throw, and its calls must not depend on each other: the result is
// then the same for any number of threads.
template <class Work>
void in_parallel(int count, int threads, const Work& work) {
    std::atomic<int> next{0};
    const auto take_turns = [&] {
        for (int i = next++; i < count; i = next++) work(i);
    };
    std::vector<std::jthread> others;
    for (int i = 1; i < std::min(threads, count); ++i) others.emplace_back(take_turns);
    take_turns();
}

}  // namespace oro
