// Words of several sources, each once.
#pragma once

#include <set>
#include <string>

namespace oro {

// Collects words: each once, in the order of their coming, joined by "; ". Empty ones are left out.
class DifferentWords {
  public:
    void add(const std::string& words) {
        if (!words.empty() && seen_.insert(words).second) all_ += (all_.empty() ? "" : "; ") + words;
    }
    [[nodiscard]] const std::string& all() const { return all_; }

  private:
    std::set<std::string> seen_;
    std::string all_;
};

}  // namespace oro
