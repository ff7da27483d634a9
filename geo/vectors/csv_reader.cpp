#include <ogr_api.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "geo/files/foreign_text.h"
#include "geo/files/letter_case.h"
#include "geo/files/raster_library.h"
#include "geo/vectors/coordinate_columns.h"
#include "geo/vectors/csv_records.h"
#include "geo/vectors/layer_builder.h"
#include "geo/vectors/text_path.h"
#include "geo/vectors/vector_readers.h"

namespace oro {
namespace {

constexpr std::size_t csv_looks_apart = 256;
constexpr std::size_t most_csv_crs = 64;
constexpr const char* csv_no_wkt = "geometries that are no well-known text";

Error csv_fault(const std::string& what) {
    return Error{ErrorKind::failed, "", what};
}

struct DestroyGeometry {
    void operator()(OGRGeometryH geometry) const { OGR_G_DestroyGeometry(geometry); }
};
using WrittenGeometry = std::unique_ptr<std::remove_pointer_t<OGRGeometryH>, DestroyGeometry>;

class CsvReader {
  public:
    CsvReader(CsvRecords records, std::string name, std::string crs, const VectorCrs& asked, FileWatch& watch,
              VectorFile& file, LeftOut& left_out)
        : records_(std::move(records)),
          columns_(coordinate_columns(records_.headings())),
          name_(std::move(name)),
          crs_(std::move(crs)),
          asked_(asked),
          watch_(watch),
          file_(file),
          left_out_(left_out) {}

    Result<void> all() {
        std::vector<CsvField> fields;
        for (std::size_t count = 0;; ++count) {
            if (count % csv_looks_apart == 0 && watch_.spent()) return csv_fault(watch_.fault());
            ORO_TRY(const bool more, records_.next(fields));
            if (!more) break;
            ORO_CHECK(record(fields));
            if (places() > most_vector_places)
                return csv_fault("has more than " + std::to_string(most_vector_places) +
                                 " places, which is the limit");
        }
        for (const std::string& crs : order_) layers_.at(crs)->finish(file_);
        note();
        return {};
    }

  private:
    using Kind = CoordinateColumns::Kind;

    [[nodiscard]] std::size_t places() const {
        std::size_t all = 0;
        for (const auto& [crs, layer] : layers_) all += layer->splitter().places();
        return all;
    }

    Result<void> record(const std::vector<CsvField>& fields) {
        std::string crs = text_in(fields, columns_.crs), wkt;
        if (columns_.kind == Kind::wkt) {
            wkt = text_in(fields, columns_.x);
            if (wkt.empty()) {
                left_out_.add("lines without a geometry", {1, 0, records_.at(), ""});
                return {};
            }
            take_srid(wkt, crs);
        }
        ORO_TRY(LayerBuilder* const layer, layer_in(crs));
        const HeightAbove stated = layer->splitter().heights();
        const ShapeTarget to =
            layer->target(stated == HeightAbove::nothing ? HeightAbove::sea_level : stated, left_out_);
        if (columns_.kind == Kind::wkt)
            geometry(wkt, layer->splitter(), to);
        else
            point(fields, layer->splitter(), to);
        const std::vector<std::string>& headings = records_.headings();
        for (std::size_t i = 0; i < headings.size(); ++i)
            if (!columns_.has(i)) layer->say(headings[i], fields[i].text);
        layer->end_record();
        return {};
    }

    static std::string text_in(const std::vector<CsvField>& fields, std::optional<std::size_t> column) {
        return column && *column < fields.size() ? fields[*column].text : "";
    }

    // EWKT, as PostGIS writes it: SRID=2056;POINT(...).
    static void take_srid(std::string& wkt, std::string& crs) {
        constexpr std::string_view word = "srid=";
        if (!lower_case(wkt.substr(0, word.size())).starts_with(word)) return;
        const std::size_t end = wkt.find(';');
        if (end == std::string::npos) return;
        crs = wkt.substr(word.size(), end - word.size());
        wkt.erase(0, end + 1);
    }

    // The layer of a CRS that a line names, or "".
    Result<LayerBuilder*> layer_in(std::string crs) {
        if (!crs.empty() && crs.find_first_not_of("0123456789") == std::string::npos) crs = "EPSG:" + crs;
        if (const auto known = layers_.find(crs); known != layers_.end()) return known->second.get();
        if (layers_.size() == most_csv_crs)
            return csv_fault("names more than " + std::to_string(most_csv_crs) +
                             " coordinate reference systems, which is the limit");
        ORO_TRY(ShapeSplitter splitter, splitter_as_asked(asked_, file_, [&] { return splitter_for(crs); }));
        const std::string name = crs.empty() ? name_ : name_ + " (" + crs + ")";
        auto layer = std::make_unique<LayerBuilder>(name, std::move(splitter));
        order_.push_back(crs);
        return layers_.emplace(crs, std::move(layer)).first->second.get();
    }

    Result<ShapeSplitter> splitter_for(const std::string& stated) {
        const std::string& crs = stated.empty() ? crs_ : stated;
        const bool is_degrees = columns_.kind == Kind::degrees;
        if (crs.empty() && columns_.kind == Kind::plane)
            return csv_fault("its columns " + foreign_text(records_.headings()[*columns_.x]) + " and " +
                             foreign_text(records_.headings()[*columns_.y]) +
                             " state no coordinate reference system, so where they lie is unknown: give it "
                             "a column crs (EPSG:2056), or a .prj beside it under the same name, or call "
                             "them lon and lat where they are degrees");
        if (crs.empty()) {
            has_assumed_wgs84_ = !is_degrees;
            return ShapeSplitter::of_wgs84();
        }
        takes_prj_ = takes_prj_ || stated.empty();
        return is_degrees && !is_geographic(crs) ? ShapeSplitter::of_wgs84() : splitter_of_words(crs);
    }

