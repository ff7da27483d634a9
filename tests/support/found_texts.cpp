#include "tests/support/found_texts.h"

#include <regex>

namespace oro::test {

std::vector<std::vector<std::string>> found_texts(const std::string& text, const std::string& expression) {
    std::vector<std::vector<std::string>> all;
    const std::regex wanted(expression);
    for (std::sregex_iterator at(text.begin(), text.end(), wanted), end; at != end; ++at) {
        std::vector<std::string>& parts = all.emplace_back();
        for (const std::ssub_match& part : *at) parts.push_back(part.str());
    }
    return all;
}

bool is_text(const std::string& text, const std::string& expression) {
    return std::regex_match(text, std::regex(expression));
}

std::string replaced_texts(const std::string& text, const std::string& expression, const std::string& by) {
    return std::regex_replace(text, std::regex(expression), by);
}

}  // namespace oro::test
