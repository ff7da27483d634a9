// What a reader leaves out of a file: how often, why, and where it comes first.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geo/files/foreign_text.h"
#include "geo/files/line_number.h"

namespace oro {

// Something that is left out.
struct LeftOutPart {
    static constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

    std::size_t count{1};
    std::size_t places{};     // that are lost with it
    std::size_t at{nowhere};  // byte of the file's text
    std::string word;         // what stands there, or ""
};

// Counts by reason, in the order in which reasons first came up.
class LeftOut {
  public:
    void add(const std::string& reason, const LeftOutPart& part = {}) {
        places_ += part.places;
        const auto known = std::ranges::find(reasons_, reason, &Reason::words);
        if (known == reasons_.end())
            reasons_.push_back({reason, part});
        else
            known->part.count += part.count;
    }
    [[nodiscard]] bool empty() const { return reasons_.empty(); }
    // The number of all places that are lost.
    [[nodiscard]] std::size_t places() const { return places_; }
    // "FILE: left out 3 features without a geometry, the first in line 5"; lines are counted in the text.
    [[nodiscard]] std::vector<std::string> notes(const std::string& file, std::string_view text) const {
        std::vector<std::string> lines;
        for (const Reason& reason : reasons_) lines.push_back(file + ": left out " + words_of(reason, text));
        return lines;
    }
    // All in one: "3 features without a geometry, the first in line 5; 1 layers ..."
    [[nodiscard]] std::string words(std::string_view text) const {
        std::string all;
        for (const Reason& reason : reasons_) all += (all.empty() ? "" : "; ") + words_of(reason, text);
        return all;
    }

  private:
    struct Reason {
        std::string words;
        LeftOutPart part;
    };

    static std::string words_of(const Reason& reason, std::string_view text) {
        const LeftOutPart& part = reason.part;
        std::string words =
            std::to_string(part.count) + " " + (part.count == 1 ? of_one(reason.words) : reason.words);
        if (part.at > text.size()) return words;
        words += (part.count > 1 ? ", the first in line " : ", in line ") +
                 std::to_string(line_number(text, part.at));
        return part.word.empty() ? words : words + ": '" + shown(part.word) + "'";
    }
    // "3 places of lines that are no numbers" is "1 place of a line that is no number" where there is one.
    static std::string of_one(std::string words) {
        const std::size_t first = words.find(' ');
        const std::size_t length = std::min(first, words.size());
        if (words.substr(0, length).ends_with("ies"))
            words.replace(length - 3, 3, "y");
        else if (length > 1 && words[length - 1] == 's')
            words.erase(length - 1, 1);
        for (const auto& [several, one] :
             {std::pair{" that are no finite numbers", " that is no finite number"},
              {" that are no numbers", " that is no number"},
              {" that are none", " that is none"},
              {" that count from one", " that counts from one"},
              {" whose coordinates do not fit their type", " whose coordinates do not fit its type"},
              {" that their coordinate", " that its coordinate"},
              {", which are not followed", ", which is not followed"},
              {" that stand where", " that stands where"},
              {" to other files", " to another file"},
              {"lace of lines", "lace of a line"}})
            if (const std::size_t at = words.find(several); at != std::string::npos)
                words.replace(at, std::string_view(several).size(), one);
        return words;
    }
    static std::string shown(const std::string& word) {
        constexpr std::size_t longest = 40;
        if (word.size() <= longest) return foreign_text(word);
        std::size_t end = longest;
        while (end > 0 && (static_cast<unsigned char>(word[end]) & 0xc0U) == 0x80U) --end;
        return foreign_text(word.substr(0, end)) + "...";
    }

    std::vector<Reason> reasons_;
    std::size_t places_{};
};

}  // namespace oro
