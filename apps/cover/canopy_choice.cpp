#include "apps/cover/canopy_choice.h"

#include <algorithm>

#include "apps/command_line/refusals.h"
#include "apps/report/figures.h"

namespace oro {
namespace {

constexpr const char* class_word = "class";

}  // namespace

Result<CanopyChoice> canopy_choice_from(const std::vector<std::string>& words,
                                        const std::optional<double>& held, bool has_cover) {
    CanopyChoice choice;
    choice.held = held;
    if (held && words.empty()) return refused("--canopy-held", all_digits(*held), "needs --canopy");
    if (held && !(*held >= 0.0 && *held <= 1.0))
        return refused("--canopy-held", all_digits(*held), between_words(0.0, 1.0));
    choice.by_class = std::ranges::find(words, class_word) != words.end();
    if (!choice.by_class) {
        choice.files = words;
        return choice;
    }
    if (words.size() > 1)
        return refused(
            "--canopy", class_word,
            "heights are those of classes or of files, not of both (a file of that name: ./class)");
    if (!has_cover)
        return refused("--canopy", class_word,
                       "needs the classes: give --landcover FILE, or a FILE of heights");
    return choice;
}

std::vector<std::string> words_of(const CanopyChoice& choice) {
    return choice.by_class ? std::vector<std::string>{class_word} : choice.files;
}

}  // namespace oro
