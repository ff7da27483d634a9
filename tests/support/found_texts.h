// Regular expressions of ECMAScript, in one file: each that includes <regex> and uses it takes 3 s longer to
// compile.
#pragma once

#include <string>
#include <vector>

namespace oro::test {

// The places of `text` where `expression` is found, one after another: of each all that was found, then what
// each bracket holds.
std::vector<std::vector<std::string>> found_texts(const std::string& text, const std::string& expression);

// Whether the whole text is what the expression says.
bool is_text(const std::string& text, const std::string& expression);

// The text with `by` in each place where the expression is found.
std::string replaced_texts(const std::string& text, const std::string& expression, const std::string& by);

}  // namespace oro::test
