#include "core/baked/region_format.h"

#include <cassert>
#include <cmath>

#include "core/baked/net_bytes.h"
#include "core/base/checksum.h"
#include "core/base/little_endian.h"

namespace oro::region_format {
namespace {

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

// Each struct is taken apart by name: one that gets another field does not compile until this is stored, too.
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
template <class Visit, class Numbers>
void exchange_numbers(Visit& visit, Numbers& numbers) {
    auto& [fingerprint, lat, lon, undulation_lat, undulation_lon, occluder_radii_m, lowest_H_m, highest_H_m,
           voids, triangles] = numbers;
    visit(fingerprint);
    for (auto* const axis : {&lat, &lon, &undulation_lat, &undulation_lon}) exchange_axis(visit, *axis);
    exchange_vector(visit, occluder_radii_m);
    visit(lowest_H_m);
    visit(highest_H_m);
    visit(voids);
    visit(triangles);
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

std::string at(PageIndex index) {
    return "level " + std::to_string(index.level) + " row " + std::to_string(index.row) + " column " +
           std::to_string(index.column);
}

}  // namespace

OutlineNumbers numbers_of(const RegionOutline& outline, std::uint64_t fingerprint) {
    OutlineNumbers numbers{fingerprint,
                           outline.grid.lat,
                           outline.grid.lon,
                           outline.undulation.lat,
                           outline.undulation.lon,
                           outline.shape.occluder.radii_m,
                           outline.lowest_H_m,
                           outline.highest_H_m,
                           outline.voids,
                           outline.triangles};
    if (outline.grid.net) {
        numbers.lat = {0.0, 0.0, 0, -1, outline.grid.rows()};
        numbers.lon = {0.0, 0.0, 0, +1, outline.grid.columns()};
    }
    return numbers;
}

std::vector<std::byte> numbers_to_bytes(const OutlineNumbers& numbers) {
    NumberWriter put;
    exchange_numbers(put, numbers);
    assert(put.bytes.size() == outline_bytes);
    return std::move(put.bytes);
}

OutlineNumbers numbers_from_bytes(std::span<const std::byte> bytes) {
    OutlineNumbers numbers;
    NumberReader get(bytes);
    exchange_numbers(get, numbers);
    return numbers;
}

RegionBeginning beginning_of(const RegionOutline& outline, std::uint64_t fingerprint) {
    RegionBeginning begin;
    const auto add = [&](ChunkType type, std::span<const std::byte> bytes) {
        begin.table.chunks.push_back({type, 0, 0, bytes.size(), xxh64(bytes)});
        begin.chunks.insert(begin.chunks.end(), bytes.begin(), bytes.end());
    };
    add(ChunkType::outline, numbers_to_bytes(numbers_of(outline, fingerprint)));
    add(ChunkType::description, std::as_bytes(std::span(outline.description)));
    NumberWriter nodes;
    for (const float N_m : outline.undulation.N_m) nodes(N_m);
    add(ChunkType::undulation, nodes.bytes);
    if (outline.grid.net) add(ChunkType::net, net_to_bytes(*outline.grid.net));
    begin.table.chunks.push_back({ChunkType::pages, 0, 0, PageOrder(outline.grid).count() * record_bytes, 0});
    begin.table.chunks.push_back({ChunkType::heights, 0, 0, 0, 0});
    begin.table.place();
    return begin;
}

std::vector<std::byte> record_to_bytes(const StoredRecord& record) {
    NumberWriter put;
    exchange_stored(put, record);
    put(xxh64(put.bytes));
    assert(put.bytes.size() == record_bytes);
    return std::move(put.bytes);
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
                                 std::uint64_t number) {
    const std::uint64_t offset = offsets.records + number * record_bytes;
    std::array<std::byte, record_bytes> bytes;
    ORO_CHECK(file.read(offset, bytes));
    if (const auto wrong = wrong_checksum(bytes, 0))
        return file.damaged(offset, "the record of the page at " + at(order.index(number)) + " " + *wrong);
    StoredRecord record;
    NumberReader get(bytes);
    exchange_stored(get, record);
    if (const auto what = implausible(record.page, order.index(number))) return file.damaged(offset, *what);
    const std::string payload = "a payload of " + std::to_string(record.payload_bytes) + " bytes";
    if (record.payload_bytes == 0 || record.payload_bytes > largest_payload_bytes)
        return file.damaged(offset, payload + ", expected 1 to " + std::to_string(largest_payload_bytes));
    const std::uint64_t room = offsets.end - offsets.payloads;
    if (record.payload_offset > room || record.payload_bytes > room - record.payload_offset)
        return file.damaged(offset, payload + " from byte " + std::to_string(record.payload_offset) +
                                        " of the heights, which have " + std::to_string(room));
    return record;
}

Result<std::vector<std::byte>> read_payload(const OpenFile& file, const RegionOffsets& offsets,
                                            const StoredRecord& record) {
    std::vector<std::byte> bytes(record.payload_bytes);
    const std::uint64_t offset = offsets.payloads + record.payload_offset;
    ORO_CHECK(file.read(offset, bytes));
    const std::uint64_t computed = xxh64(bytes);
    if (computed == record.payload_checksum) return bytes;
    return file.damaged(offset, "the payload of the page at " + at(record.page.summary.index) + " " +
                                    other_checksum(computed, record.payload_checksum));
}

Result<void> decode_payload(const OpenFile& file, const RegionOffsets& offsets, const StoredRecord& record,
                            std::span<const std::byte> bytes, PagePayload& payload) {
    const auto what = oro::decode_payload(bytes, payload);
    if (!what) return {};
    return file.damaged(offsets.payloads + record.payload_offset,
                        "the payload of the page at " + at(record.page.summary.index) + " " + *what);
}

}  // namespace oro::region_format
