#include <ogr_api.h>

#include <array>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "geo/files/foreign_text.h"
#include "geo/files/raster_library.h"
#include "geo/vectors/vector_readers.h"
#include "geo/vectors/vector_shapes.h"

namespace oro {
namespace {

constexpr std::size_t features_between_looks = 256;

Error dataset_fault(const std::string& what) {
    return Error{ErrorKind::failed, "", what};
}

struct FreeFeature {
    void operator()(OGRFeatureH feature) const { OGR_F_Destroy(feature); }
};
using Feature = std::unique_ptr<std::remove_pointer_t<OGRFeatureH>, FreeFeature>;

// A file that OGR has open, while it is read.
class DatasetReader {
  public:
    DatasetReader(DatasetFormat format, GDALDatasetH dataset, const VectorCrs& asked, FileWatch& watch,
                  const GdalMessages& messages, VectorFile& file, LeftOut& left_out)
        : format_(format),
          dataset_(dataset),
          asked_(asked),
          watch_(watch),
          messages_(messages),
          file_(file),
          left_out_(left_out) {}

    Result<void> all() {
        for (int i = 0; i < GDALDatasetGetLayerCount(dataset_); ++i) {
            const OGRLayerH layer = GDALDatasetGetLayer(dataset_, i);
            if (layer != nullptr) ORO_CHECK(read_layer(layer));
        }
        return {};
    }

  private:
    Result<void> read_layer(OGRLayerH handle) {
        VectorLayer layer;
        layer.name = foreign_text(OGR_L_GetName(handle));
        const OGRFeatureDefnH definition = OGR_L_GetLayerDefn(handle);
        if (OGR_FD_GetGeomFieldCount(definition) == 0) {
            left_out_.add("layers without geometries");
            return {};
        }
        auto splitter =
            splitter_as_asked(asked_, file_, [&] { return ShapeSplitter::of(OGR_L_GetSpatialRef(handle)); });
        if (!splitter.ok()) return dataset_fault("layer '" + layer.name + "': " + splitter.error().what);
        for (int i = 0; i < OGR_FD_GetFieldCount(definition); ++i)
            layer.fields.push_back(foreign_text(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, i))));
        OGR_L_ResetReading(handle);
        std::size_t count = 0;
        for (;; ++count) {
            if (count % features_between_looks == 0 && watch_.spent()) return dataset_fault(watch_.fault());
            const Feature feature(OGR_L_GetNextFeature(handle));
            if (!feature) break;
            take(feature.get(), layer, *splitter);
            if (places_ + splitter->places() > most_vector_places)
                return dataset_fault("has more than " + std::to_string(most_vector_places) +
                                     " places, which is the limit");
        }
        if (!messages_.last("").empty())
            return dataset_fault("layer '" + layer.name +
                                 "' cannot be read to its end: " + messages_.last(""));
        ORO_CHECK(check_count(handle, count));
        places_ += splitter->places();
        file_.ring_ends += splitter->ring_ends();
        if (!layer.shapes.empty()) file_.layers.push_back(std::move(layer));
        return {};
    }

    // A FlatGeobuf that is cut between two features, or within the length of one, ends without an error of
    // OGR's. Its header may count none, where it was written as a stream.
    Result<void> check_count(OGRLayerH layer, std::size_t count) const {
        if (format_ != DatasetFormat::flatgeobuf) return {};
        const GIntBig stated = OGR_L_GetFeatureCount(layer, 0);
        if (stated <= 0 || static_cast<std::size_t>(stated) == count) return {};
        return dataset_fault("is cut: it should have " + std::to_string(stated) + " features, and has " +
                             std::to_string(count));
    }

    void take(OGRFeatureH feature, VectorLayer& layer, ShapeSplitter& splitter) {
        const OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
        if (geometry == nullptr) {
            left_out_.add("features without a geometry");
            return;
        }
        const std::size_t before = layer.shapes.size();
        const HeightAbove heights =
            splitter.heights() == HeightAbove::nothing ? HeightAbove::sea_level : splitter.heights();
        splitter.split(geometry, {heights, layer.records.size(), &layer.shapes, &left_out_});
        if (layer.shapes.size() > before) layer.records.push_back(record_of(feature, layer.fields.size()));
    }

    static VectorRecord record_of(OGRFeatureH feature, std::size_t fields) {
        VectorRecord record;
        for (std::size_t i = 0; i < fields; ++i) {
            const int number = static_cast<int>(i);
            if (OGR_F_IsFieldSetAndNotNull(feature, number) == 0) continue;
            std::string text = foreign_text(OGR_F_GetFieldAsString(feature, number));
            if (!text.empty()) record.push_back({i, std::move(text)});
        }
        return record;
    }

    DatasetFormat format_;
    GDALDatasetH dataset_;
    const VectorCrs& asked_;
    FileWatch& watch_;
    const GdalMessages& messages_;
    VectorFile& file_;
    LeftOut& left_out_;
    std::size_t places_{};
};

// What GDAL's driver of a format is asked to do, ending in a null.
const char* const* open_options_of(DatasetFormat format) {
    // Nothing is written beside a database, and what it lists is all that is looked at.
    static constexpr std::array<const char*, 3> database{"IMMUTABLE=YES", "LIST_ALL_TABLES=NO", nullptr};
    // Offsets within a file are not followed until they are known to stay in it.
    static constexpr std::array<const char*, 2> flat{"VERIFY_BUFFERS=YES", nullptr};
    static constexpr std::array<const char*, 1> none{nullptr};
    if (format == DatasetFormat::geopackage) return database.data();
    return format == DatasetFormat::flatgeobuf ? flat.data() : none.data();
}

}  // namespace

Result<void> read_dataset(const std::string& name, DatasetFormat format, const VectorCrs& asked,
                          FileWatch& watch, const GdalMessages& messages, VectorFile& file,
                          LeftOut& left_out) {
    const std::array<const char*, 2> driver{dataset_driver(format), nullptr};
    const Dataset dataset(GDALOpenEx(name.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                     driver.data(), open_options_of(format), nullptr));
    if (!dataset)
        return dataset_fault("is not a vector file in an accepted format (" + trusted_vector_formats() +
                             "): " + messages.last("unknown format"));
    // OGR goes on with WGS84 where it does not know a CRS.
    if (!messages.last("").empty()) return dataset_fault("cannot be read: " + messages.last(""));
    return DatasetReader(format, dataset.get(), asked, watch, messages, file, left_out).all();
}

}  // namespace oro
