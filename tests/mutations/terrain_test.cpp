// Damaged baked regions, rasters and archives.
#include <gdal.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "core/baked/file_pages.h"
#include "core/base/checksum.h"
#include "geo/opening/open_region.h"
#include "geo/region/region.h"
#include "tests/mutations/mutation.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using namespace oro;
using namespace oro::test;

// Grid, heights and undulation of a region, in one number.
std::uint64_t sum_of(const HeightField& field) {
    std::uint64_t sum = 0;
    for (const GridAxis& axis :
         {field.grid.lat, field.grid.lon, field.undulation.lat, field.undulation.lon}) {
        sum = xxh64(std::as_bytes(std::span(&axis.posts_per_deg, 1)), sum);
        sum = xxh64(std::as_bytes(std::span(&axis.phase_deg, 1)), sum);
        sum = xxh64(std::as_bytes(std::span(&axis.first, 1)), sum);
        sum = xxh64(std::as_bytes(std::span(&axis.count, 1)), sum);
    }
    sum = xxh64(std::as_bytes(std::span(field.undulation.N_m)), sum);
    return xxh64(std::as_bytes(std::span(field.H_m)), sum);
}

struct Terrain {
    std::uint64_t sum{};
    std::size_t notes{};
    std::uint64_t voids{};
};

Result<Terrain> terrain_of(const fs::path& file) {
    RegionRequest request;
    request.paths = {file.string()};
    auto region = open_region(request);
    if (!region.ok()) return region.error();
    Terrain terrain{0, region->grids[0].notes.size() + region->grids[0].missing_cells.size(), region->grids[0].voids};
    if (!region->grids[0].file) {
        terrain.sum = sum_of(region->grids[0].field);
        return terrain;
    }
    const auto field = field_in_memory(*region->grids[0].file);
    if (!field.ok()) return field.error();
    terrain.sum = sum_of(*field);
    return terrain;
}

void expect_terrain(const Sample& sample, long cases) {
    const auto whole = terrain_of(sample.folder / sample.opened);
    if (!whole.ok()) {
        std::printf("%s: not opened even undamaged (%s)\n", sample.name.c_str(),
                    whole.error().line().c_str());
        return;
    }
    expect_no_silence(sample, share_of(cases), [&](const fs::path& file, std::string& said) {
        const auto terrain = terrain_of(file);
        if (!terrain.ok()) {
            said = terrain.error().line();
            return Found::refused;
        }
        if (terrain->sum == whole->sum) return Found::same;
        return terrain->notes > whole->notes || terrain->voids > whole->voids ? Found::noted : Found::other;
    });
}

