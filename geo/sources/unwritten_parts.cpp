#include "geo/sources/unwritten_parts.h"

#include <cpl_minixml.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string_view>

#include "geo/files/letter_case.h"
#include "geo/sources/raster_parts.h"

namespace oro {
namespace {

struct FreeTree {
    void operator()(CPLXMLNode* node) const { CPLDestroyXMLNode(node); }
};

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
std::vector<PostWindow> beside_of(const std::vector<PostWindow>& all, const PostWindow& cut) {
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

std::vector<PostWindow> unwritten_of_vrt(GDALDatasetH dataset, int band, const PostWindow& window,
                                         int depth) {
    const std::vector<VrtPart> parts = parts_of_vrt_band(dataset, band);
    std::vector<PostWindow> empty;
    if (parts.empty()) return empty;
    if (!has_no_data(GDALGetRasterBand(dataset, band))) empty.push_back(window);
    for (const VrtPart& part : parts) {
        const PostWindow painted = meeting(pixels_of(part), window);
        if (painted.rows == 0) continue;
        empty = beside_of(empty, painted);
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

double number_of(const CPLXMLNode* node, const char* path, double otherwise) {
    const char* const text = CPLGetXMLValue(node, path, nullptr);
    return text != nullptr ? std::strtod(text, nullptr) : otherwise;
}

std::string folder_and_name(const std::string& vrt, const std::string& name) {
    const std::size_t slash = vrt.rfind('/');
    return slash == std::string::npos ? name : vrt.substr(0, slash + 1) + name;
}

VrtPart part_of(const CPLXMLNode* node, GDALDatasetH dataset) {
    VrtPart part;
    const std::string kind = lower_case(node->pszValue);
    const std::string name = CPLGetXMLValue(node, "SourceFilename", "");
    const bool relative = std::string(CPLGetXMLValue(node, "SourceFilename.relativeToVRT", "0")) != "0";
    part.file = relative ? folder_and_name(GDALGetDescription(dataset), name) : name;
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
    const bool all_values =
        CPLGetXMLNode(node, "NODATA") == nullptr && CPLGetXMLNode(node, "UseMaskBand") == nullptr;
    part.is_plain = (kind == "simplesource" || (kind == "complexsource" && all_values)) && part.band >= 1 &&
                    part.own_columns > 0.0 && part.own_rows > 0.0 && part.columns > 0.0 && part.rows > 0.0;
    return part;
}

}  // namespace

std::vector<VrtPart> parts_of_vrt_band(GDALDatasetH dataset, int band) {
    std::vector<VrtPart> parts;
    if (driver_of(dataset) != "VRT") return parts;
    const char* const* const text = GDALGetMetadata(dataset, "xml:VRT");
    if (text == nullptr || *text == nullptr) return parts;
    const std::unique_ptr<CPLXMLNode, FreeTree> tree(CPLParseXMLString(*text));
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

std::vector<PostWindow> unwritten_parts(GDALDatasetH dataset, int band, const PostWindow& window) {
    const GdalMessages messages;  // a part that cannot be opened is told where its posts are read
    return unwritten(dataset, band, window, 0);
}

}  // namespace oro
