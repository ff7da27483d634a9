#include "geo/tilesets/property_columns.h"

#include <array>
#include <cstring>

namespace oro {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
void append_value(std::vector<std::uint8_t>& bytes, Value value) {
    std::array<std::uint8_t, sizeof(Value)> raw;
    std::memcpy(raw.data(), &value, sizeof(Value));
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

// Begins a view where 8 bytes begin, which suits any type.
class ViewBegun {
  public:
    ViewBegun(std::vector<std::uint8_t>& bytes, Json& views) : bytes_(bytes), views_(views) {
        constexpr std::size_t aligned = 8;
        while (bytes.size() % aligned != 0) bytes.push_back(0);
        at_ = bytes.size();
    }
    // Ends it; its number.
    std::size_t end() {
        Json view = Json::object();
        view["buffer"] = 0;
        view["byteOffset"] = at_;
        view["byteLength"] = bytes_.size() - at_;
        views_.push_back(std::move(view));
        return views_.size() - 1;
    }

  private:
    std::vector<std::uint8_t>& bytes_;
    Json& views_;
    std::size_t at_{};
};

}  // namespace

Json texts_column(std::span<const std::string> texts, std::vector<std::uint8_t>& bytes, Json& views) {
    ViewBegun values(bytes, views);
    // An empty view is none.
    std::vector<std::uint32_t> ends{0};
    for (const std::string& one : texts) {
        bytes.insert(bytes.end(), one.begin(), one.end());
        ends.push_back(ends.back() + static_cast<std::uint32_t>(one.size()));
    }
    if (ends.back() == 0) bytes.push_back(0);
    Json json = Json::object();
    json["values"] = values.end();
    ViewBegun offsets(bytes, views);
    for (const std::uint32_t end : ends) append_value(bytes, end);
    json["stringOffsets"] = offsets.end();
    return json;
}

Json numbers_column(std::span<const float> numbers, std::vector<std::uint8_t>& bytes, Json& views) {
    ViewBegun values(bytes, views);
    for (const float number : numbers) append_value(bytes, number);
    Json json = Json::object();
    json["values"] = values.end();
    return json;
}

}  // namespace oro
