// The places that options of a command name, as texts that may be replaced by degrees.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "apps/options/options.h"
#include "core/base/result.h"

namespace oro {

// An option's text that holds a place.
struct PlaceText {
    const char* option;  // "--at"
    std::string* text;
};

// "46.500000000000,8.000000000000", to 0.1 micrometres: an option's text that is read as these degrees.
std::string degrees_text(std::initializer_list<double> angles_deg);

// What --at and --look-at say, those of them that are given. `view` outlives them.
std::vector<PlaceText> place_texts_of(ViewOptions& view);

// The places of a --along: a list with ; between them. There are none where it names a file.
class AlongTexts {
  public:
    // Errors: a file that cannot be asked for.
    static Result<AlongTexts> of(const std::string& along);

    // Each place of the list. Not beyond the life of this.
    [[nodiscard]] std::vector<PlaceText> texts();
    // The list with what became of its places.
    [[nodiscard]] std::string joined() const;

  private:
    std::vector<std::string> words_;  // one that is no list, where has_places_ is false
    bool has_places_{};
};

}  // namespace oro
