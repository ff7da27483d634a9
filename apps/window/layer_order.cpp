#include "apps/window/layer_order.h"

#include <algorithm>
#include <utility>

namespace oro {

std::vector<std::string> layers_from_the_top(const std::vector<std::string>& known,
                                             const std::vector<std::string>& on) {
    std::vector<std::string> all(on.rbegin(), on.rend());
    for (const std::string& file : known)
        if (std::ranges::find(on, file) == on.end()) all.push_back(file);
    return all;
}

bool move_layer(std::vector<std::string>& on, const std::string& file, bool up) {
    const auto found = std::ranges::find(on, file);
    if (found == on.end()) return false;
    const auto other = up ? std::next(found) : (found == on.begin() ? on.end() : std::prev(found));
    if (other == on.end()) return false;
    std::iter_swap(found, other);
    return true;
}

}  // namespace oro
