// Text as a search compares it: without what people leave out when they type a name.
#pragma once

#include <string>
#include <string_view>

namespace oro {

// The letters and figures of a text, in UTF-8: letters small and without their accents (É, e and é are alike,
// so are ü and u, ß and ss, ø and o, Ё and е), whatever else stands between them (spaces, hyphens,
// apostrophes, commas) as one space, none at the ends. Of Latin, Greek and Cyrillic; letters of other scripts
// stay what they are. Bytes that are no UTF-8 count as a space. "L'Aiguille-Verte " is "l aiguille verte".
// Source: Unicode Character Database 15.0, decompositions of U+00C0 to U+017F, U+01CD to U+0233 and U+1E00 to
// U+1EFF; letters without one (ø, đ, ð, ł, ħ, ı, ŋ, ŧ) by what they look like.
std::string folded(std::string_view text);

}  // namespace oro
