// What a reader leaves out of a file: how often, and why.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace oro {

// Counts by reason, in the order in which reasons first came up.
class LeftOut {
  public:
    void add(const std::string& reason, std::size_t count = 1) {
        const auto known = std::ranges::find(counts_, reason, &std::pair<std::string, std::size_t>::first);
        if (known != counts_.end())
            known->second += count;
        else
            counts_.emplace_back(reason, count);
    }
    [[nodiscard]] bool empty() const { return counts_.empty(); }
    // "FILE: left out 3 features without a geometry"
    [[nodiscard]] std::vector<std::string> notes(const std::string& file) const {
        std::vector<std::string> lines;
        for (const auto& [reason, count] : counts_)
            lines.push_back(file + ": left out " + std::to_string(count) + " " + reason);
        return lines;
    }
    // All in one: "3 features without a geometry, 1 layer ..."
    [[nodiscard]] std::string words() const {
        std::string all;
        for (const auto& [reason, count] : counts_)
            all += (all.empty() ? "" : ", ") + std::to_string(count) + " " + reason;
        return all;
    }

  private:
    std::vector<std::pair<std::string, std::size_t>> counts_;
};

}  // namespace oro
