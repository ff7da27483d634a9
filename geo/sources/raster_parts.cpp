#include "geo/sources/raster_parts.h"

#include <cpl_vsi.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string_view>

#include "geo/files/guarded_files.h"
#include "geo/files/letter_case.h"
#include "geo/files/name_pattern.h"
#include "geo/files/raster_library.h"

namespace oro {
namespace {

struct CloseFile {
    void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};
using File = std::unique_ptr<VSILFILE, CloseFile>;

Error fault(const std::string& what) {
    return {ErrorKind::failed, "", what};
}

bool is_there(const std::string& file) {
    VSIStatBufL status;
    return VSIStatExL(file.c_str(), &status, VSI_STAT_EXISTS_FLAG | VSI_STAT_NATURE_FLAG) == 0 &&
           VSI_ISREG(status.st_mode);
}

std::string bytes_at(VSILFILE* file, std::uint64_t place, std::size_t length) {
    std::string bytes(length, '\0');
    if (VSIFSeekL(file, place, SEEK_SET) != 0) return "";
    bytes.resize(VSIFReadL(bytes.data(), 1, length, file));
    return bytes;
}

// At most `most` bytes; one more tells that there are more.
std::string content_of(VSILFILE* file, std::uint64_t most) {
    std::string content;
    for (;;) {
        const std::string part = bytes_at(file, content.size(), 65536);
        content += part;
        if (part.size() < 65536 || content.size() > most) return content;
    }
}

Result<Xml> xml_of(VSILFILE* file, const std::string& name) {
    const std::string text = content_of(file, most_vrt_bytes);
    if (text.size() > most_vrt_bytes)
        return fault(name + " is longer than " + std::to_string(most_vrt_bytes >> 20U) +
                     " MiB, which is the limit");
    const GdalMessages messages;
    Xml tree(text.find('\0') == std::string::npos ? CPLParseXMLString(text.c_str()) : nullptr);
    if (!tree) return fault(name + " is damaged: " + messages.last("it is no XML"));
    return tree;
}

// "-12" or 12 at a fixed place of a header; nothing for other text.
std::optional<std::uint64_t> digits_at(std::string_view text, std::size_t place, std::size_t length) {
    if (text.size() < place + length) return std::nullopt;
    std::uint64_t number = 0;
    const char* const end = text.data() + place + length;
    const auto read = std::from_chars(text.data() + place, end, number);
    return read.ec == std::errc() && read.ptr == end ? std::optional(number) : std::nullopt;
}

// A DTED cell has one length: GDAL fills what is missing of a cut one in some places (MIL-PRF-89020B, 3.11:
// UHL, DSI and ACC of 80, 648 and 2,700 bytes, then a record for each meridian).
Result<void> check_dted(VSILFILE* file, const std::string& name) {
    std::uint64_t start = 0;
    while (start <= 160 && bytes_at(file, start, 3) != "UHL") start += 80;
    const std::string header = bytes_at(file, start, 80);
    const auto columns = digits_at(header, 47, 4), rows = digits_at(header, 51, 4);
    if (!columns || !rows) return {};  // no DTED, or GDAL's to tell
    const std::uint64_t bytes = start + 3428 + *columns * (12 + 2 * *rows);
    VSIFSeekL(file, 0, SEEK_END);
    if (VSIFTellL(file) >= bytes) return {};
    return fault(name + " has " + std::to_string(VSIFTellL(file)) + " bytes; by its header it should have " +
                 std::to_string(bytes) + ": it is truncated");
}

// Text whose last number may be missing, or have lost digits, when its end was cut.
std::string cut_text_doubt(VSILFILE* file, const std::string& name) {
    VSIFSeekL(file, 0, SEEK_END);
    const std::uint64_t size = VSIFTellL(file);
    const std::string last = size > 0 ? bytes_at(file, size - 1, 1) : "";
    if (last.empty() || last == "\n" || last == "\r") return "";
    return name + " ends without a line end: its last number may be missing or have lost digits";
}

// A name in a VRT that GDAL opens as something else than a file of that name.
bool is_no_file_name(const std::string& name) {
    const std::string lower = lower_case(name.substr(0, std::min<std::size_t>(name.size(), 16)));
    return name.find('<') != std::string::npos || lower.starts_with("vrt://") ||
           lower.starts_with("gtiff_dir:") || lower.starts_with("gtiff_raw:") ||
           lower.starts_with("jpeg2000:") || lower.starts_with("mem:") || lower.find("://") < 8;
}

// Why a VRT of such tiles is no source; "" for none.
std::string words_of_tiles(const std::set<std::string>& tiles) {
    if (tiles.empty()) return "";
    constexpr std::size_t most_named = 8;
    std::string names;
    std::size_t count = 0;
    for (const std::string& tile : tiles) {
        if (++count > most_named) break;
        names += (names.empty() ? "" : ", ") + tile.substr(tile.rfind('/') + 1);
    }
    if (tiles.size() > most_named) names += " and " + std::to_string(tiles.size() - most_named) + " more";
    return "is a VRT of .hgt files, which are read without it: name the tiles themselves (" + names + ")";
}

// "ncols" of an Esri ASCII grid's header, and its value.
struct GridHeader {
    std::uint64_t columns{}, rows{};
    bool is_open{true};  // its end has not come yet
    std::string key;     // whose value is next

