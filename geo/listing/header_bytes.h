// A source as bytes and back: the one list of its fields that the cache of headers keeps.
#pragma once

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "geo/sources/raster_source.h"

namespace oro {

class ByteWriter {
  public:
    template <class T>
    void operator()(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void operator()(const std::string& text) {
        (*this)(static_cast<std::uint64_t>(text.size()));
        bytes += text;
    }
    void operator()(const std::vector<std::string>& texts) {
        (*this)(static_cast<std::uint64_t>(texts.size()));
        for (const std::string& text : texts) (*this)(text);
    }
    std::string bytes;
};

// `good` becomes false where bytes end too early; what is read is then empty.
class ByteReader {
  public:
    explicit ByteReader(std::string_view bytes) : rest(bytes) {}
    template <class T>
    void operator()(T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        if (!take(sizeof value)) return;
        std::memcpy(&value, taken.data(), sizeof value);
    }
    void operator()(std::string& text) {
        std::uint64_t size = 0;
        (*this)(size);
        if (take(size)) text = taken;
    }
    void operator()(std::vector<std::string>& texts) {
        std::uint64_t count = 0;
        (*this)(count);
        for (; good && count > 0; --count) (*this)(texts.emplace_back());
    }
    std::string_view rest;
    bool good{true};

  private:
    bool take(std::uint64_t count) {
        good = good && count <= rest.size();
        if (!good) return false;
        taken = rest.substr(0, count);
        rest.remove_prefix(count);
        return true;
    }
    std::string_view taken;
};

// What is known of a source by its header alone; not the horizontal datum, which is PROJ's answer of the day.
template <class Bytes, class Source>
void header_fields(Bytes& bytes, Source& s) {
    bytes(s.kind), bytes(s.file), bytes(s.named), bytes(s.crs_specified), bytes(s.bytes);
    bytes(s.lon), bytes(s.south_deg), bytes(s.north_deg), bytes(s.projected), bytes(s.full_circle);
    bytes(s.lat_spacing_deg), bytes(s.lon_spacing_deg), bytes(s.on_degrees);
    bytes(s.lat_axis), bytes(s.lon_axis), bytes(s.crs_wkt), bytes(s.crs_from_post);
    bytes(s.scale_m), bytes(s.offset_m), bytes(s.vertical_crs), bytes(s.band), bytes(s.signed_bytes);
    auto& r = s.report;
    bytes(r.path), bytes(r.format), bytes(r.driver), bytes(r.crs), bytes(r.horizontal_datum.coordinate_epoch);
    bytes(r.vertical_datum.from), bytes(r.vertical_datum.name), bytes(r.vertical_datum.egm96_stands_in);
    bytes(r.height_unit.name), bytes(r.height_unit.from), bytes(r.posts_are), bytes(r.attribution);
    bytes(r.rows), bytes(r.columns), bytes(r.lat_spacing_deg), bytes(r.lon_spacing_deg), bytes(r.spacing_m);
    bytes(r.box), bytes(r.files);
}

}  // namespace oro
