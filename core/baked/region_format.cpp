#include "core/baked/region_format.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "core/baked/net_bytes.h"
#include "core/base/checksum.h"
#include "core/base/little_endian.h"

namespace oro::region_format {
namespace {

// Writes what it is shown, or reads into it, number after number. The functions `exchange` show a struct's
// fields to either, so that each order is written down once.
class Putter {
  public:
    explicit Putter(std::byte* at) : at_(at) {}
    template <class T>
    void operator()(const T& number) {
        to_little_endian(number, at_);
        at_ += sizeof(T);
    }
    [[nodiscard]] const std::byte* at() const { return at_; }

  private:
    std::byte* at_;
};
class Getter {
  public:
    explicit Getter(const std::byte* at) : at_(at) {}
    template <class T>
    void operator()(T& number) {
        number = from_little_endian<T>(at_);
        at_ += sizeof(T);
    }

  private:
    const std::byte* at_;
};
// Remembers whether all numbers were finite.
class FiniteCheck {
  public:
    template <class T>
    void operator()(const T& number) {
        if constexpr (std::is_floating_point_v<T>) finite_ = finite_ && std::isfinite(number);
    }
    [[nodiscard]] bool finite() const { return finite_; }

  private:
    bool finite_{true};
};

// Each struct is taken apart by name: one that gets another field does not compile until this is stored, too,
// and the version raised.
template <class Visit, class Vector>
void exchange_vector(Visit& visit, Vector& vector) {
    for (int i = 0; i < 3; ++i) visit(vector[i]);
}
template <class Visit, class Cone>
void exchange_cone(Visit& visit, Cone& cone) {
    auto& [direction, angle_rad] = cone;
    exchange_vector(visit, direction);
    visit(angle_rad);
}
template <class Visit, class Axis>
void exchange_axis(Visit& visit, Axis& axis) {
    auto& [posts_per_deg, phase_deg, first, step, count] = axis;
    visit(posts_per_deg);
    visit(phase_deg);
    visit(first);
    visit(step);
    visit(count);
}
// An axis of a grid on a net, and a number of the net.
template <class Visit, class Axis, class Number>
void exchange_net_axis(Visit& visit, Axis& axis, Number& of_net) {
    visit(axis.posts_per_deg);
    visit(axis.phase_deg);
    visit(of_net);
    visit(axis.step);
    visit(axis.count);
}
template <class Visit, class Header>
void exchange_header(Visit& visit, Header& header) {
    auto& [found_version, header_size, file_bytes, fingerprint, grid, net_bytes, net_checksum, undulation_lat,
           undulation_lon, occluder_radii_m, lowest_H_m, highest_H_m, voids, triangles, description_bytes,
           undulation_nodes, pages, description_checksum, undulation_checksum] = header;
    visit(header_size);
    visit(file_bytes);
    visit(fingerprint);
    if (is_on_net(found_version)) {
        exchange_net_axis(visit, grid.lat, net_bytes);
        exchange_net_axis(visit, grid.lon, net_checksum);
    } else {
        exchange_axis(visit, grid.lat);
        exchange_axis(visit, grid.lon);
    }
    exchange_axis(visit, undulation_lat);
    exchange_axis(visit, undulation_lon);
    exchange_vector(visit, occluder_radii_m);
    visit(lowest_H_m);
    visit(highest_H_m);
    visit(voids);
    visit(triangles);
    visit(description_bytes);
    visit(undulation_nodes);
    visit(pages);
    visit(description_checksum);
    visit(undulation_checksum);
}
template <class Visit, class Summary>
void exchange_summary(Visit& visit, Summary& summary) {
    auto& [index, origin, origin_ecef, ecef_from_page, centre_m, radius_m, horizon, lowest_h_m, highest_h_m,
           triangles, meshlets, largest_error_m, lod_radius_m] = summary;
    visit(index.row);
    visit(index.column);
    visit(index.level);
    visit(origin.lat_deg);
    visit(origin.lon_deg);
    visit(origin.h_m);
    exchange_vector(visit, origin_ecef.m);
    for (int column = 0; column < 3; ++column) exchange_vector(visit, ecef_from_page[column]);
    exchange_vector(visit, centre_m);
    visit(radius_m);
    exchange_cone(visit, horizon);
    visit(lowest_h_m);
    visit(highest_h_m);
    visit(triangles);
    visit(meshlets);
    visit(largest_error_m);
    float smallest_error_m = 0.0F;  // written as 0; nothing has ever read it
    visit(smallest_error_m);
    visit(lod_radius_m);
}
template <class Visit, class Record>
void exchange_page(Visit& visit, Record& record) {
    auto& [summary, reach_m, horizon, quarters] = record;
    exchange_summary(visit, summary);
    visit(reach_m);
    exchange_cone(visit, horizon);
    for (auto& quarter : quarters) {
        auto& [centre_m, lod_radius_m, largest_error_m] = quarter;
        exchange_vector(visit, centre_m);
        visit(lod_radius_m);
        visit(largest_error_m);
    }
}
template <class Visit, class Stored>
void exchange_stored(Visit& visit, Stored& stored) {
    exchange_page(visit, stored.page);
    visit(stored.payload_offset);
    visit(stored.payload_bytes);
    visit(stored.payload_checksum);
}

template <std::size_t size>
void put_checksum(std::array<std::byte, size>& bytes) {
    to_little_endian(xxh64(std::span(bytes).first(size - 8)), &bytes[size - 8]);
}

std::string at(PageIndex index) {
    return "level " + std::to_string(index.level) + " row " + std::to_string(index.row) + " column " +
           std::to_string(index.column);
}

}  // namespace

std::string hexadecimal(std::uint64_t number) {
    char text[17];
    std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(number));
    return text;
}

