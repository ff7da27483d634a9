#include "geo/cover/cover_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <utility>

#include "geo/drape/raster_opening.h"
#include "geo/drape/shared_raster.h"
#include "geo/files/guarded_files.h"

namespace oro {
namespace {

std::string file_name_of(const std::string& path) {
    return std::filesystem::path(path).filename().string();
}

// The pixel that a place lies in; false beyond the raster.
bool pixel_at(const CoverSource& source, const PixelPlace& place, int& column, int& row) {
    if (!place.there()) return false;
    const double x = std::floor(place.column), y = std::floor(place.row);
    if (!(x >= 0.0 && y >= 0.0 && x < source.columns && y < source.rows)) return false;
    column = static_cast<int>(x);
    row = static_cast<int>(y);
    return true;
}

// Reads single pixels of one file. The library keeps the blocks that they are in.
Result<void> read_codes(const CoverSource& source, GDALDatasetH dataset, std::span<const PixelPlace> places,
                        const CoverMap& map, std::span<int> codes) {
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    const GdalMessages messages;
    FileWatch watch(reading_limit_s);
    for (std::size_t i = 0; i < places.size(); ++i) {
        int column = 0, row = 0, code = 0;
        if (!pixel_at(source, places[i], column, row)) continue;
        const bool is_read = band != nullptr && GDALRasterIO(band, GF_Read, column, row, 1, 1, &code, 1, 1,
                                                             GDT_Int32, 0, 0) == CE_None;
        if (!is_read || !watch.fault().empty())
            return Error{ErrorKind::failed, source.file,
                         !watch.fault().empty() ? watch.fault()
                                                : "cannot be read near row " + std::to_string(row) + ": " +
                                                      messages.last("the file is damaged")};
        if (map.is_cover(source, code)) codes[i] = code;
    }
    return {};
}

// The middle of a raster's longitudes, where it has some: places are looked for in the turn around it.
double middle_lon_deg(const CoverSource& source) {
    const auto& m = source.crs_from_pixel;
    return m[0] + 0.5 * (m[1] * source.columns + m[2] * source.rows);
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
    if (!number.ok()) return with_file(sources.front().file, number.error());
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

Result<void> CoverMap::add_codes_of(std::size_t file, std::span<const double> lat_deg,
                                    std::span<const double> lon_deg, std::span<int> codes) const {
    const CoverSource& source = sources_[file];
    ORO_TRY(OpenRaster open, rasters_[file]->take());
    std::vector<double> x(lon_deg.begin(), lon_deg.end()), y(lat_deg.begin(), lat_deg.end());
    std::vector<PixelPlace> places;
    open.placing.place(x, y, source.geographic ? middle_lon_deg(source) : 0.0, places);
    ORO_CHECK(read_codes(source, open.dataset.get(), places, *this, codes));
    rasters_[file]->give_back(std::move(open));
    return {};
}

Result<void> CoverMap::codes_at(std::span<const double> lat_deg, std::span<const double> lon_deg,
                                std::span<int> codes) const {
    assert(lat_deg.size() == lon_deg.size() && lat_deg.size() == codes.size());
    std::ranges::fill(codes, no_cover_code);
    for (std::size_t file = 0; file < sources_.size(); ++file)
        ORO_CHECK(add_codes_of(file, lat_deg, lon_deg, codes));
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