    // Whether a CRS counts in degrees; one that is not known does, so that it is an error where it is used.
    static bool is_geographic(const std::string& crs) {
        const GdalMessages unsaid;
        OGRSpatialReference reference;
        const std::array<const char*, 3> limits{"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr};
        return reference.SetFromUserInput(crs.c_str(), limits.data()) != OGRERR_NONE ||
               reference.IsGeographic() != 0;
    }

    void point(const std::vector<CsvField>& fields, ShapeSplitter& splitter, const ShapeTarget& to) {
        TextPath path;
        const std::string x = number_in(fields, columns_.x), y = number_in(fields, columns_.y),
                          height = number_in(fields, columns_.height);
        path.add(x, y, height, records_.at());
        splitter.add_point(path, to);
        ++points_;
        if (may_be_decimal_commas(fields)) ++doubtful_points_;
    }

    // Whether whole numbers stand in the columns of a place and in the one behind them, between commas:
    // 45,80,10,1 may be 45.80 and 10.1.
    [[nodiscard]] bool may_be_decimal_commas(const std::vector<CsvField>& fields) const {
        if (records_.mark() != ',' || columns_.kind != Kind::degrees) return false;
        const std::size_t behind = std::max(*columns_.x, *columns_.y) + 1;
        const auto is_whole = [&](std::size_t column) {
            return column < fields.size() && !fields[column].is_quoted && !fields[column].text.empty() &&
                   fields[column].text.find_first_not_of("0123456789-+") == std::string::npos;
        };
        return is_whole(*columns_.x) && is_whole(*columns_.y) && is_whole(behind);
    }

    // A number as text_path.h takes one. A comma for decimals is none where commas part the fields, or where
    // it may part thousands: metres with three digits after it and three before it at most.
    std::string number_in(const std::vector<CsvField>& fields, std::optional<std::size_t> column) {
        if (!column || *column >= fields.size()) return "";
        const CsvField& field = fields[*column];
        const std::size_t comma = field.text.find(',');
        if (comma == std::string::npos || field.text.find_first_of(",.", comma + 1) != std::string::npos ||
            field.text.find('.') < comma || (records_.mark() == ',' && !field.is_quoted))
            return field.text;
        const std::size_t first = field.text.starts_with('-') || field.text.starts_with('+') ? 1 : 0;
        const bool is_degree = columns_.kind == Kind::degrees && column != columns_.height;
        if (!is_degree && field.text.size() - comma - 1 == 3 && comma - first <= 3) return field.text;
        std::string text = field.text;
        text[comma] = '.';
        if (written_number(text).fault != nullptr) return field.text;
        if (decimal_commas_++ == 0) first_decimal_comma_ = field.text;
        return text;
    }

    void geometry(const std::string& wkt, ShapeSplitter& splitter, const ShapeTarget& to) {
        const GdalMessages unsaid;
        OGRGeometryH made = nullptr;
        std::string text = wkt;
        char* end = text.data();
        const bool is_read = OGR_G_CreateFromWkt(&end, nullptr, &made) == OGRERR_NONE;
        const WrittenGeometry written(made);
        const bool is_whole =
            is_read && std::string_view(end).find_first_not_of(" \t\r\n;") == std::string_view::npos;
        if (is_whole && written)
            splitter.split(written.get(), to);
        else
            left_out_.add(csv_no_wkt, {1, 1, records_.at(), wkt});
    }

    void note() {
        if (points_ > 0 && doubtful_points_ == points_)
            file_.notes.push_back(file_.file +
                                  ": all its degrees are whole numbers between commas; if commas stand for "
                                  "decimals, part its fields by semicolons");
        if (decimal_commas_ > 0)
            file_.notes.push_back(
                file_.file + ": has commas for decimals: '" + foreign_text(first_decimal_comma_) +
                "' is read as " +
                std::string(first_decimal_comma_).replace(first_decimal_comma_.find(','), 1, "."));
        if (takes_prj_)
            file_.notes.push_back(
                file_.file +
                ": its coordinates are in the coordinate reference system of the .prj beside it");
        if (has_assumed_wgs84_)
            file_.notes.push_back(file_.file +
                                  ": its geometries state no coordinate reference system and are taken for "
                                  "longitudes and latitudes of WGS84");
    }

    CsvRecords records_;
    CoordinateColumns columns_;
    std::string name_, crs_;
    const VectorCrs& asked_;
    FileWatch& watch_;
    VectorFile& file_;
    LeftOut& left_out_;
    std::map<std::string, std::unique_ptr<LayerBuilder>> layers_;
    std::vector<std::string> order_;  // of the layers, as they came up
    std::size_t points_{}, doubtful_points_{};
    std::size_t decimal_commas_{};
    std::string first_decimal_comma_;
    bool has_assumed_wgs84_{}, takes_prj_{};
};

}  // namespace

bool is_csv(std::string_view text) {
    const Result<CsvRecords> records = CsvRecords::of(text);
    return records.ok() && coordinate_columns(records->headings()).kind != CoordinateColumns::Kind::none;
}

Result<void> read_csv(std::string_view text, const std::string& name, const std::string& crs,
                      const VectorCrs& asked, FileWatch& watch, VectorFile& file, LeftOut& left_out) {
    ORO_TRY(CsvRecords records, CsvRecords::of(text));
    return CsvReader(std::move(records), name, crs, asked, watch, file, left_out).all();
}

}  // namespace oro
