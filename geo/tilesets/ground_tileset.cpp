#include "geo/tilesets/ground_tileset.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <span>
#include <system_error>

#include "core/base/parallel.h"
#include "geo/files/plain_file.h"
#include "geo/tilesets/tile_bounds.h"

namespace oro {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// What is kept of a page when its file is written.
struct WrittenPage {
    bool has_content{};
    std::uint64_t triangles{}, bytes{};
    std::optional<TileBox> box;  // of all that is below it, too
};

// One that holds both. Longitudes stay in the first one's whole turn.
TileBox joined(const TileBox& a, const TileBox& b) {
    constexpr double turn_deg = 360.0;
    const double shift_deg =
        turn_deg * std::round(0.5 * (a.west_deg + a.east_deg - b.west_deg - b.east_deg) / turn_deg);
    TileBox box{std::min(a.west_deg, b.west_deg + shift_deg), std::min(a.south_deg, b.south_deg),
                std::max(a.east_deg, b.east_deg + shift_deg), std::max(a.north_deg, b.north_deg),
                std::min(a.lowest_h_m, b.lowest_h_m),         std::max(a.highest_h_m, b.highest_h_m)};
    if (box.east_deg - box.west_deg >= turn_deg) box.west_deg = -180.0, box.east_deg = 180.0;
    return box;
}

// How far from one corner of a box to the other it is, at most.
double size_m(const TileBox& box) {
    const double tall = radians_from_deg(box.north_deg - box.south_deg).rad;
    const double wide = radians_from_deg(box.east_deg - box.west_deg).rad;
    return std::hypot((wgs84_a_m + std::max(0.0, box.highest_h_m)) * std::min(2.0, std::hypot(tall, wide)),
                      box.highest_h_m - box.lowest_h_m);
}

std::string tile_name(const PageIndex& page) {
    return std::to_string(page.level) + "/" + std::to_string(page.row) + "/" + std::to_string(page.column) +
           ".glb";
}

// Writes the pages, the finest first, and then the file that tells of them.
class TilesetWriter {
  public:
    TilesetWriter(const std::string& folder, const RegionPages& pages, const TileBounds& bounds,
                  const TilesetRequest& request)
        : folder_(folder), pages_(pages), bounds_(bounds), request_(request) {}

    Result<void> write_pages(const TilesetProgress& progress);
    Result<TilesetWritten> write_json();

  private:
    Result<void> make_folders(int level) const;
    Result<WrittenPage> write_page(const PageIndex& page) const;
    void join_boxes(int level);
    [[nodiscard]] const WrittenPage& at(const PageIndex& page) const {
        return written_[static_cast<std::size_t>(page.level)]
                       [pages_.layout(page.level).number(page.row, page.column)];
    }
    [[nodiscard]] std::vector<PageIndex> below(const PageIndex& page) const;
    [[nodiscard]] double error_m(const PageIndex& page) const {
        return at(page).has_content ? bounds_.error_m(page) : tileset_error_m_;
    }
    [[nodiscard]] Json tile_json(const PageIndex& page) const;
    [[nodiscard]] Json metadata_json() const;
    [[nodiscard]] TilesetLevel summed_up(int level) const;

