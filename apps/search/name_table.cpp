#include "apps/search/name_table.h"

#include <string.h>

#include <algorithm>
#include <utility>

#include "apps/search/folded_text.h"

namespace oro {
namespace {

// Eight bytes from a place on, the first on top; zeros from the end of the name on.
std::uint64_t first_bytes_of(std::string_view text) {
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < 8; ++i)
        bytes = bytes << 8U | (i < text.size() ? static_cast<unsigned char>(text[i]) : 0U);
    return bytes;
}

// The smallest numbers that it was given, each once.
class SmallestNumbers {
  public:
    explicit SmallestNumbers(std::size_t limit) : limit_(limit) {}

    void add(std::uint32_t number) {
        if (all_.size() == limit_ && (limit_ == 0 || number >= all_.back())) return;
        const auto place = std::ranges::lower_bound(all_, number);
        if (place != all_.end() && *place == number) return;
        all_.insert(place, number);
        if (all_.size() > limit_) all_.pop_back();
    }
    [[nodiscard]] const std::vector<std::uint32_t>& all() const { return all_; }

  private:
    std::size_t limit_;
    std::vector<std::uint32_t> all_;
};

void put_important_first(std::vector<SearchPlace>& places) {
    struct Ranked {
        double importance;
        SearchPlace place;
    };
    std::vector<Ranked> all;
    all.reserve(places.size());
    for (SearchPlace& place : places) {
        const double importance = importance_of(place);
        all.push_back({importance, std::move(place)});
    }
    std::ranges::sort(all, [](const Ranked& one, const Ranked& other) {
        if (one.importance != other.importance) return one.importance > other.importance;
        if (one.place.name != other.place.name) return one.place.name < other.place.name;
        return std::pair(one.place.lat_deg, one.place.lon_deg) <
               std::pair(other.place.lat_deg, other.place.lon_deg);
    });
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = std::move(all[i].place);
}

bool has_number(const std::vector<NameTable::Found>& found, std::uint32_t number) {
    return std::ranges::find(found, number, &NameTable::Found::number) != found.end();
}

}  // namespace

NameTable::NameTable(std::vector<SearchPlace> places) : places_(std::move(places)) {
    put_important_first(places_);
    for (std::uint32_t number = 0; number < places_.size(); ++number) {
        const std::string name = folded(places_[number].name);
        const auto begin = static_cast<std::uint32_t>(names_.size());
        begins_.push_back(begin);
        names_ += name;
        names_ += '\n';
        for (std::size_t at = 0; at < name.size(); ++at)
            if (at == 0 || name[at - 1] == ' ')
                words_.push_back({first_bytes_of(std::string_view(name).substr(at)),
                                  begin + static_cast<std::uint32_t>(at), number});
    }
    begins_.push_back(static_cast<std::uint32_t>(names_.size()));
    std::ranges::sort(words_, [this](const Word& one, const Word& other) {
        if (one.first_bytes != other.first_bytes) return one.first_bytes < other.first_bytes;
        const int order = rest_of_name(one).compare(rest_of_name(other));
        return order != 0 ? order < 0 : one.at < other.at;
    });
}

std::string_view NameTable::rest_of_name(const Word& word) const {
    return std::string_view(names_).substr(word.at, begins_[word.number + 1] - 1 - word.at);
}

std::vector<NameTable::Found> NameTable::find(std::string_view text, std::size_t limit) const {
    std::vector<Found> found;
    if (text.empty() || limit == 0 || places_.empty()) return found;
    const auto beginning = [&](const Word& word) { return rest_of_name(word).substr(0, text.size()); };
    const auto words = std::ranges::equal_range(words_, text, {}, beginning);
    SmallestNumbers whole(limit), first(limit), later(limit);
    for (const Word& word : words) {
        const bool is_first = word.at == begins_[word.number];
        if (is_first && rest_of_name(word).size() == text.size())
            whole.add(word.number);
        else
            (is_first ? first : later).add(word.number);
    }
    for (const auto& [match, numbers] : {std::pair{NameMatch::whole, &whole},
                                         {NameMatch::beginning, &first},
                                         {NameMatch::beginning_of_word, &later}}) {
        for (const std::uint32_t number : numbers->all())
            if (found.size() < limit && !has_number(found, number)) found.push_back({match, number});
    }
    if (found.size() < limit) add_within(text, limit, found);
    return found;
}

// Names lie in the order of importance: the first hits are the best.
void NameTable::add_within(std::string_view text, std::size_t limit, std::vector<Found>& found) const {
    std::uint32_t number = 0;
    for (std::size_t at = 0; found.size() < limit && at < names_.size();) {
        const void* const hit = memmem(names_.data() + at, names_.size() - at, text.data(), text.size());
        if (hit == nullptr) return;
        const auto where = static_cast<std::uint32_t>(static_cast<const char*>(hit) - names_.data());
        const auto after = std::upper_bound(begins_.begin() + number, begins_.end(), where);
        number = static_cast<std::uint32_t>(after - begins_.begin() - 1);
        if (!has_number(found, number)) found.push_back({NameMatch::within, number});
        at = begins_[number + 1];
    }
}

}  // namespace oro
