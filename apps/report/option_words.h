// The words that options take, out of the tables that say what they stand for.
#pragma once

#include <string>
#include <vector>

namespace oro {

// The words of a table of pairs (word, meaning), in its order; those that no user may write are "".
template <class Table>
std::vector<std::string> words_of(const Table& table) {
    std::vector<std::string> words;
    for (const auto& [word, meaning] : table)
        if (*word != '\0') words.emplace_back(word);
    return words;
}

// "auto, mesh, compute"
inline std::string listed(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
    return all;
}

}  // namespace oro