RegionHeader header_of(const RegionOutline& outline, std::uint64_t fingerprint) {
    RegionHeader header;
    header.fingerprint = fingerprint;
    header.grid = outline.grid;
    header.version = version_of(outline.grid);
    if (const GridNet* const net = outline.grid.net.get()) {
        header.grid.lat = {0.0, 0.0, 0, -1, net->rows()};
        header.grid.lon = {0.0, 0.0, 0, +1, net->columns()};
        header.grid.net.reset();
        header.net_bytes = net_to_bytes(*net).size();
    }
    header.undulation_lat = outline.undulation.lat;
    header.undulation_lon = outline.undulation.lon;
    header.occluder_radii_m = outline.shape.occluder.radii_m;
    header.lowest_H_m = outline.lowest_H_m;
    header.highest_H_m = outline.highest_H_m;
    header.voids = outline.voids;
    header.triangles = outline.triangles;
    header.description_bytes = outline.description.size();
    header.undulation_nodes = outline.undulation.N_m.size();
    return header;
}

HeaderBytes header_to_bytes(const RegionHeader& header) {
    HeaderBytes bytes{};
    std::memcpy(bytes.data(), magic.data(), magic.size());
    Putter put(bytes.data() + magic.size());
    put(header.version);
    exchange_header(put, header);
    assert(put.at() == &bytes[header_bytes - 8]);
    put_checksum(bytes);
    return bytes;
}

RegionHeader header_from_bytes(const HeaderBytes& bytes) {
    RegionHeader header;
    Getter get(bytes.data() + magic.size());
    get(header.version);
    header.grid.split = split_of(header.version);
    exchange_header(get, header);
    return header;
}

RegionOffsets offsets_of(const RegionHeader& header) {
    RegionOffsets offsets{};
    offsets.undulation = header_bytes + header.description_bytes;
    offsets.net = offsets.undulation + header.undulation_nodes * sizeof(float);
    offsets.records = offsets.net + header.net_bytes;
    offsets.payloads = offsets.records + header.pages * record_bytes;
    return offsets;
}

std::vector<std::byte> beginning_of(const RegionOutline& outline, std::uint64_t fingerprint) {
    const std::vector<float>& N_m = outline.undulation.N_m;
    const std::size_t text_bytes = outline.description.size();
    std::vector<std::byte> bytes(header_bytes + text_bytes + N_m.size() * sizeof(float));
    const std::span<std::byte> text = std::span(bytes).subspan(header_bytes, text_bytes);
    const std::span<std::byte> values = std::span(bytes).subspan(header_bytes + text_bytes);
    if (text_bytes > 0) std::memcpy(text.data(), outline.description.data(), text_bytes);
    Putter put(values.data());
    for (const float value : N_m) put(value);
    RegionHeader header = header_of(outline, fingerprint);
    header.pages = PageOrder(outline.grid).count();
    header.description_checksum = xxh64(text);
    header.undulation_checksum = xxh64(values);
    if (outline.grid.net) {
        const std::vector<std::byte> net = net_to_bytes(*outline.grid.net);
        header.net_checksum = xxh64(net);
        bytes.insert(bytes.end(), net.begin(), net.end());
    }
    const HeaderBytes front = header_to_bytes(header);
    std::copy(front.begin(), front.end(), bytes.begin());
    return bytes;
}

