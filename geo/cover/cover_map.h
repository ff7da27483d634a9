// Land cover from files, by place.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/cover/cover_source.h"
#include "geo/cover/cover_table.h"
#include "geo/drape/cell_size.h"

namespace oro {

class SharedRaster;

// The code of a place of which no file knows anything.
inline constexpr int no_cover_code = std::numeric_limits<int>::min();

// Rasters of one product, the later ones over the earlier ones, and its table. Safe to ask from several
// threads.
class CoverMap {
  public:
    // `tables`: those that may be recognised. name: the table of all files, already read, in `named`; null:
    // it is recognised by their codes. Errors: those of table_of_codes(); a named table that has none of a
    // file's codes.
    static Result<std::shared_ptr<const CoverMap>> of(std::vector<CoverSource> sources,
                                                      const std::vector<CoverTable>& tables,
                                                      const CoverTable* named);

    ~CoverMap();
    CoverMap(const CoverMap&) = delete;
    CoverMap& operator=(const CoverMap&) = delete;

    [[nodiscard]] const CoverTable& table() const { return table_; }
    [[nodiscard]] std::span<const CoverSource> sources() const { return sources_; }
    // What a user must know of the files and of the choice of the table, one line each.
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

    // The codes at places, WGS84 degrees: of the pixel that a place lies in, nothing is interpolated;
    // no_cover_code where the files hold nothing. All three of one length. Errors: a file that has changed,
    // is damaged or takes too long.
    Result<void> codes_at(std::span<const double> lat_deg, std::span<const double> lon_deg,
                          std::span<int> codes) const;
    Result<int> code_at(double lat_deg, double lon_deg) const;

    // All codes of one file, by its number among the sources, in the cell around each place
    // (read_pixels_around()); those that stand for nothing are passed over. Errors as above; those of the
    // sink.
    using CodeSink = std::function<Result<void>(std::size_t place, int code)>;
    Result<void> read_codes_around(std::size_t file, std::span<const double> lat_deg,
                                   std::span<const double> lon_deg, const CellSize& cell,
                                   const CodeSink& sink) const;

    // "tree cover", "code 7", or "" for no_cover_code.
    [[nodiscard]] std::string name_of(int code) const;

    // What reads a file, by its number among the sources.
    [[nodiscard]] const SharedRaster& raster(std::size_t file) const { return *rasters_[file]; }
    // Whether a file's code stands for a class, of a place of which something is known.
    [[nodiscard]] bool is_cover(const CoverSource& source, int code) const {
        return code != source.no_data && !table_.is_none(code);
    }

  private:
    CoverMap(std::vector<CoverSource> sources, CoverTable table);

    std::vector<CoverSource> sources_;  // stay where they are: readers point to them
    CoverTable table_;
    std::vector<std::unique_ptr<const SharedRaster>> rasters_;
    std::vector<std::string> notes_;
};

}  // namespace oro
