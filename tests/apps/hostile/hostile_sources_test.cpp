// Terrain files of strangers name other files: none of them is reached over a network, waited for, or worked
// on for longer than the budget says.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bytes_of;
using oro::test::Circumstances;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::Words;
using oro::test::write_bytes;

// A server on this machine that counts who knocks, and hangs up.
class Listener {
  public:
    Listener() : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        auto* const any = reinterpret_cast<sockaddr*>(&address);
        socklen_t length = sizeof(address);
        if (bind(socket_, any, length) != 0 || listen(socket_, 64) != 0) return;
        getsockname(socket_, any, &length);
        port_ = ntohs(address.sin_port);
        thread_ = std::thread([this] {
            for (;;) {
                const int caller = accept(socket_, nullptr, nullptr);
                if (caller < 0) return;
                ++callers_;
                close(caller);
            }
        });
    }
    ~Listener() {
        shutdown(socket_, SHUT_RDWR);
        if (thread_.joinable()) thread_.join();
        close(socket_);
    }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    [[nodiscard]] std::string host() const { return "127.0.0.1:" + std::to_string(port_); }
    [[nodiscard]] int callers() const { return callers_; }

  private:
    int socket_;
    int port_{0};
    std::atomic<int> callers_{0};
    std::thread thread_;
};

std::string escaped(const std::string& text) {
    std::string xml;
    for (const char c : text) {
        if (c == '<')
            xml += "&lt;";
        else if (c == '&')
            xml += "&amp;";
        else if (c == '"')
            xml += "&quot;";
        else
            xml += c;
    }
    return xml;
}

constexpr const char* vrt_start =
    "<VRTDataset rasterXSize=\"20\" rasterYSize=\"20\"><SRS>EPSG:4326</SRS>"
    "<GeoTransform>8, 0.01, 0, 47, 0, -0.01</GeoTransform>";
constexpr const char* window =
    "<SourceBand>1</SourceBand><SrcRect xOff=\"0\" yOff=\"0\" xSize=\"20\" ySize=\"20\"/>"
    "<DstRect xOff=\"0\" yOff=\"0\" xSize=\"20\" ySize=\"20\"/></SimpleSource>";

std::string source_of(const std::string& name) {
    return "<SimpleSource><SourceFilename relativeToVRT=\"0\">" + escaped(name) + "</SourceFilename>" +
           window;
}

// A VRT of 20 x 20 posts made of these sources.
std::string vrt_of(const Words& names) {
    std::string text = vrt_start + std::string("<VRTRasterBand dataType=\"Float32\" band=\"1\">");
    for (const std::string& name : names) text += source_of(name);
    return text + "</VRTRasterBand></VRTDataset>";
}

