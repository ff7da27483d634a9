// What a .zip or .kmz holds of vectors, and what may be unpacked of it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "geo/files/archive_entries.h"

namespace oro {

// Pointers to entries are valid as long as the archive is.
class VectorArchive {
  public:
    // Lists what is in it. Errors (a reason, without the file's name): those of archive_entries().
    static Result<VectorArchive> open(const std::string& file);

    // KML's main file: doc.kml, or the first .kml; null where there is none.
    [[nodiscard]] const ArchiveEntry* main_kml() const;
    // All .kml, in the archive's order.
    [[nodiscard]] std::vector<const ArchiveEntry*> all_kml() const;
    // The one file of vectors that is no KML: .shp, .gpkg, .fgb, .geojson, .topojson or .gpx; where none of
    // these is there, .csv or .json. Errors (a reason, without the file's name): none, or several, and how
    // many.
    [[nodiscard]] Result<const ArchiveEntry*> only_vector_file() const;
    // The file in the same folder, and of the same name but for its ending, which may be in capital letters
    // (".prj"); null where there is none.
    [[nodiscard]] const ArchiveEntry* beside(const ArchiveEntry& entry, std::string_view ending) const;
    // The .kml of this archive that a link (`href`) in the file `from` leads to: its path from that file's
    // folder on, which never leads up. Null where it leads elsewhere.
    [[nodiscard]] const ArchiveEntry* linked(const ArchiveEntry& from, const std::string& href) const;

    // All bytes of a file. Errors (a reason, without the archive's name): a name that leads out of the
    // archive; a name that several files have; a file that is damaged or locked; one with which all that was
    // unpacked would be longer than a text may be, or longer than the archive by far.
    Result<std::string> unpack(const ArchiveEntry& entry);

  private:
    VectorArchive(std::string file, std::vector<ArchiveEntry> entries)
        : file_(std::move(file)), entries_(std::move(entries)) {}
    [[nodiscard]] const ArchiveEntry* named(const std::string& name) const;

    std::string file_;
    std::vector<ArchiveEntry> entries_;
    std::uint64_t unpacked_bytes_{};
};

}  // namespace oro
