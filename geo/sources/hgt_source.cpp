#include "geo/sources/hgt_source.h"

#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>

#include "core/earth/ellipsoid.h"
#include "core/terrain/post_grid.h"
#include "geo/files/archive_entries.h"
#include "geo/files/guarded_files.h"
#include "geo/files/letter_case.h"
#include "geo/files/raster_library.h"
#include "geo/sources/raster_parts.h"
#include "geo/sources/row_scans.h"

namespace oro {
namespace {

constexpr std::int16_t hgt_void = -32768;

struct CloseFile {
    void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};
using File = std::unique_ptr<VSILFILE, CloseFile>;

int stated_arc_seconds(std::string_view text) {
    const std::string name = lower_case(text);
    for (const char* product : {"srtmgl1", "srtm1"}) {
        if (name.find(product) != std::string::npos) return 1;
    }
    for (const char* product : {"srtmgl3", "srtm3"}) {
        if (name.find(product) != std::string::npos) return 3;
    }
    return 0;
}

// Bytes in the file once unpacked. For gzip that is what its trailer says (RFC 1952, ISIZE), modulo 2^32.
Result<std::uint64_t> unpacked_size(const SourcePath& path) {
    const Error fault{ErrorKind::failed, path.shown, "cannot be read"};
    constexpr std::string_view gzip = "/vsigzip/";
    if (path.file.starts_with(gzip)) {
        const File file(VSIFOpenL(path.file.c_str() + gzip.size(), "rb"));
        std::array<unsigned char, 4> size{};
        std::array<unsigned char, 2> magic{};
        if (!file || VSIFSeekL(file.get(), 0, SEEK_END) != 0 || VSIFTellL(file.get()) < 18)
            return Error{ErrorKind::failed, path.shown, "is no gzip file: it ends early"};
        VSIFSeekL(file.get(), 0, SEEK_SET);
        if (VSIFReadL(magic.data(), 1, 2, file.get()) != 2 || magic[0] != 0x1f || magic[1] != 0x8b)
            return Error{ErrorKind::failed, path.shown, "is no gzip file"};
        VSIFSeekL(file.get(), 0, SEEK_END);
        VSIFSeekL(file.get(), VSIFTellL(file.get()) - 4, SEEK_SET);
        if (VSIFReadL(size.data(), 1, 4, file.get()) != 4) return fault;
        return std::uint64_t{size[0]} | std::uint64_t{size[1]} << 8 | std::uint64_t{size[2]} << 16 |
               std::uint64_t{size[3]} << 24;
    }
    VSIStatBufL status;
    if (VSIStatExL(path.file.c_str(), &status,
                   VSI_STAT_EXISTS_FLAG | VSI_STAT_NATURE_FLAG | VSI_STAT_SIZE_FLAG) != 0)
        return fault;
    return static_cast<std::uint64_t>(status.st_size);
}

Error wrong_size(const SourcePath& path, std::uint64_t bytes) {
    if (bytes == 0) return Error{ErrorKind::failed, path.shown, "is empty"};
    return Error{ErrorKind::failed, path.shown,
                 "has " + std::to_string(bytes) +
                     " bytes; a .hgt tile has 2884802 (SRTM3, 1201 x 1201 posts), 25934402 (SRTM1, 3601 x "
                     "3601 posts) or 103708802 (half a second of arc, 7201 x 7201 posts): it is "
                     "truncated or of another kind"};
}

// Reads a packed tile to its end, where its checksum is compared: a changed byte often unpacks without
// complaint into wrong heights. Not a byte farther: what a .gz says of its size may be a lie.
Result<void> check_packing(VSILFILE* file, std::uint64_t bytes_left, const GdalMessages& messages,
                           const std::string& shown) {
    std::array<unsigned char, 65536> rest{};
    std::uint64_t got = 0;
    while (got <= bytes_left) {
        const std::uint64_t wanted = std::min<std::uint64_t>(rest.size(), bytes_left + 1 - got);
        const std::size_t more = VSIFReadL(rest.data(), 1, wanted, file);
        if (more == 0) break;
        got += more;
    }
    if (got > bytes_left)
        return Error{ErrorKind::failed, shown, "unpacks to more bytes than the tile that it says it holds"};
    const std::string said = messages.last("");
    if (said.empty()) return {};
    return Error{ErrorKind::failed, shown, "its packing is damaged: " + said};
}

// How rough posts are, read with their bytes in the tile's order and in the other one.
class ByteOrder {
  public:
    void add(const HgtRow& row) {
        pairs_ += row.pairs;
        steps_m_ += row.steps_m;
        swapped_m_ += row.swapped_steps_m;
    }
    // True where noise from one end of the numbers to the other becomes a surface in the other order.
    [[nodiscard]] bool seems_swapped() const {
        constexpr std::int64_t least_pairs = 1000, least_step_m = 20, smoother = 20;
        return pairs_ >= least_pairs && steps_m_ >= least_step_m * pairs_ &&
               steps_m_ >= smoother * swapped_m_;
    }

