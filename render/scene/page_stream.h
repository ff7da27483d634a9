// Pages on their way from their source to the GPU: read, decoded and built by threads in the background.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <thread>
#include <tuple>
#include <vector>

#include "core/frame/region_pages.h"
#include "render/scene/page_store.h"

namespace oro {

class PageStream {
  public:
    // `capacity`: pages that may be under way or ready at a time, at least 1; 80 KB each. `pages` outlives
    // the stream. Threads begin with the first page that is wanted. Where fewer are to be had, or none, it
    // does with those: without any, take() loads pages itself.
    // parts: pages come with these, too; means are 222 KB more, places 200 KB. packs: they come with packed
    // heights.
    PageStream(const RegionPages& pages, int threads, std::size_t capacity, const PageParts& parts = {},
               bool packs = false);
    ~PageStream();
    PageStream(const PageStream&) = delete;
    PageStream& operator=(const PageStream&) = delete;

    // What is needed now, most wanted first. What was wanted before and is not any more is dropped.
    void want(std::span<const PageIndex> pages);
    // Pages that are ready, in the order in which they became so; with `wait` at least one, unless nothing is
    // wanted or under way. Errors: a page that could not be read (told once). What a thread threw
    // (std::bad_alloc) is thrown here.
    Result<std::vector<LoadedPage>> take(bool wait);
    // Nothing is wanted, under way or ready.
    [[nodiscard]] bool idle() const;

  private:
    using Key = std::tuple<int, int, int>;
    static Key key(const PageIndex& page) { return {page.level, page.row, page.column}; }
    void work(const std::stop_token& stop);
    // Loads the page that is most wanted; there is one. Lets go of the lock meanwhile.
    void load_next(std::unique_lock<std::mutex>& lock);

    const RegionPages& pages_;
    int most_threads_;  // to be begun; 0: they are
    std::size_t capacity_;
    PageParts parts_;
    bool packs_;
    mutable std::mutex mutex_;
    std::condition_variable_any changed_;
    std::deque<PageIndex> wanted_;
    std::set<Key> under_way_;
    std::deque<LoadedPage> ready_;
    std::optional<Error> failed_;
    std::exception_ptr thrown_;
    std::vector<std::jthread> threads_;  // last: they end before what they use
};

}  // namespace oro
