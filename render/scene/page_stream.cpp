#include "render/scene/page_stream.h"

#include <algorithm>
#include <utility>

#include "core/base/parallel.h"
#include "core/packed/packed_heights.h"

namespace oro {

PageStream::PageStream(const RegionPages& pages, int threads, std::size_t capacity, const PageParts& parts,
                       bool packs)
    : pages_(pages),
      most_threads_(std::max(1, threads)),
      capacity_(std::max<std::size_t>(1, capacity)),
      parts_(parts),
      packs_(packs) {}

PageStream::~PageStream() {
    for (std::jthread& thread : threads_) thread.request_stop();
    changed_.notify_all();
}

void PageStream::want(std::span<const PageIndex> pages) {
    if (!pages.empty() && most_threads_ > 0)
        start_threads(threads_, std::exchange(most_threads_, 0),
                      [this](const std::stop_token& stop) { work(stop); });
    const std::scoped_lock lock(mutex_);
    std::set<Key> needed;
    for (const PageIndex& page : pages) needed.insert(key(page));
    std::erase_if(ready_, [&](const LoadedPage& page) { return !needed.contains(key(page.index)); });
    std::set<Key> here = under_way_;
    for (const LoadedPage& page : ready_) here.insert(key(page.index));
    wanted_.clear();
    for (const PageIndex& page : pages) {
        if (!here.contains(key(page))) wanted_.push_back(page);
    }
    changed_.notify_all();
}

Result<std::vector<LoadedPage>> PageStream::take(bool wait) {
    std::unique_lock lock(mutex_);
    if (threads_.empty() && ready_.empty() && !wanted_.empty()) load_next(lock);
    if (wait) {
        changed_.wait(lock, [&] {
            return thrown_ || failed_ || !ready_.empty() || (wanted_.empty() && under_way_.empty());
        });
    }
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
    if (failed_) return *std::exchange(failed_, std::nullopt);
    std::vector<LoadedPage> pages(std::make_move_iterator(ready_.begin()),
                                  std::make_move_iterator(ready_.end()));
    ready_.clear();
    changed_.notify_all();
    return pages;
}

bool PageStream::idle() const {
    const std::scoped_lock lock(mutex_);
    return wanted_.empty() && under_way_.empty() && ready_.empty() && !failed_ && !thrown_;
}

void PageStream::work(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    for (;;) {
        const auto can_begin = [&] {
            return !wanted_.empty() && under_way_.size() + ready_.size() < capacity_;
        };
        if (!changed_.wait(lock, stop, can_begin)) return;
        load_next(lock);
    }
}

void PageStream::load_next(std::unique_lock<std::mutex>& lock) {
    const PageIndex page = wanted_.front();
    wanted_.pop_front();
    try {
        under_way_.insert(key(page));
        lock.unlock();
        LoadedPage loaded{page, std::make_unique<gpu::PageBlock>(), nullptr, nullptr, false};
        Result<void> done = pages_.load(page, *loaded.block);
        if (parts_.means && done.ok()) {
            loaded.means = std::make_unique<gpu::PageMeans>();
            done = pages_.load_means(page, *loaded.means);
        }
        if (parts_.places && done.ok()) {
            loaded.places = std::make_unique<gpu::PagePlaces>();
            done = pages_.load_places(page, *loaded.block, *loaded.places);
        }
        if (packs_ && done.ok())
            loaded.heights = packed_heights(loaded.block->heights, pages_.facts().shape.exaggeration);
        lock.lock();
        if (done.ok()) {
            ready_.push_back(std::move(loaded));
        } else if (!failed_) {
            failed_ = done.error();
            wanted_.clear();
        }
    } catch (...) {  // no memory: the caller's business, not this thread's
        if (!lock.owns_lock()) lock.lock();
        thrown_ = std::current_exception();
        wanted_.clear();
    }
    under_way_.erase(key(page));
    changed_.notify_all();
}

}  // namespace oro
