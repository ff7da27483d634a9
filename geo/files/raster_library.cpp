#include "geo/files/raster_library.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal_frmts.h>
#include <gdal_priv.h>
#include <tiffio.h>

#include <array>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "geo/files/guarded_files.h"
#include "geo/files/library_faults.h"
#include "geo/files/network_paths.h"

namespace oro {
namespace {

struct Trusted {
    const char* driver;
    const char* name;  // for people; null for those that are not spoken of
    void (*enter)();   // puts it on GDAL's list
};
// GTX is for the grids of geoids.
constexpr std::array trusted{Trusted{"VRT", "VRT", GDALRegister_VRT},
                             Trusted{"GTiff", "GeoTIFF", GDALRegister_GTiff},
                             Trusted{"JP2OpenJPEG", "JPEG 2000", GDALRegister_JP2OpenJPEG},
                             Trusted{"DTED", "DTED", GDALRegister_DTED},
                             Trusted{"USGSDEM", "USGS DEM", GDALRegister_USGSDEM},
                             Trusted{"HFA", "Erdas Imagine", GDALRegister_HFA},
                             Trusted{"AAIGrid", "Esri ASCII grid", GDALRegister_AAIGrid},
                             Trusted{"BT", "Binary Terrain", GDALRegister_BT},
                             Trusted{"GSAG", "Golden Software grid", GDALRegister_GSAG},
                             Trusted{"GSBG", nullptr, GDALRegister_GSBG},
                             Trusted{"GS7BG", nullptr, GDALRegister_GS7BG},
                             Trusted{"GTX", nullptr, GDALRegister_GTX}};

// What is said while nobody listens stays unsaid: errors are told by whoever asked, in one line.
void CPL_STDCALL say_nothing(CPLErr severity, CPLErrorNum number, const char*) {
    note_gdal_message(severity == CE_Fatal, number == CPLE_OutOfMemory);
}

std::string in_one_line(std::string text) {
    for (char& c : text) {
        if (c == '\n' || c == '\r') c = ' ';
    }
    return text;
}

// What may be said in the environment: it makes GDAL faster, or tells where its own files are and where
// others may be for a while. None of it changes what a file means.
constexpr std::array free_options{"GDAL_CACHEMAX",
                                  "GDAL_NUM_THREADS",
                                  "GDAL_MAX_DATASET_POOL_SIZE",
                                  "GDAL_MAX_DATASET_POOL_RAM_USAGE",
                                  "GDAL_BAND_BLOCK_CACHE",
                                  "VSI_CACHE",
                                  "VSI_CACHE_SIZE",
                                  "OGR_SQLITE_CACHE",
                                  "GDAL_DATA",
                                  "CPL_TMPDIR",
                                  "TMPDIR",
                                  "TEMP",
                                  "HOME"};

// GDAL has hundreds of options that change what a file means (GTIFF_POINT_GEO_IGNORE moves a raster by half a
// post), and takes them from the environment and from files (~/.gdal/gdalrc). The same data give the same
// picture everywhere: those of files are forgotten, and those of the environment are not asked about.
void pin_options() {
    // It reads these files when it is made, if nothing names another.
    CPLSetConfigOption("GDAL_CONFIG_FILE", "");
    (void)GetGDALDriverManager();
    CPLSetConfigOptions(nullptr);
    VSIClearPathSpecificOptions(nullptr);
    std::vector<std::pair<const char*, std::string>> kept;
    for (const char* const name : free_options)
        if (const char* const value = std::getenv(name)) kept.emplace_back(name, value);
    constexpr const char* directives = "/vsimem/orograph-gdalrc";
    static std::string text = "[directives]\nignore-env-vars=yes\n";
    VSILFILE* const file =
        VSIFileFromMemBuffer(directives, reinterpret_cast<GByte*>(text.data()), text.size(), FALSE);
    if (file != nullptr) VSIFCloseL(file);
    CPLLoadConfigOptionsFromFile(directives, FALSE);
    VSIUnlink(directives);
    for (const auto& [name, value] : kept) CPLSetConfigOption(name, value.c_str());
}

void set_options() {
    pin_options();
    // GDAL would write FILE.gz.properties beside a compressed file it has measured.
    CPLSetConfigOption("CPL_VSIL_GZIP_WRITE_PROPERTIES", "NO");
    // Otherwise GeoTIFF 1.0 files lose the vertical datum that they state.
    CPLSetConfigOption("GTIFF_REPORT_COMPD_CS", "YES");
    // Sidecar files are asked for by name: listing a folder of thousands of tiles for each of them takes
    // minutes.
    CPLSetConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "TRUE");
    // A VRT may carry programs.
    CPLSetConfigOption("GDAL_VRT_ENABLE_PYTHON", "NO");
    // Where a network is let in: no waiting for ever, and what the user's environment says of it.
    if (are_network_paths_allowed()) {
        for (const auto& [name, value] :
             {std::pair{"GDAL_HTTP_CONNECTTIMEOUT", "20"}, std::pair{"GDAL_HTTP_LOW_SPEED_TIME", "30"},
              std::pair{"GDAL_HTTP_LOW_SPEED_LIMIT", "1000"}, std::pair{"GDAL_HTTP_MAX_RETRY", "4"},
              std::pair{"GDAL_HTTP_RETRY_DELAY", "1"}})
            CPLSetConfigOption(name, value);
        for (const auto& [name, value] : network_options_of_environment())
            CPLSetConfigOption(name.c_str(), value.c_str());
    }
    OSRSetPROJEnableNetwork(0);
    // GDAL from 3.10 on lets libtiff write some failures to standard error: what cannot be read is told by
    // us.
    TIFFSetErrorHandler(nullptr);
    TIFFSetWarningHandler(nullptr);
}

}  // namespace