  private:
    std::int64_t pairs_{}, steps_m_{}, swapped_m_{};
};

// Counts what a row of a block's window holds. `stored`: its bytes.
void add_row(const HgtRow& row, std::span<const unsigned char> stored, PostBlock& block) {
    if (row.lowest <= row.highest) {
        block.lowest_stored_m = std::min(block.lowest_stored_m, static_cast<double>(row.lowest));
        block.highest_stored_m = std::max(block.highest_stored_m, static_cast<double>(row.highest));
    }
    block.voids += static_cast<std::uint64_t>(row.voids + row.implausible);
    for (std::size_t i = 0; row.implausible > 0 && i < stored.size(); i += 2) {
        const auto value = static_cast<std::int16_t>(stored[i] << 8 | stored[i + 1]);
        if (value != hgt_void && (value < lowest_plausible_m || value > highest_plausible_m))
            count_implausible(block, static_cast<double>(value));
    }
}

// All bytes of a tile in a .zip, where they are as plain as usual.
std::optional<std::vector<unsigned char>> whole_tile(const Source& source, std::uint64_t bytes) {
    constexpr std::string_view zip = "/vsizip/{";
    const std::size_t end = source.file.rfind("}/");
    if (!source.file.starts_with(zip) || end == std::string::npos) return std::nullopt;
    return unpacked_at_once(source.file.substr(zip.size(), end - zip.size()), source.file.substr(end + 2),
                            bytes);
}

std::string srtm_attribution(const SourcePath& path) {
    const std::string names = lower_case(path.name + " " + path.archive);
    if (names.find("srtmgl1") != std::string::npos) return "NASA SRTM v3 (SRTMGL1), public domain";
    if (names.find("srtmgl3") != std::string::npos) return "NASA SRTM v3 (SRTMGL3), public domain";
    return "";
}

}  // namespace

std::optional<HgtName> parse_hgt_name(std::string_view file_name) {
    if (file_name.size() < 11 || lower_case(file_name.substr(file_name.size() - 4)) != ".hgt")
        return std::nullopt;
    const auto tile = parse_tile_name(file_name.substr(0, 7));
    const std::string_view rest = file_name.substr(7);
    if (!tile || (rest[0] != '.' && rest[0] != '_' && rest[0] != '-')) return std::nullopt;
    return HgtName{*tile, stated_arc_seconds(rest)};
}

std::optional<int> hgt_posts_of_size(std::uint64_t bytes) {
    if (bytes == 2 * 1201 * 1201) return 1201;
    if (bytes == 2 * 3601 * 3601) return 3601;
    if (bytes == 2 * 7201 * 7201) return 7201;
    return std::nullopt;
}

Result<HgtName> name_of_hgt(const SourcePath& path) {
    auto name = parse_hgt_name(path.name);
    if (!name)
        return Error{ErrorKind::failed, path.shown,
                     "the name of a .hgt tile says where it lies, as in N46E008.hgt or N46E008.SRTMGL3.hgt; "
                     "this one does not"};
    if (name->arc_seconds == 0) name->arc_seconds = stated_arc_seconds(path.archive);
    return *name;
}

Result<Source> inspect_hgt(const SourcePath& path) {
    ORO_TRY(const HgtName name, name_of_hgt(path));
    GdalMessages messages;
    ORO_TRY(const std::uint64_t bytes, unpacked_size(path));
    const auto posts = hgt_posts_of_size(bytes);
    if (!posts) return wrong_size(path, bytes);
    const double arc_seconds = 3600.0 / (*posts - 1);
    if (name.arc_seconds != 0 && name.arc_seconds != arc_seconds)
        return Error{ErrorKind::failed, path.shown,
                     "the name says " + std::to_string(name.arc_seconds) + " arc-second posts, but its " +
                         std::to_string(bytes) + " bytes are a tile of " +
                         (arc_seconds < 1.0 ? "half" : std::to_string(*posts == 3601 ? 1 : 3)) +
                         " arc-second posts"};
    const double per_deg = *posts - 1;
    const double lat = name.tile.lat_deg;
    const double lon = name.tile.lon_deg;
    Source source;
    source.kind = SourceKind::hgt;
    source.file = path.file;
    source.named = path.named;
    source.lon = {lon, lon + 1.0};
    source.south_deg = lat;
    source.north_deg = lat + 1.0;
    source.lat_spacing_deg = source.lon_spacing_deg = 1.0 / per_deg;
    source.on_degrees = true;
    source.lat_axis = {per_deg, lat + 1.0, -1, *posts};
    source.lon_axis = {per_deg, lon, +1, *posts};
    SourceReport& report = source.report;
    report.path = path.shown;
    report.files = {local_file_of(path.file)};
    report.format = *posts == 3601   ? SourceFormat::srtm1_hgt
                    : *posts == 1201 ? SourceFormat::srtm3_hgt
                                     : SourceFormat::raster;
    if (report.format == SourceFormat::raster) report.driver = "half-second .hgt";
    report.crs = "EPSG:4326 WGS 84";
    report.vertical_datum.from = DatumFrom::hgt_format;
    report.attribution = srtm_attribution(path);
    report.rows = report.columns = *posts;
    report.lat_spacing_deg = report.lon_spacing_deg = 1.0 / per_deg;
    report.spacing_m = radians_from_deg(1.0 / per_deg).rad * meridian_radius_m(lat + 0.5);
    report.box = {lon, lat, lon + 1.0, lat + 1.0};
    return source;
}

Result<PostBlock> read_hgt(const Source& source, const PostWindow& window) {
    const auto side = static_cast<std::size_t>(source.lat_axis.count);
    const GdalMessages messages;
    const FileWatch watch(reading_limit_s + 1e-6 * static_cast<double>(side) * static_cast<double>(side));
    const bool is_whole = window.row == 0 && window.rows == source.lat_axis.count;
    const auto whole = is_whole ? whole_tile(source, 2 * side * side) : std::nullopt;
    errno = 0;
    const File file(whole ? nullptr : VSIFOpenL(source.file.c_str(), "rb"));
    if (!file && !whole) {
        const std::string reason = std::generic_category().message(errno != 0 ? errno : ENOENT);
        return Error{ErrorKind::failed, source.report.path, "cannot be opened: " + messages.last(reason)};
    }
    PostBlock block;
    block.window = window;
    const auto columns = static_cast<std::size_t>(window.columns);
    block.height_m.resize(static_cast<std::size_t>(window.rows) * columns);
    std::vector<unsigned char> row(2 * side);
    ByteOrder order;
    if (!whole) VSIFSeekL(file.get(), static_cast<vsi_l_offset>(window.row) * row.size(), SEEK_SET);
    for (int r = 0; r < window.rows; ++r) {
        const std::size_t got = whole ? row.size() : VSIFReadL(row.data(), 1, row.size(), file.get());
        const std::span stored =
            (whole ? std::span(*whole).subspan(static_cast<std::size_t>(r) * row.size(), row.size())
                   : std::span<const unsigned char>(row))
                .subspan(2 * static_cast<std::size_t>(window.column), 2 * columns);
        if (got != row.size())
            return Error{ErrorKind::failed, source.report.path,
                         !watch.fault().empty()
                             ? watch.fault()
                             : "ends in post row " + std::to_string(window.row + r) + " of " +
                                   std::to_string(side) + ": " +
                                   messages.last("the file is truncated or its packing is damaged")};
        const HgtRow found = decode_hgt_row(
            stored, std::span(block.height_m).subspan(static_cast<std::size_t>(r) * columns, columns));
        order.add(found);
        add_row(found, stored, block);
    }
    if (order.seems_swapped())
        return Error{ErrorKind::failed, source.report.path,
                     "its bytes seem to be in the other order: a .hgt tile has the high byte of each height "
                     "first, and this one is a surface only with the low byte first"};
    const std::uint64_t bytes_left = row.size() * (side - static_cast<std::size_t>(window.row + window.rows));
    if (!whole && source.file.starts_with("/vsi"))
        ORO_CHECK(check_packing(file.get(), bytes_left, messages, source.report.path));
    if (!watch.fault().empty()) return Error{ErrorKind::failed, source.report.path, watch.fault()};
    return block;
}

}  // namespace oro
