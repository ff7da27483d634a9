#include "core/frame/chosen_pages.h"

#include <algorithm>
#include <array>
#include <utility>

namespace oro {
namespace {

// A page that was wanted, as the processor knows it.
struct Wanted {
    const gpu::WantedPage* page;
    PageIndex index;
    bool shows;
};

bool is_here(const gpu::WantedPage& page) {
    return page.block != gpu::uvec2(0U);
}

// By the numbers of their pages, so that pages are found in it: the finest level first.
std::vector<Wanted> sorted(const PageNumbers& numbers, std::span<const gpu::WantedPage> wanted) {
    std::vector<Wanted> all;
    all.reserve(wanted.size());
    for (const gpu::WantedPage& page : wanted) all.push_back({&page, numbers.page(page.page), true});
    std::ranges::sort(all, {}, [](const Wanted& one) { return one.page->page; });
    return all;
}

// A page that shows needs those without which it is not opened: the one above it and those beside that.
void find_shown(const PageNumbers& numbers, const IsHidden& is_hidden, std::vector<Wanted>& wanted) {
    const auto show = [&](const PageIndex& page) {
        const PageIndex above{page.row / 2, page.column / 2, page.level + 1};
        if (!numbers.contains(page) || !numbers.contains(above)) return;
        const std::uint32_t number = numbers.of(above);
        const auto found =
            std::ranges::lower_bound(wanted, number, {}, [](const Wanted& one) { return one.page->page; });
        if (found != wanted.end() && found->page->page == number) found->shows = true;
    };
    for (Wanted& one : wanted) one.shows = false;
    for (Wanted& one : wanted) {
        const PageIndex& index = one.index;
        one.shows = one.shows || !is_hidden(index);
        if (!one.shows) continue;
        show(index);
        constexpr std::array<std::pair<int, int>, 4> steps{{{-1, 0}, {0, 1}, {1, 0}, {0, -1}}};
        for (const auto& [down, right] : steps) show({index.row + down, index.column + right, index.level});
    }
}

// What shows first, of that what others wait for, then what is near.
bool comes_before(const Wanted& a, const Wanted& b) {
    if (a.shows != b.shows) return a.shows;
    if (a.index.level != b.index.level) return a.index.level > b.index.level;
    if (a.page->distance_m != b.page->distance_m) return a.page->distance_m < b.page->distance_m;
    return a.page->page < b.page->page;
}

}  // namespace

ChosenPages chosen_pages(const PageNumbers& numbers, const gpu::ChoiceCounts& counts,
                         std::span<const gpu::WantedPage> wanted, const IsHidden& is_hidden) {
    ChosenPages chosen;
    chosen.pages_wanted = counts.wanted;
    chosen.pages_beyond_frustum = counts.beyond_frustum;
    chosen.pages_beyond_horizon = counts.beyond_horizon;
    chosen.is_whole = counts.wanted <= wanted.size();
    std::vector<Wanted> all = sorted(numbers, wanted);
    if (is_hidden) find_shown(numbers, is_hidden, all);
    chosen.page_indices.resize(counts.open);
    std::vector<Wanted> missing;
    for (const Wanted& one : all) {
        if (one.page->number < counts.open) chosen.page_indices[one.page->number] = one.index;
        if (!is_here(*one.page))
            missing.push_back(one);
        else if (!one.shows || one.page->open == 0)
            chosen.hidden.push_back(one.index);
    }
    std::ranges::sort(missing, comes_before);
    for (const Wanted& one : missing) {
        chosen.missing.push_back(one.index);
        chosen.missing_hidden += one.shows ? 0 : 1;
    }
    return chosen;
}

}  // namespace oro