void start_gdal() {
    // Not std::call_once: what is thrown through it (there is no memory) must find glibc's unwinder, which is
    // loaded then, and aborts where that fails.
    static const bool is_started = [] {
        CPLSetErrorHandler(say_nothing);
        set_options();
        for (const Trusted& format : trusted) format.enter();
        // For rasters over our own memory. Opened by name it would read memory at any address.
        GDALRegister_MEM();
        if (auto* const memory = static_cast<GDALDriver*>(GDALGetDriverByName("MEM"))) {
            memory->pfnOpen = nullptr;
            memory->pfnIdentify = nullptr;
        }
        guard_files();
        return true;
    }();
    (void)is_started;
}

const char* const* trusted_drivers() {
    static const std::vector<const char*> names = [] {
        std::vector<const char*> list;
        for (const Trusted& format : trusted) list.push_back(format.driver);
        list.push_back(nullptr);
        return list;
    }();
    return names.data();
}

std::string trusted_formats() {
    std::string names;
    for (const Trusted& format : trusted) {
        if (format.name != nullptr) names += (names.empty() ? "" : ", ") + std::string(format.name);
    }
    return names;
}

GdalMessages::GdalMessages() {
    CPLPushErrorHandlerEx(&GdalMessages::take, this);
}

GdalMessages::~GdalMessages() {
    CPLPopErrorHandler();
    CPLErrorReset();
}

namespace {

// GDAL's messages, but for those that name its own source files and say nothing to anybody else.
std::string words_of(const char* message) {
    const std::string words = message;
    const bool of_packing = words.starts_with("In file ") && words.find("gzip.cpp") != std::string::npos;
    return of_packing ? "packed bytes make no sense, or end early" : words;
}

}  // namespace

void CPL_STDCALL GdalMessages::take(CPLErr severity, CPLErrorNum number, const char* message) {
    note_gdal_message(severity == CE_Fatal, number == CPLE_OutOfMemory);
    if (message == nullptr) return;
    auto& messages = *static_cast<GdalMessages*>(CPLGetErrorHandlerUserData());
    if (severity >= CE_Failure) messages.text_ = without_keys(words_of(message));
    if (severity == CE_Warning && messages.warning_.empty()) messages.warning_ = without_keys(message);
}

std::string GdalMessages::last(const std::string& otherwise) const {
    return text_.empty() ? otherwise : in_one_line(text_);
}

std::string GdalMessages::warning() const {
    return in_one_line(warning_);
}

Dataset dataset_over(void* pixels, GDALDataType type, int columns, int rows) {
    const GDALDriverH memory = GDALGetDriverByName("MEM");
    if (!memory) return nullptr;
    Dataset dataset(GDALCreate(memory, "", columns, rows, 0, type, nullptr));
    if (!dataset) return nullptr;
    std::array<char, 64> pointer{};
    CPLPrintPointer(pointer.data(), pixels, static_cast<int>(pointer.size()) - 1);
    const std::string option = std::string("DATAPOINTER=") + pointer.data();
    const char* const options[] = {option.c_str(), nullptr};
    if (GDALAddBand(dataset.get(), type, const_cast<char**>(options)) != CE_None) return nullptr;
    return dataset;
}

SpatialReference wgs84_degrees() {
    SpatialReference reference(OSRNewSpatialReference(nullptr));
    OSRImportFromEPSG(reference.get(), 4326);
    OSRSetAxisMappingStrategy(reference.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return reference;
}

SpatialReference spatial_reference(const std::string& wkt) {
    SpatialReference reference(OSRNewSpatialReference(wkt.c_str()));
    if (reference) OSRSetAxisMappingStrategy(reference.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return reference;
}

}  // namespace oro
