#include "geo/sources/unwritten_parts.h"

#include <cpl_conv.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "geo/files/letter_case.h"
#include "geo/sources/raster_parts.h"

namespace oro {
namespace {

// The description of a VRT, as GDAL has it; empty for rasters of other formats.
Xml tree_of(GDALDatasetH dataset) {
    const char* const* const text = GDALGetMetadata(dataset, "xml:VRT");
    return Xml(text != nullptr && *text != nullptr ? CPLParseXMLString(*text) : nullptr);
}

double number_of(const CPLXMLNode* node, const char* path, double otherwise) {
    const char* const text = CPLGetXMLValue(node, path, nullptr);
    return text != nullptr ? std::strtod(text, nullptr) : otherwise;
}

// The file that a node names beside its VRT or by its whole path.
std::string file_of(const CPLXMLNode* node, const std::string& path, GDALDatasetH dataset) {
    const std::string name = CPLGetXMLValue(node, path.c_str(), "");
    const bool relative = std::string(CPLGetXMLValue(node, (path + ".relativeToVRT").c_str(), "0")) != "0";
    return relative ? file_relative_to(GDALGetDescription(dataset), name) : name;
}

std::string_view driver_of(GDALDatasetH dataset) {
    const char* const name = GDALGetDriverShortName(GDALGetDatasetDriver(dataset));
    return name != nullptr ? name : "";
}

PostWindow meeting(const PostWindow& a, const PostWindow& b) {
    const int row = std::max(a.row, b.row), column = std::max(a.column, b.column);
    const int rows = std::min(a.row + a.rows, b.row + b.rows) - row;
    const int columns = std::min(a.column + a.columns, b.column + b.columns) - column;
    return rows > 0 && columns > 0 ? PostWindow{row, column, rows, columns} : PostWindow{};
}

// What is left of some rectangles beside another one.
std::vector<PostWindow> outside_of(const std::vector<PostWindow>& all, const PostWindow& cut) {
    std::vector<PostWindow> left;
    const auto keep = [&](int row, int column, int rows, int columns) {
        if (rows > 0 && columns > 0) left.push_back({row, column, rows, columns});
    };
    for (const PostWindow& one : all) {
        const PostWindow hit = meeting(one, cut);
        if (hit.rows == 0) {
            left.push_back(one);
            continue;
        }
        keep(one.row, one.column, hit.row - one.row, one.columns);
        keep(hit.row + hit.rows, one.column, one.row + one.rows - hit.row - hit.rows, one.columns);
        keep(hit.row, one.column, hit.rows, hit.column - one.column);
        keep(hit.row, hit.column + hit.columns, hit.rows,
             one.column + one.columns - hit.column - hit.columns);
    }
    return left;
}

// The whole pixels that GDAL paints of a part of them.
PostWindow pixels_of(double column, double row, double columns, double rows) {
    constexpr double slack = 0.001;  // as GDAL has it
    constexpr double most = 2e9;
    const auto first = [&](double at) {
        return static_cast<int>(std::clamp(std::floor(at + slack), -most, most));
    };
    const auto end = [&](double at) {
        return static_cast<int>(std::clamp(std::ceil(at - slack), -most, most));
    };
    return {first(row), first(column), std::max(0, end(row + rows) - first(row)),
            std::max(0, end(column + columns) - first(column))};
}

PostWindow pixels_of(const VrtPart& part) {
    return pixels_of(part.column, part.row, part.columns, part.rows);
}

bool has_no_data(GDALRasterBandH band) {
    int declared = 0;
    GDALGetRasterNoDataValue(band, &declared);
    return declared != 0;
}

// Blocks of a TIFF that are not in the file. Runs of them along a row are one rectangle.
std::vector<PostWindow> unwritten_blocks(GDALRasterBandH band, const PostWindow& window) {
    const auto is_empty = [&](const PostWindow& part, int stop_at) {
        const int status =
            GDALGetDataCoverageStatus(band, part.column, part.row, part.columns, part.rows, stop_at, nullptr);
        return (status & GDAL_DATA_COVERAGE_STATUS_UNIMPLEMENTED) == 0 &&
               (status & GDAL_DATA_COVERAGE_STATUS_EMPTY) != 0;
    };
    std::vector<PostWindow> empty;
    if (!is_empty(window, GDAL_DATA_COVERAGE_STATUS_EMPTY)) return empty;
    int width = 0, height = 0;
    GDALGetBlockSize(band, &width, &height);
    if (width <= 0 || height <= 0) return empty;
    for (int row = window.row / height * height; row < window.row + window.rows; row += height) {
        PostWindow run{};
        for (int column = window.column / width * width; column < window.column + window.columns;
             column += width) {
            const PostWindow block = meeting({row, column, height, width}, window);
            if (!is_empty(block, GDAL_DATA_COVERAGE_STATUS_DATA)) {
                if (run.rows > 0) empty.push_back(run);
                run = {};
            } else if (run.rows > 0) {
                run.columns += block.columns;
            } else {
                run = block;
            }
        }
        if (run.rows > 0) empty.push_back(run);
    }
    return empty;
}

std::vector<PostWindow> unwritten(GDALDatasetH dataset, int band, const PostWindow& window, int depth);

// What is unwritten in a VRT's part, in the VRT's pixels.
std::vector<PostWindow> unwritten_in_part(const VrtPart& part, const PostWindow& wanted, int depth) {
    const Dataset source(GDALOpenEx(part.file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, trusted_drivers(),
                                    nullptr, nullptr));
    if (!source || part.band > GDALGetRasterCount(source.get())) return {};
    const double wide = part.columns / part.own_columns, tall = part.rows / part.own_rows;
    const PostWindow own = meeting(
        pixels_of(part.own_column + (wanted.column - part.column) / wide,
                  part.own_row + (wanted.row - part.row) / tall, wanted.columns / wide, wanted.rows / tall),
        {0, 0, GDALGetRasterYSize(source.get()), GDALGetRasterXSize(source.get())});
    std::vector<PostWindow> found;
    if (own.rows == 0) return found;
    for (const PostWindow& one : unwritten(source.get(), part.band, own, depth + 1)) {
        // A pixel is what its middle shows.
        const auto first = [](double at) { return static_cast<int>(std::ceil(at - 0.5)); };
        const int row = first(part.row + (one.row - part.own_row) * tall);
        const int column = first(part.column + (one.column - part.own_column) * wide);
        const int end_row = first(part.row + (one.row + one.rows - part.own_row) * tall);
        const int end_column = first(part.column + (one.column + one.columns - part.own_column) * wide);
        const PostWindow here = meeting({row, column, end_row - row, end_column - column}, wanted);
        if (here.rows > 0) found.push_back(here);
    }
    return found;
}

// One flag for each pixel of a window.
struct Flags {
    PostWindow window;
    std::vector<unsigned char> set;
    Flags(const PostWindow& of, unsigned char first)
        : window(of), set(static_cast<std::size_t>(of.rows) * static_cast<std::size_t>(of.columns), first) {}
    unsigned char* at(int row, int column) {
        return set.data() +
               static_cast<std::size_t>(row - window.row) * static_cast<std::size_t>(window.columns) +
               static_cast<std::size_t>(column - window.column);
    }
    void fill(const PostWindow& where, unsigned char value) {
        for (int row = where.row; row < where.row + where.rows; ++row)
            std::fill_n(at(row, where.column), where.columns, value);
    }
    // Rectangles of pixels whose flag is set: runs of a row, together with the same runs of the rows below.
    std::vector<PostWindow> rectangles() {
        std::vector<PostWindow> done, above, here;
        for (int row = window.row; row <= window.row + window.rows; ++row) {
            here.clear();
            for (int column = window.column;
                 row < window.row + window.rows && column < window.column + window.columns;) {
                const int first = column;
                while (column < window.column + window.columns && *at(row, column) != 0) ++column;
                if (column > first) here.push_back({row, first, 1, column - first});
                column += column == first;
            }
            std::size_t next = 0;
            for (const PostWindow& one : above) {
                while (next < here.size() && here[next].column < one.column) ++next;
                if (next < here.size() && here[next].column == one.column &&
                    here[next].columns == one.columns)
                    here[next].row = one.row, here[next].rows = one.rows + 1;
                else
                    done.push_back(one);
            }
            above = here;
        }
        return done;
    }
};

// The same warp with an alpha band, which is 0 where no pixel of the source comes to lie; nothing where the
// warp has one already.
Dataset warp_with_alpha(GDALDatasetH dataset) {
    const Xml tree = tree_of(dataset);
    CPLXMLNode* const root = tree ? CPLGetXMLNode(tree.get(), "=VRTDataset") : nullptr;
    CPLXMLNode* const options = root != nullptr ? CPLGetXMLNode(root, "GDALWarpOptions") : nullptr;
    if (options == nullptr || CPLGetXMLNode(options, "DstAlphaBand") != nullptr) return nullptr;
    const std::string file = file_of(options, "SourceDataset", dataset);
    CPLSetXMLValue(options, "SourceDataset", file.c_str());
    CPLSetXMLValue(options, "SourceDataset.#relativeToVRT", "0");
    const std::string number = std::to_string(GDALGetRasterCount(dataset) + 1);
    CPLCreateXMLElementAndValue(options, "DstAlphaBand", number.c_str());
    CPLXMLNode* const band = CPLCreateXMLNode(root, CXT_Element, "VRTRasterBand");
    CPLAddXMLAttributeAndValue(band, "dataType", "Byte");
    CPLAddXMLAttributeAndValue(band, "band", number.c_str());
    CPLAddXMLAttributeAndValue(band, "subClass", "VRTWarpedRasterBand");
    CPLCreateXMLElementAndValue(band, "ColorInterp", "Alpha");
    char* const text = CPLSerializeXMLTree(root);
    Dataset warp(GDALOpenEx(text, GDAL_OF_RASTER | GDAL_OF_READONLY, trusted_drivers(), nullptr, nullptr));
    CPLFree(text);
    return warp;
}

// What no pixel of a warped VRT's source covers.
std::vector<PostWindow> outside_of_warp(GDALDatasetH dataset, int band, const PostWindow& window) {
    if (has_no_data(GDALGetRasterBand(dataset, band))) return {};
    const Dataset warp = warp_with_alpha(dataset);
    if (!warp) return {};
    const GDALRasterBandH alpha = GDALGetRasterBand(warp.get(), GDALGetRasterCount(warp.get()));
    std::vector<PostWindow> found;
    const int strip = std::max(1, (1 << 24) / std::max(1, window.columns));
    for (int row = 0; row < window.rows; row += strip) {
        Flags empty({window.row + row, window.column, std::min(strip, window.rows - row), window.columns}, 0);
        const PostWindow& here = empty.window;
        if (GDALRasterIO(alpha, GF_Read, here.column, here.row, here.columns, here.rows, empty.set.data(),
                         here.columns, here.rows, GDT_Byte, 0, 0) != CE_None)
            return {};
        for (unsigned char& flag : empty.set) flag = flag == 0;
        const std::vector<PostWindow> some = empty.rectangles();
        found.insert(found.end(), some.begin(), some.end());
    }
    return found;
}

// Marks the pixels of a part as full where it paints them.
void paint_valid(const VrtPart& part, const PostWindow& painted, Flags& empty) {
    const Dataset source(GDALOpenEx(part.file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, trusted_drivers(),
                                    nullptr, nullptr));
    if (!source || part.band > GDALGetRasterCount(source.get())) return empty.fill(painted, 0);
    GDALRasterBandH band = GDALGetRasterBand(source.get(), part.band);
    if (part.is_masked) band = GDALGetMaskBand(band);
    const bool is_single = GDALGetRasterDataType(band) == GDT_Float32;
    const double wide = part.columns / part.own_columns, tall = part.rows / part.own_rows;
    const int all_columns = GDALGetRasterXSize(source.get()), all_rows = GDALGetRasterYSize(source.get());
    std::vector<double> line(static_cast<std::size_t>(all_columns));
    int last = -1;
    for (int row = painted.row; row < painted.row + painted.rows; ++row) {
        const double own_row = part.own_row + (row + 0.5 - part.row) / tall;
        const int from = std::clamp(static_cast<int>(std::floor(own_row)), 0, all_rows - 1);
        if (from != last && GDALRasterIO(band, GF_Read, 0, from, all_columns, 1, line.data(), all_columns, 1,
                                         GDT_Float64, 0, 0) != CE_None)
            return empty.fill(painted, 0);
        last = from;
        for (int column = painted.column; column < painted.column + painted.columns; ++column) {
            const double own = part.own_column + (column + 0.5 - part.column) / wide;
            const double value = line[static_cast<std::size_t>(
                std::clamp(static_cast<int>(std::floor(own)), 0, all_columns - 1))];
            const double none = part.no_data.value_or(0.0);
            const bool is_none =
                is_single ? static_cast<float>(value) == static_cast<float>(none) : value == none;
            if (!std::isnan(value) && !is_none) *empty.at(row, column) = 0;
        }
    }
}

// As unwritten_of_vrt, where some parts are painted in part only.
std::vector<PostWindow> unwritten_of_masked(const std::vector<VrtPart>& parts, const PostWindow& window,
                                            int depth) {
    std::vector<PostWindow> found;
    const int strip = std::max(1, (1 << 26) / std::max(1, window.columns));
    for (int row = 0; row < window.rows; row += strip) {
        Flags empty({window.row + row, window.column, std::min(strip, window.rows - row), window.columns}, 1);
        for (const VrtPart& part : parts) {
            const PostWindow painted = meeting(pixels_of(part), empty.window);
            if (painted.rows == 0) continue;
            if (part.no_data || part.is_masked) {
                paint_valid(part, painted, empty);
                continue;
            }
            empty.fill(painted, 0);
            if (part.is_plain && depth < deepest_vrt)
                for (const PostWindow& one : unwritten_in_part(part, painted, depth)) empty.fill(one, 1);
        }
        const std::vector<PostWindow> here = empty.rectangles();
        found.insert(found.end(), here.begin(), here.end());
    }
    return found;
}

std::vector<PostWindow> unwritten_of_vrt(GDALDatasetH dataset, int band, const PostWindow& window,
                                         int depth) {
    if (source_of_warped_vrt(dataset, band)) return outside_of_warp(dataset, band, window);
    const std::vector<VrtPart> parts = parts_of_vrt_band(dataset, band);
    std::vector<PostWindow> empty;
    if (parts.empty()) return empty;
    const bool declares = has_no_data(GDALGetRasterBand(dataset, band));
    const auto is_in_part = [](const VrtPart& part) { return part.no_data || part.is_masked; };
    if (!declares && std::ranges::any_of(parts, is_in_part)) return unwritten_of_masked(parts, window, depth);
    if (!declares) empty.push_back(window);
    for (const VrtPart& part : parts) {
        const PostWindow painted = meeting(pixels_of(part), window);
        if (painted.rows == 0) continue;
        empty = outside_of(empty, painted);
        if (!part.is_plain || depth >= deepest_vrt) continue;
        const std::vector<PostWindow> in_part = unwritten_in_part(part, painted, depth);
        empty.insert(empty.end(), in_part.begin(), in_part.end());
    }
    return empty;
}

std::vector<PostWindow> unwritten(GDALDatasetH dataset, int band, const PostWindow& window, int depth) {
    if (driver_of(dataset) == "VRT") return unwritten_of_vrt(dataset, band, window, depth);
    const GDALRasterBandH raster = GDALGetRasterBand(dataset, band);
    if (driver_of(dataset) != "GTiff" || has_no_data(raster)) return {};
    return unwritten_blocks(raster, window);
}

VrtPart part_of(const CPLXMLNode* node, GDALDatasetH dataset) {
    VrtPart part;
    const std::string kind = lower_case(node->pszValue);
    part.file = file_of(node, "SourceFilename", dataset);
    const std::string own_band = CPLGetXMLValue(node, "SourceBand", "1");
    part.band = static_cast<int>(std::strtol(own_band.c_str(), nullptr, 10));
    part.columns = number_of(node, "DstRect.xSize", GDALGetRasterXSize(dataset));
    part.rows = number_of(node, "DstRect.ySize", GDALGetRasterYSize(dataset));
    part.column = number_of(node, "DstRect.xOff", 0.0);
    part.row = number_of(node, "DstRect.yOff", 0.0);
    part.own_columns = number_of(node, "SrcRect.xSize", part.columns);
    part.own_rows = number_of(node, "SrcRect.ySize", part.rows);
    part.own_column = number_of(node, "SrcRect.xOff", 0.0);
    part.own_row = number_of(node, "SrcRect.yOff", 0.0);
    const bool has_pixels = (kind == "simplesource" || kind == "complexsource") && part.band >= 1 &&
                            part.own_columns > 0.0 && part.own_rows > 0.0 && part.columns > 0.0 &&
                            part.rows > 0.0;
    if (!has_pixels) return part;
    const char* const no_data = CPLGetXMLValue(node, "NODATA", nullptr);
    if (no_data != nullptr && kind == "complexsource") part.no_data = std::strtod(no_data, nullptr);
    part.is_masked = CPLGetXMLNode(node, "UseMaskBand") != nullptr && kind == "complexsource";
    part.is_plain = !part.no_data && !part.is_masked;
    const std::string resampling = lower_case(CPLGetXMLValue(node, "resampling", "nearest"));
    for (const char* const how : {"ScaleRatio", "ScaleOffset", "LUT", "Exponent", "ColorTableComponent"})
        part.changes_values = part.changes_values || CPLGetXMLNode(node, how) != nullptr;
    part.changes_values = part.changes_values || !resampling.starts_with("near");
    return part;
}

}  // namespace

std::vector<VrtPart> parts_of_vrt_band(GDALDatasetH dataset, int band) {
    std::vector<VrtPart> parts;
    if (driver_of(dataset) != "VRT") return parts;
    const Xml tree = tree_of(dataset);
    const CPLXMLNode* const root = tree ? CPLGetXMLNode(tree.get(), "=VRTDataset") : nullptr;
    if (root == nullptr || *CPLGetXMLValue(root, "subClass", "") != '\0') return parts;
    int number = 0;
    for (const CPLXMLNode* node = root->psChild; node != nullptr; node = node->psNext) {
        if (node->eType != CXT_Element || lower_case(node->pszValue) != "vrtrasterband") continue;
        if (++number != band) continue;
        const std::string kind = lower_case(CPLGetXMLValue(node, "subClass", ""));
        if (!kind.empty() && kind != "vrtsourcedrasterband") return parts;
        for (const CPLXMLNode* source = node->psChild; source != nullptr; source = source->psNext)
            if (source->eType == CXT_Element && lower_case(source->pszValue).ends_with("source"))
                parts.push_back(part_of(source, dataset));
    }
    return parts;
}

std::optional<VrtPart> source_of_warped_vrt(GDALDatasetH dataset, int band) {
    if (driver_of(dataset) != "VRT") return std::nullopt;
    const Xml tree = tree_of(dataset);
    const CPLXMLNode* const root = tree ? CPLGetXMLNode(tree.get(), "=VRTDataset") : nullptr;
    if (root == nullptr || lower_case(CPLGetXMLValue(root, "subClass", "")) != "vrtwarpeddataset")
        return std::nullopt;
    const CPLXMLNode* const options = CPLGetXMLNode(root, "GDALWarpOptions");
    if (options == nullptr) return std::nullopt;
    VrtPart source;
    source.file = file_of(options, "SourceDataset", dataset);
    const std::string how = lower_case(CPLGetXMLValue(options, "ResampleAlg", "nearest"));
    source.changes_values = !how.starts_with("near");
    source.band = band;
    const CPLXMLNode* const list = CPLGetXMLNode(options, "BandList");
    for (const CPLXMLNode* node = list != nullptr ? list->psChild : nullptr; node != nullptr;
         node = node->psNext)
        if (node->eType == CXT_Element && static_cast<int>(number_of(node, "dst", band)) == band)
            source.band = static_cast<int>(number_of(node, "src", band));
    return source;
}

std::vector<PostWindow> unwritten_parts(GDALDatasetH dataset, int band, const PostWindow& window) {
    const GdalMessages messages;  // a part that cannot be opened is told where its posts are read
    return unwritten(dataset, band, window, 0);
}

}  // namespace oro
