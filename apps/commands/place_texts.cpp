#include "apps/commands/place_texts.h"

#include <algorithm>
#include <cstdio>

#include "core/base/file_there.h"

namespace oro {

std::string degrees_text(std::initializer_list<double> angles_deg) {
    std::string all;
    for (const double angle_deg : angles_deg) {
        char text[40];
        std::snprintf(text, sizeof text, "%.12f", angle_deg);
        all += (all.empty() ? "" : ",") + std::string(text);
    }
    return all;
}

std::vector<PlaceText> place_texts_of(ViewOptions& view) {
    std::vector<PlaceText> all;
    if (view.at) all.push_back({"--at", &*view.at});
    if (view.look_at) all.push_back({"--look-at", &*view.look_at});
    return all;
}

Result<AlongTexts> AlongTexts::of(const std::string& along) {
    AlongTexts all;
    ORO_TRY(const bool is_file, is_there(along));
    all.has_places_ = !is_file && along.find(';') != std::string::npos;
    if (!all.has_places_) {
        all.words_.push_back(along);
        return all;
    }
    for (std::size_t begin = 0; begin <= along.size();) {
        const std::size_t end = std::min(along.find(';', begin), along.size());
        all.words_.push_back(along.substr(begin, end - begin));
        begin = end + 1;
    }
    return all;
}

std::vector<PlaceText> AlongTexts::texts() {
    std::vector<PlaceText> texts;
    if (has_places_)
        for (std::string& word : words_) texts.push_back({"--along", &word});
    return texts;
}

std::string AlongTexts::joined() const {
    std::string all;
    for (const std::string& word : words_) all += (&word == words_.data() ? "" : ";") + word;
    return all;
}

}  // namespace oro