class HostileSources : public testing::Test {
  protected:
    [[nodiscard]] Outcome info(const fs::path& file, const Circumstances& circumstances = {}) const {
        return run_orograph({"info", "-q", file}, circumstances);
    }
    // Fails with one line that names the file and says this, within a minute.
    void expect_refused(const fs::path& file, const std::string& says,
                        const Circumstances& circumstances = {}) const {
        const auto start = std::chrono::steady_clock::now();
        const Outcome outcome = info(file, circumstances);
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
        EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
        EXPECT_EQ(outcome.err_lines().size(), 1U) << outcome.err;
        EXPECT_NE(outcome.err.find(file.string()), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
    }

    const fs::path folder = oro::test::scratch_folder();
};

// Where each of GDAL's network file systems would go, if it could.
Circumstances pointed_at(const std::string& host) {
    Circumstances all;
    all.environment = {
        "AWS_S3_ENDPOINT=" + host, "AWS_HTTPS=NO", "AWS_VIRTUAL_HOSTING=FALSE", "AWS_NO_SIGN_REQUEST=YES",
        "CPL_GS_ENDPOINT=http://" + host, "GS_NO_SIGN_REQUEST=YES", "OSS_ENDPOINT=" + host, "OSS_HTTPS=NO",
        "OSS_VIRTUAL_HOSTING=FALSE", "OSS_SECRET_ACCESS_KEY=a", "OSS_ACCESS_KEY_ID=b",
        "SWIFT_STORAGE_URL=http://" + host, "SWIFT_AUTH_TOKEN=a",
        "AZURE_STORAGE_CONNECTION_STRING=DefaultEndpointsProtocol=http;AccountName=a;"
        "AccountKey=YQ==;BlobEndpoint=http://" +
            host,
        // What the environment says must not open what is closed.
        "CPL_VSIL_CURL_ALLOWED_FILENAME=", "PROJ_NETWORK=ON", "PROJ_NETWORK_ENDPOINT=http://" + host,
        "GDAL_HTTP_MAX_RETRY=0", "GDAL_HTTP_TIMEOUT=5"};
    return all;
}

Words network_names(const std::string& host) {
    const std::string url = "http://" + host + "/N46E008.tif";
    Words names{
        url,
        "/vsicurl?url=" + url,
        "NETCDF:\"" + url + "\":z",
        "NETCDF:" + url,
        "HDF5:\"/vsicurl/" + url + "\"://z",
        "ZARR:\"/vsicurl/" + url + "\"",
        "ZARR:\"" + url + "\"",
        "STACTA:\"" + url + "\"",
        "STACIT:\"" + url + "\"",
        "WMS:" + url,
        "WMTS:" + url,
        "WCS:" + url,
        "OGCAPI:" + url,
        "NGW:" + url,
        "GTIFF_DIR:1:/vsicurl/" + url,
        "PG:host=127.0.0.1 port=" + host.substr(host.find(':') + 1),
        "MVT:/vsicurl/" + url,
        "vrt:///vsicurl/" + url,
        "/vsizip//vsicurl/" + url + ".zip/a.tif",
        "/vsizip/{/vsicurl/" + url + ".zip}/a.tif",
        "/vsitar//vsicurl/" + url + ".tar/a.tif",
        "/vsigzip//vsicurl/" + url,
        "/vsisubfile/0_100,/vsicurl/" + url,
        "/vsisparse//vsicurl/" + url,
        "/vsicrypt/key=a,file=/vsicurl/" + url,
        "/vsicurl_streaming/" + url,
        "/vsicurl/" + url,
        "/vsiwebhdfs/" + url,
        "<GDAL_WMS><Service name=\"TMS\"><ServerUrl>" + url +
            "</ServerUrl></Service><DataWindow><SizeX>20</SizeX><SizeY>20</SizeY></DataWindow></GDAL_WMS>",
        vrt_of({"/vsicurl_streaming/" + url})};
    for (const char* place : {"s3", "gs", "az", "adls", "oss", "swift", "hdfs"}) {
        names.push_back(std::string("/vsi") + place + "/bucket/a.tif");
        names.push_back(std::string("/vsi") + place + "_streaming/bucket/a.tif");
    }
    return names;
}

TEST_F(HostileSources, SourcesOfAVrtReachNoNetwork) {
    const Listener listener;
    const Circumstances lured = pointed_at(listener.host());
    const fs::path vrt = folder / "a.vrt";
    for (const std::string& name : network_names(listener.host())) {
        SCOPED_TRACE(name);
        write_bytes(vrt, vrt_of({name}));
        expect_refused(vrt, "", lured);
        EXPECT_EQ(listener.callers(), 0);
    }
}

TEST_F(HostileSources, NetworkNamesInOtherPlacesReachNone) {
    const Listener listener;
    const Circumstances lured = pointed_at(listener.host());
    const std::string url = "http://" + listener.host() + "/a";
    const std::string far = "/vsicurl_streaming/" + url + ".tif";
    const std::string near = (oro::test::bundled_data() / "jacksboro.tif").string();
    const std::string wms =
        "<GDAL_WMS><Service name=\"TMS\"><ServerUrl>" + url +
        "/${z}/${x}/${y}</ServerUrl></Service><DataWindow><UpperLeftX>8</UpperLeftX><UpperLeftY>47</"
        "UpperLeftY>"
        "<LowerRightX>9</LowerRightX><LowerRightY>46</LowerRightY><TileLevel>2</TileLevel><SizeX>1024</SizeX>"
        "<SizeY>1024</SizeY></DataWindow><Projection>EPSG:4326</Projection><BandsCount>1</BandsCount></"
        "GDAL_WMS>";
    const std::string band = "<VRTRasterBand dataType=\"Float32\" band=\"1\">";
    std::string srs = vrt_of({near});
    srs.replace(srs.find("EPSG:4326"), 9, url);
    write_bytes(folder / "inner.vrt", vrt_of({far}));
    const std::vector<std::pair<std::string, std::string>> files{
        {"wms.tif", wms},
        {"wms.vrt", wms},
        {"wcs.tif",
         "<WCS_GDAL><ServiceURL>" + url + "?</ServiceURL><CoverageName>a</CoverageName></WCS_GDAL>"},
        {"wmts.tif", "<GDAL_WMTS><GetCapabilitiesUrl>" + url + "</GetCapabilitiesUrl></GDAL_WMTS>"},
        {"stac.tif",
         R"({"type":"Feature","stac_version":"1.0.0","stac_extensions":["tiled-assets"],"assets":{"a":{"href":")" +
             url + "\"}}}"},
        {"netcdf.nc", "DDS " + url},
        {"srs.vrt", srs},
        {"nested.vrt", vrt_of({(folder / "inner.vrt").string()})},
        {"mask.vrt", vrt_start + std::string("<MaskBand>") + band + source_of(far) +
                         "</VRTRasterBand></MaskBand>" + band + source_of(near) +
                         "</VRTRasterBand></VRTDataset>"},
        {"overview.vrt",
         vrt_start + band + source_of(near) + "<Overview><SourceFilename>" + far +
             "</SourceFilename><SourceBand>1</SourceBand></Overview></VRTRasterBand></VRTDataset>"},
        {"raw.vrt", vrt_start +
                        std::string("<VRTRasterBand dataType=\"Int16\" band=\"1\" "
                                    "subClass=\"VRTRawRasterBand\"><SourceFilename>") +
                        far + "</SourceFilename></VRTRasterBand></VRTDataset>"},
        {"warped.vrt",
         "<VRTDataset rasterXSize=\"20\" rasterYSize=\"20\" "
         "subClass=\"VRTWarpedDataset\"><SRS>EPSG:4326</SRS>"
         "<GeoTransform>8, 0.01, 0, 47, 0, -0.01</GeoTransform><VRTRasterBand dataType=\"Float32\" "
         "band=\"1\" "
         "subClass=\"VRTWarpedRasterBand\"/><GDALWarpOptions><SourceDataset relativeToVRT=\"0\">" +
             far + "</SourceDataset></GDALWarpOptions></VRTDataset>"},
        {"location.vrt", vrt_start + std::string("<Metadata domain=\"GEOLOCATION\"><MDI key=\"X_DATASET\">") +
                             far + "</MDI></Metadata>" + band + source_of(near) +
                             "</VRTRasterBand></VRTDataset>"}};
    for (const auto& [name, content] : files) {
        SCOPED_TRACE(name);
        write_bytes(folder / name, content);
        static_cast<void>(info(folder / name, lured));
        EXPECT_EQ(listener.callers(), 0);
    }
    // Side-cars of a sound raster.
    fs::copy_file(near, folder / "b.tif");
    const std::string near_asc =
        "ncols 3\nnrows 3\nxllcorner 8\nyllcorner 46\ncellsize 0.1\n1 2 3\n4 5 6\n7 8 9\n";
    write_bytes(folder / "c.asc", near_asc);
    write_bytes(folder / "c.prj", url + "\n");
    write_bytes(folder / "b.tif.aux.xml", "<PAMDataset><SRS>" + url + "</SRS></PAMDataset>");
    write_bytes(folder / "b.tif.msk", vrt_of({far}));
    write_bytes(folder / "b.tif.ovr", vrt_of({far}));
    for (const char* name : {"b.tif", "c.asc"}) static_cast<void>(info(folder / name, lured));
    EXPECT_EQ(listener.callers(), 0);
}