    // True when the word belongs to the header.
    bool takes(const std::string& word) {
        if (!is_open) return false;
        if (key.empty()) {
            is_open = matches_name("ncols|nrows|xll*|yll*|cellsize|dx|dy|nodata*", lower_case(word));
            key = is_open ? lower_case(word) : "";
            return is_open;
        }
        if (key == "ncols") columns = digits_at(word, 0, word.size()).value_or(0);
        if (key == "nrows") rows = digits_at(word, 0, word.size()).value_or(0);
        key.clear();
        return true;
    }
};

// GDAL reads as many numbers of an Esri ASCII grid as its header says, and looks at nothing behind them.
std::string more_numbers_doubt(VSILFILE* file, const std::string& name, FileWatch* watch) {
    constexpr std::size_t block = 1U << 20U;
    GridHeader header;
    std::uint64_t numbers = 0;
    bool in_word = false;
    std::string word;
    for (std::uint64_t at = 0;; at += block) {
        const std::string bytes = bytes_at(file, at, block);
        const bool is_end = bytes.size() < block;
        for (const char c : bytes + (is_end ? " " : "")) {
            const bool is_space = c == ' ' || c == '\n' || c == '\r' || c == '\t';
            if (header.is_open && !is_space) word += c;
            if (in_word && is_space) {
                if (!header.takes(word)) ++numbers;
                word.clear();
            }
            in_word = !is_space;
        }
        if (is_end) break;
        if (watch != nullptr && watch->spent()) return "";
    }
    const std::uint64_t expected = header.columns * header.rows;
    if (expected == 0 || header.columns > 1U << 30U || header.rows > 1U << 30U || numbers <= expected)
        return "";
    return name + " holds " + std::to_string(numbers) + " numbers, and its header speaks of " +
           std::to_string(header.rows) + " rows of " + std::to_string(header.columns) + ": the last " +
           std::to_string(numbers - expected) + " are not read";
}

// What a file stands for: sources, those of its sources included, and VRTs one in another.
struct Extent {
    std::uint64_t sources{1};
    int depth{0};
};

class Walk {
  public:
    // `depth`: VRTs on the way to it.
    Result<Extent> visit(const std::string& file, int depth) {
        const auto known = extents_.find(file);
        if (depth + (known != extents_.end() ? known->second.depth : 0) > deepest_vrt)
            return fault("is a VRT of VRTs more than " + std::to_string(deepest_vrt) +
                         " deep, which is the limit, or one that names itself: at " + file);
        if (known != extents_.end()) return known->second;
        const File stream(VSIFOpenL(file.c_str(), "rb"));
        Extent extent;
        if (stream) {
            files_.insert(local_file_of(file));
            // GDAL looks for a VRT's mark in the first 1,024 bytes.
            const std::string head = bytes_at(stream.get(), 0, 4096);
            const bool vrt = head.find("<VRTDataset") != std::string::npos;
            if (depth > 0 && lower_case(file).ends_with(".hgt")) {
                tiles_.insert(file);
            } else if (vrt) {
                ORO_TRY(extent, visit_vrt(stream.get(), file, depth));
            } else {
                ORO_CHECK(probe(stream.get(), file, head));
            }
            ORO_CHECK(probe_sidecars(file));
        }
        extents_[file] = extent;
        return extent;
    }

    [[nodiscard]] std::uint64_t distinct() const { return extents_.size(); }
    RasterParts take() {
        return {{files_.begin(), files_.end()}, std::move(doubts_), words_of_tiles(tiles_)};
    }

  private:
    Result<Extent> visit_vrt(VSILFILE* stream, const std::string& file, int depth) {
        ORO_TRY(const Xml tree, xml_of(stream, file));
        std::vector<std::string> named;
        ORO_CHECK(sources_in(tree.get(), file, named));
        Extent all{1, 1};
        for (const std::string& name : named) {
            ORO_TRY(const Extent source, visit(name, depth + 1));
            all.sources += source.sources;
            all.depth = std::max(all.depth, source.depth + 1);
            if (all.sources > most_vrt_sources)
                return fault("is a VRT of more than " + std::to_string(most_vrt_sources) +
                             " sources, which is the limit");
        }
        return all;
    }

    // Without recursion: the text decides how deep its elements are nested.
    static Result<void> sources_in(const CPLXMLNode* root, const std::string& vrt,
                                   std::vector<std::string>& named) {
        std::vector<const CPLXMLNode*> open{root};
        while (!open.empty()) {
            const CPLXMLNode* const node = open.back();
            open.pop_back();
            if (node->psNext != nullptr) open.push_back(node->psNext);
            if (node->psChild != nullptr) open.push_back(node->psChild);
            if (node->eType != CXT_Element) continue;
            const std::string element = lower_case(node->pszValue);
            if (element == "vrtrasterband" &&
                lower_case(CPLGetXMLValue(node, "subClass", "")) == "vrtrawrasterband")
                return fault(vrt +
                             " is a VRT of raw bytes (VRTRawRasterBand), whose reading does not tell "
                             "when they end early: convert it to a GeoTIFF");
            if (element != "sourcefilename" && element != "sourcedataset") continue;
            const std::string name = CPLGetXMLValue(node, "", "");
            if (is_no_file_name(name))
                return fault(vrt + " names " + name + ", which is no file on this machine: it is not opened");
            const bool relative = std::string(CPLGetXMLValue(node, "relativeToVRT", "0")) != "0";
            named.push_back(relative ? file_relative_to(vrt, name) : name);
        }
        return {};
    }