int shell(const std::string& command) {
    const int status = std::system((command + " >/dev/null 2>&1").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

std::string quoted(const fs::path& path) {
    return "'" + path.string() + "'";
}

// A corner of the bundled region, written by GDAL's own programs.
fs::path corner(int side) {
    const fs::path file = scratch_folder() / "corner.tif";
    const std::string size = std::to_string(side);
    EXPECT_EQ(shell("gdal_translate -srcwin 100 100 " + size + " " + size + " " +
                    quoted(bundled_data() / "jacksboro.tif") + " " + quoted(file)),
              0);
    return file;
}

TEST(Mutated, BakedRegions) {
    for (const int side : {40, 300}) {
        Sample sample{"oro-" + std::to_string(side), scratch_folder(), "r.oro", {"r.oro"}, true};
        ASSERT_EQ(shell(std::string(OROGRAPH_PROGRAM) + " bake -q " + quoted(corner(side)) + " --out " +
                        quoted(sample.folder / "r.oro")),
                  0);
        expect_terrain(sample, 1250);
    }
}

struct Format {
    const char* name;
    const char* file;
    const char* options;
    std::vector<std::string> damaged;
    bool has_checksum;
    bool needs_place{};  // the format states no CRS: opened through a VRT that does
};

TEST(Mutated, Rasters) {
    const std::vector<Format> formats{
        {"GTiff", "r.tif", "-of GTiff", {"r.tif"}, false},
        {"GTiff-deflate-tiled",
         "r.tif",
         "-of GTiff -co COMPRESS=DEFLATE -co TILED=YES -co BLOCKXSIZE=16 -co BLOCKYSIZE=16",
         {"r.tif"},
         false},
        {"COG", "r.tif", "-of COG", {"r.tif"}, false},
        {"AAIGrid", "r.asc", "-of AAIGrid", {"r.asc", "r.prj"}, false},
        {"ENVI", "r.bil", "-of ENVI", {"r.bil", "r.hdr"}, false},
        {"EHdr", "r.flt", "-of EHdr -ot Float32", {"r.flt", "r.hdr"}, false},
        {"HFA", "r.img", "-of HFA", {"r.img"}, false},
        {"DTED",
         "N36W085.dt0",
         "-of DTED -a_ullr -85.00416666 37.00416666 -83.99583333 35.99583333 -outsize 121 121 -a_srs "
         "EPSG:4326",
         {"N36W085.dt0"},
         false},
        {"SRTMHGT",
         "N36W085.hgt",
         "-of SRTMHGT -a_ullr -85.00041666 37.00041666 -83.99958333 35.99958333 -outsize 1201 1201 -a_srs "
         "EPSG:4326",
         {"N36W085.hgt"},
         false},
        {"BT", "r.bt", "-of BT", {"r.bt"}, false},
        {"USGSDEM", "r.dem", "-of USGSDEM", {"r.dem"}, false},
        {"PNG", "r.png", "-of PNG -ot UInt16 -co WORLDFILE=YES", {"r.png"}, false},
        {"JP2OpenJPEG", "r.jp2", "-of JP2OpenJPEG -co REVERSIBLE=YES -co QUALITY=100", {"r.jp2"}, false},
        {"netCDF", "r.nc", "-of netCDF", {"r.nc"}, false},
        {"GPKG", "r.gpkg", "-of GPKG -ot Float32", {"r.gpkg"}, false},
        {"XYZ", "r.xyz", "-of XYZ", {"r.xyz"}, false},
        {"VRT", "r.vrt", "-of VRT", {"r.vrt", "corner.tif"}, false},
        {"GSAG", "r.grd", "-of GSAG", {"r.grd"}, false, true},
        {"GSBG", "r.grd", "-of GSBG", {"r.grd"}, false, true},
        {"GS7BG", "r.grd", "-of GS7BG", {"r.grd"}, false, true},
    };
    const fs::path source = corner(60);
    for (const Format& format : formats) {
        SCOPED_TRACE(format.name);
        Sample sample{format.name, scratch_folder(), format.file, format.damaged, format.has_checksum};
        fs::copy_file(source, sample.folder / "corner.tif");
        ASSERT_EQ(shell("cd " + quoted(sample.folder) + " && gdal_translate " + format.options +
                        " corner.tif " + format.file),
                  0);
        if (format.needs_place) {
            ASSERT_EQ(shell("cd " + quoted(sample.folder) + " && gdal_translate -of VRT -a_srs EPSG:4269 " +
                            format.file + " r.vrt"),
                      0);
            sample.opened = "r.vrt";
        }
        expect_terrain(sample, 1400 / 12 + 1);
    }
}

TEST(Mutated, Archives) {
    const fs::path tile = scratch_folder();
    ASSERT_EQ(shell("cd " + quoted(tile) +
                    " && gdal_translate -of SRTMHGT -a_ullr -85.00041666 37.00041666 -83.99958333 "
                    "35.99958333 -outsize 1201 1201 -a_srs EPSG:4326 " +
                    quoted(corner(60)) + " N36W085.hgt"),
              0);
    struct Archive {
        const char* name;
        const char* file;
        std::string command;
        bool has_checksum;
    };
    for (const Archive& archive :
         std::vector<Archive>{{"zip", "t.zip", "zip -q t.zip N36W085.hgt", true},
                              {"tar", "t.tar", "tar cf t.tar N36W085.hgt", false},
                              {"tar.gz", "t.tar.gz", "tar czf t.tar.gz N36W085.hgt", true},
                              {"gz", "N36W085.hgt.gz", "gzip -k N36W085.hgt", true}}) {
        SCOPED_TRACE(archive.name);
        Sample sample{archive.name, scratch_folder(), archive.file, {archive.file}, archive.has_checksum};
        ASSERT_EQ(shell("cd " + quoted(tile) + " && " + archive.command + " && mv " + archive.file + " " +
                        quoted(sample.folder)),
                  0);
        expect_terrain(sample, 225);
    }
}

}  // namespace
