#include "geo/cover/cover_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "geo/drape/pixel_values.h"
#include "geo/drape/raster_opening.h"
#include "geo/drape/shared_raster.h"

namespace oro {
namespace {

std::string file_name_of(const std::string& path) {
    return std::filesystem::path(path).filename().string();
}

// As the library makes whole numbers of others; 0 of what is none.
int code_of_value(double value) {
    constexpr double low = std::numeric_limits<int>::min(), high = std::numeric_limits<int>::max();
    return std::isnan(value) ? 0 : static_cast<int>(std::lround(std::clamp(value, low, high)));
}

// Why several files have no table together: each may have one that is another's.
Error without_table(const std::vector<CoverSource>& sources, const std::vector<CoverTable>& tables,
                    const Error& together) {
    std::optional<std::size_t> first_number;
    std::string first_file, all_files;
    for (const CoverSource& source : sources) {
        all_files += (all_files.empty() ? "" : ", ") + source.file;
        const Result<std::size_t> number = table_of_codes(tables, source.codes);
        if (!number.ok()) continue;
        if (!first_number) first_number = *number, first_file = source.file;
        if (*first_number == *number) continue;
        return {ErrorKind::failed, source.file,
                "its codes are those of " + tables[*number].name + ", and those of " +
                    file_name_of(first_file) + " are of " + tables[*first_number].name +
                    ": files that are given together need one table"};
    }
    return with_file(all_files, together);
}

Result<CoverTable> chosen_table(const std::vector<CoverSource>& sources,
                                const std::vector<CoverTable>& tables, const CoverTable* named) {
    if (named) {
        for (const CoverSource& source : sources) {
            std::set<int> unknown;
            bool any = false;
            for (const int code : source.codes) {
                any = any || named->class_of(code) != nullptr;
                if (!named->is_none(code)) unknown.insert(code);
            }
            if (!any && !unknown.empty())
                return Error{ErrorKind::failed, source.file,
                             "holds none of the codes of " + named->name + ", but " + codes_words(unknown)};
        }
        return *named;
    }
    std::set<int> codes;
    for (const CoverSource& source : sources) codes.insert(source.codes.begin(), source.codes.end());
    const Result<std::size_t> number = table_of_codes(tables, codes);
    if (!number.ok()) return without_table(sources, tables, number.error());
    return tables[*number];
}

}  // namespace

CoverMap::CoverMap(std::vector<CoverSource> sources, CoverTable table)
    : sources_(std::move(sources)), table_(std::move(table)) {
    for (const CoverSource& source : sources_) {
        rasters_.push_back(std::make_unique<const SharedRaster>(source));
        notes_.insert(notes_.end(), source.notes.begin(), source.notes.end());
        std::set<int> unknown;
        for (const int code : source.codes)
            if (is_cover(source, code) && table_.class_of(code) == nullptr) unknown.insert(code);
        if (!unknown.empty())
            notes_.push_back(source.file + ": " + table_.name + " has no class for its codes " +
                             codes_words(unknown) + ": such places count as unknown");
    }
}

CoverMap::~CoverMap() = default;

Result<std::shared_ptr<const CoverMap>> CoverMap::of(std::vector<CoverSource> sources,
                                                     const std::vector<CoverTable>& tables,
                                                     const CoverTable* named) {
    assert(!sources.empty());
    ORO_TRY(CoverTable table, chosen_table(sources, tables, named));
    std::shared_ptr<CoverMap> map(new CoverMap(std::move(sources), std::move(table)));
    if (!named)
        map->notes_.push_back(file_name_of(map->sources_.front().file) +
                              ": its codes are taken for those of " + map->table_.title + " (" +
                              map->table_.name + ")");
    return std::shared_ptr<const CoverMap>(std::move(map));
}

Result<void> CoverMap::read_codes_around(std::size_t file, std::span<const double> lat_deg,
                                         std::span<const double> lon_deg, const CellSize& cell,
                                         const CodeSink& sink) const {
    const CoverSource& source = sources_[file];
    return read_pixels_around(source, *rasters_[file], lat_deg, lon_deg, cell,
                              [&](const PixelValue& pixel) -> Result<void> {
                                  const int code = code_of_value(pixel.value);
                                  if (!is_cover(source, code)) return {};
                                  return sink(pixel.place, code);
                              });
}

Result<void> CoverMap::codes_at(std::span<const double> lat_deg, std::span<const double> lon_deg,
                                std::span<int> codes) const {
    assert(lat_deg.size() == lon_deg.size() && lat_deg.size() == codes.size());
    std::ranges::fill(codes, no_cover_code);
    for (std::size_t file = 0; file < sources_.size(); ++file)
        ORO_CHECK(read_codes_around(file, lat_deg, lon_deg, CellSize{},
                                    [&](std::size_t place, int code) -> Result<void> {
                                        codes[place] = code;
                                        return {};
                                    }));
    return {};
}

Result<int> CoverMap::code_at(double lat_deg, double lon_deg) const {
    int code = no_cover_code;
    ORO_CHECK(codes_at(std::span(&lat_deg, 1), std::span(&lon_deg, 1), std::span(&code, 1)));
    return code;
}

std::string CoverMap::name_of(int code) const {
    if (code == no_cover_code) return "";
    const CoverClass* const known = table_.class_of(code);
    return known ? known->name : "code " + std::to_string(code);
}

}  // namespace oro