    Result<void> probe(VSILFILE* stream, const std::string& file, const std::string& head) {
        if (FileWatch* const watch = FileWatch::innermost(); watch != nullptr && watch->spent())
            return fault(watch->fault());
        if (head.starts_with("EHFA_HEADER_TAG") &&
            is_there(std::filesystem::path(file).replace_extension(".ige")))
            return fault(file +
                         " keeps its heights in an .ige, whose reading does not tell when it is cut: "
                         "convert it to a GeoTIFF");
        if (head.starts_with("UHL") || head.starts_with("VOL") || head.starts_with("HDR"))
            return check_dted(stream, file);
        const std::string start = lower_case(head.substr(0, 9));
        if (start.starts_with("ncols") || start.starts_with("nrows") || start.starts_with("xllc") ||
            start.starts_with("yllc") || start.starts_with("cellsize"))
            doubt(cut_text_doubt(stream, file)),
                doubt(more_numbers_doubt(stream, file, FileWatch::innermost()));
        return {};
    }

    // GDAL takes a side-car that it cannot read for one that is not there.
    Result<void> probe_sidecars(const std::string& file) {
        if (const std::string aux = file + ".aux.xml"; is_there(aux)) {
            const File stream(VSIFOpenL(aux.c_str(), "rb"));
            if (!stream) return fault("its " + aux + " cannot be opened");
            ORO_TRY(const Xml tree, xml_of(stream.get(), aux));
            files_.insert(local_file_of(aux));
        }
        if (const std::string mask = file + ".msk"; is_there(mask)) {
            const GdalMessages messages;
            const Dataset opened(
                GDALOpenEx(mask.c_str(), GDAL_OF_RASTER, trusted_drivers(), nullptr, nullptr));
            if (!opened) return fault("its mask " + mask + " is damaged: " + messages.last("no raster"));
            files_.insert(local_file_of(mask));
        }
        for (const char* ending : {"w", "fw", "2w"}) probe_world_file(file, ending);
        return {};
    }

    // a.tif's is a.tfw or a.tifw, a.jp2's a.j2w.
    void probe_world_file(const std::string& file, const std::string& ending) {
        const std::size_t dot = file.rfind('.');
        if (dot == std::string::npos || dot + 2 > file.size()) return;
        const std::string name = ending == "w" ? file + ending : file.substr(0, dot + 2) + ending;
        if (!is_there(name)) return;
        const File stream(VSIFOpenL(name.c_str(), "rb"));
        if (stream) doubt(cut_text_doubt(stream.get(), name));
    }

    void doubt(std::string what) {
        if (!what.empty()) doubts_.push_back(std::move(what));
    }

    std::map<std::string, Extent> extents_;
    std::set<std::string> files_;
    std::set<std::string> tiles_;  // .hgt files that VRTs name
    std::vector<std::string> doubts_;
};

}  // namespace

Result<RasterParts> parts_of_raster(const std::string& file) {
    Walk walk;
    ORO_TRY(const Extent extent, walk.visit(file, 0));
    if (extent.sources > 1000 && extent.sources > most_times_named * walk.distinct())
        return fault("is a VRT that stands for " + std::to_string(extent.sources) + " sources and has " +
                     std::to_string(walk.distinct()) + " files: each may be named " +
                     std::to_string(most_times_named) + " times, which is the limit");
    return walk.take();
}

std::string file_relative_to(const std::string& vrt, const std::string& name) {
    const std::size_t slash = vrt.rfind('/');
    return slash == std::string::npos ? name : vrt.substr(0, slash + 1) + name;
}

std::string local_file_of(const std::string& file) {
    std::string name = file;
    while (name.starts_with("/vsi")) {
        const std::size_t slash = name.find('/', 1);
        if (slash == std::string::npos) return file;
        const bool part = name.starts_with("/vsisubfile");
        name.erase(0, slash + 1);
        if (const std::size_t comma = name.find(','); part && comma != std::string::npos)
            name.erase(0, comma + 1);
        if (name.starts_with('{') && name.rfind('}') != std::string::npos)
            name = name.substr(1, name.rfind('}') - 1);
    }
    // In an archive that is named without braces: the file on the way to it.
    std::error_code fault;
    std::filesystem::path place = name;
    while (place.has_relative_path() && !std::filesystem::exists(place, fault)) place = place.parent_path();
    return std::filesystem::is_regular_file(place, fault) ? place.string() : name;
}

}  // namespace oro
