#include "apps/options/option_table.h"

#include <cstdio>

#include "apps/command_line/refusals.h"

namespace oro {

std::string span(const Limits& limits) {
    char text[80];
    std::snprintf(text, sizeof text, "%.15g to %.15g", limits.low, limits.high);
    return text;
}

std::string sentence_of(const char* help, const OptionText& text) {
    std::string sentence = help;
    if (const std::size_t at = sentence.find("{}"); at != std::string::npos)
        sentence.replace(at, 2, span(text.limits));
    if (*text.usual != '\0') sentence += std::string(" Default: ") + text.usual + ".";
    return sentence;
}

std::string alternatives(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : "|") + word;
    return all;
}

Result<double> within(const std::string& option, double value, const Limits& limits) {
    if (limits.hold(value)) return value;
    char text[40];
    std::snprintf(text, sizeof text, "%.15g", value);
    return refused(option, text, between_words(limits.low, limits.high));
}

}  // namespace oro
