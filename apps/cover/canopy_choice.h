// What --canopy and --canopy-held say.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/canopy/canopy_map.h"

namespace oro {

// What the canopy comes from: files of heights in metres, later ones over earlier ones, or the classes of
// land cover. Neither: there is none.
struct CanopyChoice {
    std::vector<std::string> files;
    bool by_class{};
    std::optional<double> held;  // share that the data hold already; nothing: as their sources are known
    [[nodiscard]] bool asked() const { return by_class || !files.empty(); }
    bool operator==(const CanopyChoice&) const = default;
};

// From the words of a command line: files, or "class" alone. has_cover: whether land cover is given. Errors
// (usage): files and class together; class without land cover; a share without a canopy, or that is none.
Result<CanopyChoice> canopy_choice_from(const std::vector<std::string>& words,
                                        const std::optional<double>& held, bool has_cover);
// And back: the words that give it.
std::vector<std::string> words_of(const CanopyChoice& choice);

}  // namespace oro
