// A small region file, always the same, and what its tests share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/baked/region_file.h"
#include "core/baked/region_format.h"

namespace oro::test {
namespace fs = std::filesystem;

inline std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}
inline void put(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}
inline std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}
using Names = std::vector<std::string>;

// 300 x 290 posts: 9, 4 and 1 pages.
inline RegionOutline made_outline() {
    RegionOutline outline;
    outline.grid.lat = {1200.0, 0.0, 47 * 1200, -1, 300};
    outline.grid.lon = {1200.0, 0.0, 8 * 1200, +1, 290};
    outline.undulation.lat = {4.0, 0.0, 188, -1, 2};
    outline.undulation.lon = {4.0, 0.0, 32, +1, 3};
    outline.undulation.N_m = {48.5F, 48.25F, -0.0F, 47.0F, 46.0F, -1.5F};
    outline.shape.occluder.radii_m = {6378000.0, 6378000.0, 6356000.0};
    outline.lowest_H_m = -12.5F;
    outline.highest_H_m = 4000.0F;
    outline.voids = 77;
    outline.triangles = 2 * 299 * 289 - 5;
    outline.description = "{\"geoid\":\"EGM96\"}";
    return outline;
}
inline constexpr std::uint64_t made_pages = 14;
// Where its chunks begin.
inline constexpr std::size_t made_outline_at = ChunkTable::header_bytes + 5 * ChunkTable::entry_bytes,
                             made_description_at = made_outline_at + region_format::outline_bytes,
                             made_undulation_at = made_description_at + 17,
                             made_records_at = made_undulation_at + 24,
                             made_heights_at = made_records_at + made_pages * region_format::record_bytes;
inline constexpr std::uint64_t made_fingerprint = 0x0123456789abcdefU;

struct MadePage {
    PageRecord record;
    PagePayload payload;
    StitchedDeviations stitched;
};
// The same for the same number: whole metres, fractions, voids and nothing at all by turns.
inline std::unique_ptr<MadePage> made_page(const PageOrder& order, std::uint64_t number) {
    std::mt19937_64 random(number);
    const auto any = [&] { return static_cast<double>(random()) / 1.0e12 - 9.0e6; };
    auto page = std::make_unique<MadePage>();
    PageSummary& summary = page->record.summary;
    summary.index = order.index(number);
    summary.origin = {any(), any(), any()};
    for (int i = 0; i < 3; ++i) {
        summary.origin_ecef.m[i] = any();
        summary.centre_m[i] = any();
        summary.horizon.direction[i] = any();
        page->record.horizon.direction[i] = any();
        for (int j = 0; j < 3; ++j) summary.ecef_from_page[i][j] = any();
        for (PageQuarter& quarter : page->record.quarters) quarter.centre_m[i] = any();
    }
    for (double* number_to_fill :
         {&summary.radius_m, &summary.horizon.angle_rad, &summary.lowest_h_m, &summary.highest_h_m,
          &summary.lod_radius_m, &page->record.reach_m, &page->record.horizon.angle_rad})
        *number_to_fill = any();
    summary.triangles = static_cast<std::uint32_t>(random() % 32769);
    summary.meshlets = static_cast<std::uint32_t>(random() % 257);
    summary.largest_error_m = 1.0e30F;
    for (PageQuarter& quarter : page->record.quarters) {
        quarter.lod_radius_m = any();
        quarter.largest_error_m = static_cast<float>(any());
    }
    for (std::size_t i = 0; i < page->payload.H_m.size(); ++i) {
        const auto slope_m = static_cast<float>(i / 131 + 2 * (i % 131));
        float& H_m = page->payload.H_m[i];
        H_m = slope_m + (number % 4 == 1 ? 0.5F : 0.0F) +
              (i % 50 == 0 ? static_cast<float>(random() % 9) : 0.0F);
        if (number % 4 == 3 || (number % 4 == 2 && i % 131 > 100)) H_m = void_height_m;
    }
    for (float& error_m : page->payload.error_m) error_m = static_cast<float>(random() % 100) * 0.01F;
    for (float& radius_m : page->payload.lod_radius_m) radius_m = static_cast<float>(random() % 100);
    for (auto& node : page->stitched) {
        for (float& error_m : node) error_m = static_cast<float>(random() % 1000) * 0.5F;
    }
    return page;
}

inline bool same(const PageRecord& a, const PageRecord& b) {
    return region_format::record_to_bytes({a, 0, 0, 0}) == region_format::record_to_bytes({b, 0, 0, 0});
}

inline Result<RegionFileWriter> begin(const fs::path& path, bool overwrite = false) {
    return RegionFileWriter::create(path, made_outline(), made_fingerprint, overwrite);
}
inline Result<void> append_until(RegionFileWriter& writer, std::uint64_t end) {
    while (writer.pages_done() < end) {
        const auto page = made_page(writer.order(), writer.pages_done());
        ORO_TRY(const EncodedPage encoded, encode_page(page->record, page->payload));
        ORO_CHECK(writer.append(encoded, page->stitched));
    }
    return {};
}
inline void write_whole(const fs::path& path, bool overwrite = false) {
    auto writer = begin(path, overwrite);
    ASSERT_TRUE(writer.ok()) << writer.error().line();
    const auto appended = append_until(*writer, made_pages);
    ASSERT_TRUE(appended.ok()) << appended.error().line();
    const auto finished = writer->finish();
    ASSERT_TRUE(finished.ok()) << finished.error().line();
}
// What open() or verify() says; empty when all is well.
inline std::string refusal(const fs::path& path) {
    const auto file = RegionFile::open(path);
    if (!file.ok()) return file.error().line();
    const auto verified = file->verify();
    return verified.ok() ? "" : verified.error().line();
}
inline bool says(const std::string& line, const std::string& words) {
    return line.find(words) != std::string::npos;
}

}  // namespace oro::test