    const std::string& folder_;
    const RegionPages& pages_;
    const TileBounds& bounds_;
    const TilesetRequest& request_;
    std::vector<std::vector<WrittenPage>> written_;  // by level
    double tileset_error_m_{};
};

std::vector<PageIndex> TilesetWriter::below(const PageIndex& page) const {
    std::vector<PageIndex> pages;
    if (page.level == 0) return pages;
    const PageLayout layout = pages_.layout(page.level - 1);
    for (int i = 0; i < 4; ++i) {
        const PageIndex one{2 * page.row + i / 2, 2 * page.column + i % 2, page.level - 1};
        if (one.row < layout.rows && one.column < layout.columns && at(one).box) pages.push_back(one);
    }
    return pages;
}

Result<void> TilesetWriter::make_folders(int level) const {
    std::error_code failed;
    for (int row = 0; row < pages_.layout(level).rows; ++row) {
        const std::string path = folder_ + "/" + std::to_string(level) + "/" + std::to_string(row);
        if (fs::create_directories(path, failed); failed)
            return Error{ErrorKind::failed, path, "cannot be made: " + failed.message()};
    }
    return {};
}

Result<WrittenPage> TilesetWriter::write_page(const PageIndex& page) const {
    WrittenPage written;
    if (!bounds_.drawn(page) || std::isinf(bounds_.error_m(page))) return written;
    ORO_TRY(const GroundMesh mesh, ground_mesh(pages_, page, bounds_));
    if (mesh.ground_triangles == 0) return written;
    const std::vector<std::uint8_t> glb = glb_bytes(mesh, request_.look);
    ORO_CHECK(write_plain_file(folder_ + "/" + tile_name(page), glb));
    return WrittenPage{true, mesh.ground_triangles, glb.size(), mesh.box};
}

void TilesetWriter::join_boxes(int level) {
    const PageLayout layout = pages_.layout(level);
    for (int row = 0; row < layout.rows; ++row) {
        for (int column = 0; column < layout.columns; ++column) {
            std::optional<TileBox>& box = written_.back()[layout.number(row, column)].box;
            for (const PageIndex& one : below({row, column, level}))
                box = box ? joined(*box, *at(one).box) : *at(one).box;
        }
    }
}

Result<void> TilesetWriter::write_pages(const TilesetProgress& progress) {
    const auto all = static_cast<double>(tileset_pages(pages_));
    double done = 0.0;
    for (int level = 0; level < pages_.levels(); ++level) {
        ORO_CHECK(make_folders(level));
        const PageLayout layout = pages_.layout(level);
        std::vector<WrittenPage>& written = written_.emplace_back(layout.count());
        std::mutex mutex;
        Result<void> fault;
        // In parts, so that progress is told between them.
        const std::size_t at_once = std::size_t{16} * static_cast<std::size_t>(request_.threads);
        for (std::size_t first = 0; first < written.size() && fault.ok(); first += at_once) {
            const std::size_t count = std::min(at_once, written.size() - first);
            in_parallel(static_cast<int>(count), request_.threads, [&](int i) {
                const std::size_t number = first + static_cast<std::size_t>(i);
                const auto columns = static_cast<std::size_t>(layout.columns);
                const Result<WrittenPage> one = write_page(
                    {static_cast<int>(number / columns), static_cast<int>(number % columns), level});
                if (one.ok()) {
                    written[number] = one.value();
                    return;
                }
                const std::scoped_lock lock(mutex);
                if (fault.ok()) fault = one.error();
            });
            done += static_cast<double>(count);
            if (progress) progress(done / all);
        }
        ORO_CHECK(fault);
        join_boxes(level);
        std::error_code ignored;
        // Those without a tile; of folders that hold something rmdir does nothing.
        for (int row = 0; row < layout.rows; ++row)
            fs::remove(folder_ + "/" + std::to_string(level) + "/" + std::to_string(row), ignored);
        fs::remove(folder_ + "/" + std::to_string(level), ignored);
    }
    return {};
}

Json region_json_of(const TileBox& box) {
    const auto lon_rad = [](double lon_deg) { return radians_from_deg(std::remainder(lon_deg, 360.0)).rad; };
    const bool round = box.east_deg - box.west_deg >= 360.0;
    constexpr double half_turn = std::numbers::pi;
    Json list = Json::array();
    for (const double value : {round ? -half_turn : lon_rad(box.west_deg),
                               radians_from_deg(box.south_deg).rad, round ? half_turn : lon_rad(box.east_deg),
                               radians_from_deg(box.north_deg).rad, box.lowest_h_m, box.highest_h_m})
        list.push_back(value);
    return list;
}

Json TilesetWriter::tile_json(const PageIndex& page) const {
    Json tile = Json::object();
    tile["boundingVolume"]["region"] = region_json_of(*at(page).box);
    tile["geometricError"] = error_m(page);
    if (page.level == pages_.levels() - 1) tile["refine"] = "REPLACE";
    if (at(page).has_content) tile["content"]["uri"] = tile_name(page);
    Json children = Json::array();
    for (const PageIndex& one : below(page)) children.push_back(tile_json(one));
    if (!children.empty()) tile["children"] = std::move(children);
    return tile;
}

// Each of them a string of one class. Source: OGC 22-025r4, 3D Metadata Specification.
Json TilesetWriter::metadata_json() const {
    Json properties = Json::object(), values = Json::object();
    for (const auto& [name, text] : request_.metadata) {
        properties[name]["type"] = "STRING";
        values[name] = text;
    }
    Json json = Json::object();
    json["schema"]["id"] = "orograph_ground";
    json["schema"]["classes"]["ground"]["properties"] = std::move(properties);
    json["metadata"]["class"] = "ground";
    json["metadata"]["properties"] = std::move(values);
    return json;
}

TilesetLevel TilesetWriter::summed_up(int level) const {
    TilesetLevel sum;
    sum.level = level;
    const PageLayout layout = pages_.layout(level);
    for (int row = 0; row < layout.rows; ++row) {
        for (int column = 0; column < layout.columns; ++column) {
            const PageIndex page{row, column, level};
            const WrittenPage& one = at(page);
            sum.without_content += one.box && !one.has_content ? 1 : 0;
            if (!one.has_content) continue;
            ++sum.tiles;
            sum.triangles += one.triangles;
            sum.bytes += one.bytes;
            sum.largest_error_m = std::max(sum.largest_error_m, bounds_.error_m(page));
        }
    }
    return sum;
}

Result<TilesetWritten> TilesetWriter::write_json() {
    const PageIndex root{0, 0, pages_.levels() - 1};
    if (!at(root).box) return Error{ErrorKind::no_data, "region", "no triangle has a height at each corner"};
    TilesetWritten written;
    for (int level = root.level; level >= 0; --level) written.levels.push_back(summed_up(level));
    written.box = *at(root).box;
    tileset_error_m_ = size_m(written.box);
    for (const TilesetLevel& level : written.levels)
        tileset_error_m_ = std::max(tileset_error_m_, level.largest_error_m);
    written.geometric_error_m = tileset_error_m_;
    written.root_error_m = error_m(root);
    Json json = Json::object();
    json["asset"]["version"] = "1.1";
    json["asset"]["generator"] = request_.look.generator;
    if (!request_.metadata.empty()) json.update(metadata_json());
    json["geometricError"] = tileset_error_m_;
    json["root"] = tile_json(root);
    const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    ORO_CHECK(write_plain_file(folder_ + "/tileset.json",
                               {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}));
    return written;
}

}  // namespace

std::uint64_t tileset_pages(const RegionPages& pages) {
    std::uint64_t count = 0;
    for (int level = 0; level < pages.levels(); ++level) count += pages.layout(level).count();
    return count;
}

Result<TilesetWritten> write_tileset(const std::string& folder, const RegionPages& pages,
                                     const TilesetRequest& request, const TilesetProgress& progress) {
    ORO_TRY(const TileBounds bounds, TileBounds::of(pages));
    TilesetWriter writer(folder, pages, bounds, request);
    ORO_CHECK(writer.write_pages(progress));
    return writer.write_json();
}

}  // namespace oro