TEST_F(HostileSources, PipesAreNotWaitedFor) {
    const fs::path pipe = folder / "pipe", vrt = folder / "a.vrt", tif = folder / "b.tif";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    write_bytes(vrt, vrt_of({pipe}));
    expect_refused(vrt, "no regular file");
    write_bytes(vrt, vrt_of({"/vsizip/{" + pipe.string() + "}/a.tif"}));
    expect_refused(vrt, "no regular file");
    write_bytes(vrt, vrt_of({"/dev/zero"}));
    expect_refused(vrt, "no regular file");
    write_bytes(vrt, vrt_of({"/vsistdin/"}));
    expect_refused(vrt, "/vsistdin/");
    fs::copy_file(oro::test::bundled_data() / "jacksboro.tif", tif);
    ASSERT_EQ(mkfifo((folder / "b.tif.aux.xml").c_str(), 0600), 0);
    const Outcome outcome = info(tif);
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 1) << outcome.err;
}

// What a VRT is made of is as safe from --overwrite as the VRT, by any of its names.
TEST_F(HostileSources, OverwriteSparesAllThatSourcesAreMadeOf) {
    const fs::path tif = folder / "terrain.tif", inner = folder / "inner.vrt", vrt = folder / "a.vrt";
    fs::copy_file(oro::test::bundled_data() / "jacksboro.tif", tif);
    write_bytes(inner, vrt_of({tif}));
    write_bytes(vrt, vrt_of({inner}));
    fs::create_hard_link(tif, folder / "hard.tif");
    fs::create_symlink("terrain.tif", folder / "soft.tif");
    fs::create_hard_link(tif, folder / "hard.oro");
    fs::create_directory(folder / "report");
    fs::create_hard_link(tif, folder / "report" / "trade.csv");
    fs::create_hard_link(inner, folder / "inner.png");
    const std::string before = bytes_of(tif), before_inner = bytes_of(inner);
    for (const Words& words :
         {Words{"shot", vrt, "--out", tif}, Words{"shot", vrt, "--out", folder / "hard.tif"},
          Words{"shot", vrt, "--out", folder / "soft.tif"}, Words{"shot", vrt, "--out", folder / "inner.png"},
          Words{"bake", vrt, "--out", folder / "hard.oro"},
          Words{"trade", vrt, "--out", folder / "report", "--views", "1"}}) {
        SCOPED_TRACE(words[0] + " " + words[3]);
        Words all = words;
        all.insert(all.end(), {"--overwrite", "-q"});
        if (words[0] == "shot") all.insert(all.end(), {"--size", "64x48"});
        const Outcome outcome = run_orograph(all);
        EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
        EXPECT_NE(outcome.err.find("would replace"), std::string::npos) << outcome.err;
        EXPECT_EQ(bytes_of(tif), before);
        EXPECT_EQ(bytes_of(inner), before_inner);
        EXPECT_EQ(bytes_of(folder / "hard.oro"), before);
        EXPECT_EQ(bytes_of(folder / "report" / "trade.csv"), before);
    }
}

