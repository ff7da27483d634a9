// Work that a window's user waits for, and that the window goes on beside.
#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>

#include "core/base/background.h"
#include "core/base/result.h"

namespace oro {

// One piece of work on a thread of its own. What it reads outlives this.
//     BackgroundWork<int> work([](const auto& tell_share, const std::stop_token&) {
//         tell_share(0.5);
//         return Result<int>(42);
//     });
//     if (work.ready()) std::printf("%d\n", work.take().value());
template <class T>
class BackgroundWork {
  public:
    using TellShare = std::function<void(double share)>;  // 0 to 1; from any thread
    using Work = std::function<Result<T>(const TellShare& tell_share, const std::stop_token& stop)>;

    // Begins. Where no thread is to be had, take() does it.
    explicit BackgroundWork(Work work) {
        const auto all = [this, work = std::move(work)] {
            return work([this](double share) { share_ = share; }, stop_.get_token());
        };
        done_ = begin_in_background(all);
    }
    // Asks it to stop, and waits until it has.
    ~BackgroundWork() { stop(); }
    BackgroundWork(const BackgroundWork&) = delete;
    BackgroundWork& operator=(const BackgroundWork&) = delete;

    void stop() { stop_.request_stop(); }
    [[nodiscard]] bool is_stopped() const { return stop_.stop_requested(); }
    [[nodiscard]] bool ready() const { return is_ready(done_); }
    [[nodiscard]] double share() const { return share_; }
    // What came of it, once; waits for it.
    Result<T> take() { return done_.get(); }

  private:
    std::stop_source stop_;
    std::atomic<double> share_{0.0};
    std::future<Result<T>> done_;  // last: it ends before what its thread uses
};

// What a piece of work has come to, once it is done: then it is gone. Nothing while it goes on, where there
// is none, and of one that was stopped, which goes likewise.
template <class T>
std::optional<Result<T>> take_finished(std::unique_ptr<BackgroundWork<T>>& work) {
    if (!work || !work->ready()) return std::nullopt;
    const auto done = std::move(work);
    Result<T> result = done->take();
    if (done->is_stopped()) return std::nullopt;
    return result;
}

}  // namespace oro
