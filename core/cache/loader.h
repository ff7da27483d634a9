// Items on their way from a file: read and decoded by threads in the background.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/result.h"

namespace oro {

// Loads what one thread, that of the frames, requests:
//     loader.request(missing);                               // what a frame lacks, most needed first
//     ORO_TRY(std::vector<Item> items, loader.take(false));  // what has come since
// Threads begin with the first request. Where fewer are to be had it does with those; without any, take()
// loads items itself. A key has an order.
template <class Key, class Item>
class Loader {
  public:
    struct Request {
        Key key;
        int priority{};  // those of the lowest are loaded first
    };
    // Loads an item. Several threads call it at a time; it may call add().
    using Load = std::function<Result<Item>(const Request&)>;
    // How much of the capacity an item takes.
    using Weight = std::function<std::size_t(const Item&)>;

    // threads: 0 for none. capacity: so many items may be under way or ready at a time, at least 1; one that
    // is ready counts as often as `weight` says. What `load` refers to outlives the loader.
    Loader(Load load, int threads, std::size_t capacity, Weight weight = {})
        : load_(std::move(load)),
          weight_(std::move(weight)),
          threads_to_start_(threads),
          capacity_(std::max<std::size_t>(1, capacity)) {}
    Loader(const Loader&) = delete;
    Loader& operator=(const Loader&) = delete;
    // What is under way is waited for; nothing else is begun.
    ~Loader() {
        for (std::jthread& thread : threads_) thread.request_stop();
        can_begin_.notify_all();
    }

    // What is needed now, most needed first, in the place of all requests before: those are cancelled, and an
    // item that is ready for one of them is dropped. What is under way still comes. What was taken may be
    // requested again.
    void request(std::span<const Key> keys) {
        std::vector<Request> requests;
        for (const Key& key : keys) requests.push_back({key, 0});
        request(std::move(requests), true);
    }
    void cancel() { request(std::vector<Request>(), true); }
    // Requests of several priorities. Where not `drops_ready`, all items that are ready stay.
    void request(std::vector<Request> requests, bool drops_ready) {
        if (!requests.empty() && threads_to_start_ > 0)
            start_threads(threads_, std::exchange(threads_to_start_, 0),
                          [this](const std::stop_token& stop) { work(stop); });
        std::ranges::stable_sort(requests, {}, &Request::priority);
        std::unique_lock lock(mutex_);
        std::erase_if(states_, [](const auto& one) { return one.second == State::taken; });
        if (drops_ready) drop_all_but(requests);
        std::erase_if(requests, [&](const Request& one) { return states_.contains(one.key); });
        requests_.assign(std::make_move_iterator(requests.begin()), std::make_move_iterator(requests.end()));
        if (requests_.empty()) changed_.notify_all();
        wake(lock);
    }
    // More requests of one priority, after others of it. Those that are under way, ready or taken since
    // request() are not loaded again. For any thread.
    void add(std::span<const Key> keys, int priority) {
        std::unique_lock lock(mutex_);
        std::vector<Request> added;
        for (const Key& key : keys)
            if (!states_.contains(key)) added.push_back({key, priority});
        requests_.insert(std::ranges::upper_bound(requests_, priority, {}, &Request::priority), added.begin(),
                         added.end());
        wake(lock);
    }

    // What is ready, in the order in which it became so; with `wait` at least one item, unless nothing is
    // requested or under way. Errors: the first of `load`, told once; it cancels what was requested. What
    // `load` threw (std::bad_alloc) is thrown here.
    Result<std::vector<Item>> take(bool wait) {
        std::unique_lock lock(mutex_);
        while (threads_.empty() && ready_.empty() && !requests_.empty()) load_next(lock);
        if (wait)
            changed_.wait(lock, [&] {
                return thrown_ || failed_ || !ready_.empty() || (requests_.empty() && under_way_ == 0);
            });
        if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
        if (failed_) return *std::exchange(failed_, std::nullopt);
        std::vector<Item> items;
        for (Ready& ready : ready_) {
            states_[ready.key] = State::taken;
            items.push_back(std::move(ready.item));
        }
        ready_.clear();
        ready_weight_ = 0;
        wake(lock);
        return items;
    }

  private:
    enum class State { under_way, ready, taken };
    struct Ready {
        Key key;
        Item item;
        std::size_t weight;
    };

    void drop_all_but(const std::vector<Request>& requests) {
        if (ready_.empty()) return;
        std::vector<Key> keys;
        for (const Request& one : requests) keys.push_back(one.key);
        std::ranges::sort(keys);
        std::erase_if(ready_, [&](const Ready& ready) {
            if (std::ranges::binary_search(keys, ready.key)) return false;
            states_.erase(ready.key);
            ready_weight_ -= ready.weight;
            return true;
        });
    }
    [[nodiscard]] bool can_begin() const {
        return !requests_.empty() && under_way_ + ready_weight_ < capacity_;
    }
    void work(const std::stop_token& stop) {
        std::unique_lock lock(mutex_);
        for (;;) {
            ++waiting_;
            const bool begins = can_begin_.wait(lock, stop, [&] { return can_begin(); });
            --waiting_;
            if (!begins || stop.stop_requested()) return;
            load_next(lock);
        }
    }
    // As many threads that wait as there is something to begin for, once the lock is open: a thread that is
    // woken asks for it, and so does who takes what is ready.
    void wake(std::unique_lock<std::mutex>& lock) {
        const std::size_t room =
            can_begin() ? std::min(requests_.size(), capacity_ - (under_way_ + ready_weight_)) : 0;
        const std::size_t count = std::min(room, waiting_);
        lock.unlock();
        for (std::size_t i = 0; i < count; ++i) can_begin_.notify_one();
    }
    // Loads what is requested first; there is something. The lock is open meanwhile.
    void load_next(std::unique_lock<std::mutex>& lock) {
        const Request request = std::move(requests_.front());
        requests_.pop_front();
        changed_.notify_all();
        if (states_.contains(request.key)) return;  // it was requested twice
        ++under_way_;
        bool is_ready = false;
        try {
            states_[request.key] = State::under_way;
            lock.unlock();
            Result<Item> loaded = load_(request);
            lock.lock();
            if (loaded.ok()) {
                const std::size_t weight = weight_ ? weight_(*loaded) : 1;
                ready_.push_back({request.key, std::move(loaded).value(), weight});
                ready_weight_ += weight;
                states_[request.key] = State::ready;
                is_ready = true;
            } else {
                if (!failed_) failed_ = loaded.error();
                requests_.clear();
            }
        } catch (...) {  // no memory: that is the caller's to know, and would end this thread's program
            if (!lock.owns_lock()) lock.lock();
            thrown_ = std::current_exception();
            requests_.clear();
        }
        --under_way_;
        if (!is_ready) states_.erase(request.key);
        changed_.notify_all();
    }

    Load load_;
    Weight weight_;
    int threads_to_start_;
    std::size_t capacity_;
    std::mutex mutex_;
    std::condition_variable_any can_begin_;  // for threads that load
    std::condition_variable_any changed_;    // for who waits for what is ready
    std::deque<Request> requests_;           // by priority
    std::map<Key, State> states_;
    std::vector<Ready> ready_;
    std::size_t under_way_{}, ready_weight_{};
    std::size_t waiting_{};  // threads that have nothing to load
    std::optional<Error> failed_;
    std::exception_ptr thrown_;
    std::vector<std::jthread> threads_;  // last: they end before what they use
};

}  // namespace oro
