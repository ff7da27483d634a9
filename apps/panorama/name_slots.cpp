#include "apps/panorama/panorama_names.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace oro {
namespace {

// Slots for places from left to right. Taken apart by their numbers they may be equal, but not fall: the
// pools of adjacent violators give the least sum of squares. Source: R. E. Barlow et al., Statistical
// Inference under Order Restrictions, 1972, section 1.2.
std::vector<double> slots_of(const std::vector<double>& places_px, const SlotRow& row) {
    struct Pool {
        double sum;
        int count;
        [[nodiscard]] double mean() const { return sum / count; }
    };
    std::vector<Pool> pools;
    for (std::size_t i = 0; i < places_px.size(); ++i) {
        pools.push_back({places_px[i] - static_cast<double>(i) * row.apart_px, 1});
        while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
            const Pool last = pools.back();
            pools.pop_back();
            pools.back().sum += last.sum;
            pools.back().count += last.count;
        }
    }
    const double high_px = row.high_px - static_cast<double>(places_px.size() - 1) * row.apart_px;
    std::vector<double> slots;
    for (const Pool& pool : pools) {
        for (int i = 0; i < pool.count; ++i)
            slots.push_back(std::max(row.low_px, std::min(pool.mean(), high_px)) +
                            static_cast<double>(slots.size()) * row.apart_px);
    }
    return slots;
}

bool all_fit(const std::vector<double>& places_px, const std::vector<double>& slots_px, const SlotRow& row) {
    if (!slots_px.empty() && slots_px.back() > row.high_px) return false;
    for (std::size_t i = 0; i < places_px.size(); ++i) {
        if (std::abs(places_px[i] - slots_px[i]) > row.farthest_px) return false;
    }
    return true;
}

}  // namespace

std::vector<std::optional<double>> name_slots(const std::vector<double>& places_px, const SlotRow& row) {
    std::vector<double> taken;        // places, from left to right
    std::vector<std::size_t> owners;  // of them
    for (std::size_t i = 0; i < places_px.size(); ++i) {
        const auto at = std::ranges::upper_bound(taken, places_px[i]) - taken.begin();
        std::vector<double> tried = taken;
        tried.insert(tried.begin() + at, places_px[i]);
        if (!all_fit(tried, slots_of(tried, row), row)) continue;
        taken = std::move(tried);
        owners.insert(owners.begin() + at, i);
    }
    std::vector<std::optional<double>> slots(places_px.size());
    if (taken.empty()) return slots;
    const std::vector<double> found = slots_of(taken, row);
    for (std::size_t i = 0; i < found.size(); ++i) slots[owners[i]] = found[i];
    return slots;
}

}  // namespace oro