RecordBytes record_to_bytes(const StoredRecord& record) {
    RecordBytes bytes{};
    Putter put(bytes.data());
    exchange_stored(put, record);
    assert(put.at() == &bytes[record_bytes - 8]);
    put_checksum(bytes);
    return bytes;
}

std::optional<std::string> implausible(const PageRecord& record, PageIndex expected) {
    const PageIndex found = record.summary.index;
    if (found.row != expected.row || found.column != expected.column || found.level != expected.level)
        return "the record of the page at " + at(found) + ", expected " + at(expected);
    FiniteCheck check;
    exchange_page(check, record);
    if (!check.finite()) return "the record of the page at " + at(found) + " has a number that is not finite";
    if (record.summary.triangles > gpu::meshlets_per_page * gpu::meshlet_triangles ||
        record.summary.meshlets > gpu::meshlets_per_page)
        return "the page at " + at(found) + " has " + std::to_string(record.summary.triangles) +
               " triangles in " + std::to_string(record.summary.meshlets) +
               " meshlets, expected at most 32768 in 256";
    return std::nullopt;
}

Result<StoredRecord> read_record(const OpenFile& file, const RegionOffsets& offsets, const PageOrder& order,
                                 std::uint64_t number, std::uint64_t end) {
    const std::uint64_t offset = offsets.records + number * record_bytes;
    RecordBytes bytes;
    ORO_CHECK(file.read(offset, bytes));
    const std::uint64_t computed = xxh64(std::span(bytes).first(record_bytes - 8));
    const auto stored = from_little_endian<std::uint64_t>(&bytes[record_bytes - 8]);
    if (computed != stored)
        return file.damaged(offset, "the record of the page at " + at(order.index(number)) +
                                        " has checksum " + hexadecimal(computed) + ", expected " +
                                        hexadecimal(stored));
    StoredRecord record;
    Getter get(bytes.data());
    exchange_stored(get, record);
    if (const auto what = implausible(record.page, order.index(number))) return file.damaged(offset, *what);
    if (record.payload_bytes == 0 || record.payload_bytes > largest_payload_bytes)
        return file.damaged(offset, "a payload of " + std::to_string(record.payload_bytes) +
                                        " bytes, expected 1 to " + std::to_string(largest_payload_bytes));
    if (record.payload_offset < offsets.payloads || record.payload_offset > end ||
        record.payload_bytes > end - record.payload_offset)
        return file.damaged(offset, "a payload of " + std::to_string(record.payload_bytes) +
                                        " bytes from byte " + std::to_string(record.payload_offset) +
                                        ", expected between bytes " + std::to_string(offsets.payloads) +
                                        " and " + std::to_string(end));
    return record;
}

Result<std::vector<std::byte>> read_payload(const OpenFile& file, const StoredRecord& record) {
    std::vector<std::byte> bytes(record.payload_bytes);
    ORO_CHECK(file.read(record.payload_offset, bytes));
    const std::uint64_t computed = xxh64(bytes);
    if (computed == record.payload_checksum) return bytes;
    return file.damaged(record.payload_offset, "the payload of the page at " + at(record.page.summary.index) +
                                                   " has checksum " + hexadecimal(computed) + ", expected " +
                                                   hexadecimal(record.payload_checksum));
}

Result<void> read_payload(const OpenFile& file, const StoredRecord& record, PagePayload& payload) {
    ORO_TRY(const std::vector<std::byte> bytes, read_payload(file, record));
    if (const auto what = decode_payload(bytes, payload))
        return file.damaged(record.payload_offset,
                            "the payload of the page at " + at(record.page.summary.index) + " " + *what);
    return {};
}

}  // namespace oro::region_format