// Each names the one below it four times: 4^16 sources.
TEST_F(HostileSources, VrtsOfVrtsAreBounded) {
    const std::string near = (oro::test::bundled_data() / "jacksboro.tif").string();
    std::string below = near;
    for (int level = 1; level <= 16; ++level) {
        const std::string name = (folder / (std::to_string(level) + ".vrt")).string();
        write_bytes(name, vrt_of({below, below, below, below}));
        below = name;
    }
    expect_refused(below, "deep, which is the limit");
    EXPECT_EQ(info(folder / "4.vrt").exit_code, 0);
    // Not deep, and as many.
    write_bytes(folder / "1.vrt", vrt_of(Words(500, near)));
    write_bytes(folder / "2.vrt", vrt_of(Words(500, folder / "1.vrt")));
    expect_refused(folder / "2.vrt", "100000 sources, which is the limit");
    // Fewer, one over the other: each post of it asks them all.
    write_bytes(folder / "1.vrt", vrt_of(Words(100, near)));
    write_bytes(folder / "2.vrt", vrt_of(Words(100, folder / "1.vrt")));
    expect_refused(folder / "2.vrt", "16 times, which is the limit");
    write_bytes(folder / "self.vrt", vrt_of({folder / "self.vrt"}));
    expect_refused(folder / "self.vrt", "names itself");
}

}  // namespace
