#include "geo/pictures/picture.h"

#include <gdal.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <locale>
#include <string>
#include <vector>

#include "geo/pictures/picture_view.h"
#include "tests/geo/pictures/sample_picture.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;
using test::content;
using test::names_in;
using test::sample_tags;
using test::write_sample;

const std::array<std::string, 3> endings{"png", "jpg", "tif"};

void put(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

// Quotes, markup, entities, line ends, four-byte characters and 30 kB of it.
std::string long_view() {
    std::string view = "{\"paths\":[";
    for (int i = 0; view.size() < 30'000; ++i)
        view += "\"/data/<alps> & \\\"&amp;lt;\\\" ⛰ 𝄞/N" + std::to_string(i) + ".hgt\",\r\n\t";
    return view + "null]}";
}

TEST(Picture, FormatComesFromTheEnding) {
    for (const char* name :
         {"a.png", "b/A.PNG", "x.jpg", "x.jpeg", "x.JpEg", "x.tif", "x.TIFF", "a.b/c.d.png"})
        EXPECT_TRUE(picture_format(name).ok()) << name;
    EXPECT_EQ(*picture_format("a.png"), PictureFormat::png);
    EXPECT_EQ(*picture_format("a.jpeg"), PictureFormat::jpeg);
    EXPECT_EQ(*picture_format("a.tiff"), PictureFormat::tiff);
    for (const char* name : {"", "png", "a.gif", "a.png/b", "folder.png/", "a.png ", "a."}) {
        ASSERT_FALSE(picture_format(name).ok()) << name;
        EXPECT_EQ(picture_format(name).error().kind, ErrorKind::usage);
    }
}

std::vector<std::uint8_t> pixels_of(const fs::path& path) {
    GDALAllRegister();
    std::vector<std::uint8_t> pixels;
    const GDALDatasetH dataset = GDALOpen(path.c_str(), GA_ReadOnly);
    if (!dataset || GDALGetRasterCount(dataset) != 3) return pixels;
    const int width = GDALGetRasterXSize(dataset);
    const int height = GDALGetRasterYSize(dataset);
    pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
    const CPLErr fault = GDALDatasetRasterIO(dataset, GF_Read, 0, 0, width, height, pixels.data(), width,
                                             height, GDT_Byte, 3, nullptr, 3, 3 * width, 1);
    GDALClose(dataset);
    if (fault != CE_None) pixels.clear();
    return pixels;
}

TEST(Picture, HoldsThePixelsThatItWasGiven) {
    const fs::path folder = test::scratch_folder();
    std::vector<std::uint8_t> given;
    for (int row = 0; row < test::sample_height; ++row)
        for (const std::uint8_t value : test::sample_row(row)) given.push_back(value);
    for (const std::string& ending : endings) {
        const auto written = write_sample(folder / ("a." + ending), sample_tags());
        ASSERT_TRUE(written.ok()) << written.error().line();
        const std::vector<std::uint8_t> read = pixels_of(folder / ("a." + ending));
        ASSERT_EQ(read.size(), given.size()) << ending;
        int largest = 0;
        for (std::size_t i = 0; i < read.size(); ++i)
            largest = std::max(largest, std::abs(read[i] - given[i]));
        // JPEG at quality 92 keeps a gradient within a few of 255; the others keep every bit.
        EXPECT_LE(largest, ending == "jpg" ? 6 : 0) << ending;
    }
}

TEST(Picture, TakesAnySizeFromOnePixelOn) {
    const fs::path folder = test::scratch_folder();
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 300}, {5000, 1}, {333, 7}})
        for (const std::string& ending : endings) {
            Geotags tags = sample_tags();
            tags.width_px = width;
            tags.height_px = height;
            const auto written = write_sample(folder / ("a." + ending), tags, true);
            ASSERT_TRUE(written.ok()) << written.error().line();
            EXPECT_EQ(pixels_of(folder / ("a." + ending)).size(),
                      static_cast<std::size_t>(width * height * 3));
            EXPECT_TRUE(read_view_json(folder / ("a." + ending)).ok());
        }
}

TEST(Picture, RefusesSizesThatAFormatCannotHave) {
    const fs::path folder = test::scratch_folder();
    const struct {
        std::string name;
        int width;
        int height;
        std::string reason;
    } rows[] = {{"a.png", 0, 5, "0x5"},       {"a.tif", 5, -1, "5x-1"},
                {"a.jpg", 0, 0, "0x0"},       {"a.jpg", 65501, 5, "65500"},
                {"a.jpg", 5, 65501, "65500"}, {"a.png", 1'000'001, 5, "1000000"},
                {"a.gif", 5, 5, "ends in"}};
    for (const auto& row : rows) {
        Geotags tags = sample_tags();
        tags.width_px = row.width;
        tags.height_px = row.height;
        const auto picture = create_picture(folder / row.name, tags, false);
        ASSERT_FALSE(picture.ok());
        EXPECT_EQ(picture.error().kind, ErrorKind::usage);
        EXPECT_NE(picture.error().line().find(row.reason), std::string::npos) << picture.error().line();
    }
    EXPECT_TRUE(fs::is_empty(folder));
}

// Neither the clock nor the names, the time zone nor the locale show in the bytes.
TEST(Picture, SameInputGivesSameBytes) {
    struct German : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };
    const fs::path folder = test::scratch_folder();
    const fs::path other = test::scratch_folder();
    for (const std::string& ending : endings) {
        ASSERT_TRUE(write_sample(folder / ("a." + ending), sample_tags()).ok());
        const std::locale before = std::locale::global(std::locale(std::locale(), new German));
        setenv("TZ", "Pacific/Auckland", 1);
        tzset();
        const auto written = write_sample(other / ("another-name." + ending), sample_tags());
        unsetenv("TZ");
        tzset();
        std::locale::global(before);
        ASSERT_TRUE(written.ok());
        EXPECT_EQ(content(folder / ("a." + ending)), content(other / ("another-name." + ending))) << ending;
    }
}

TEST(Picture, GivesTheViewBack) {
    const fs::path folder = test::scratch_folder();
    for (const std::string& view :
         {std::string("{}"), std::string("&lt;<>&\"'\r\n]]></orograph:View>"), long_view()})
        for (const std::string& ending : endings) {
            Geotags tags = sample_tags();
            tags.view_json = view;
            ASSERT_TRUE(write_sample(folder / ("a." + ending), tags, true).ok());
            const auto read = read_view_json(folder / ("a." + ending));
            ASSERT_TRUE(read.ok()) << read.error().line();
            EXPECT_EQ(*read, view) << ending;
        }
}

TEST(Picture, ViewTooLongForAJpegIsRefused) {
    const fs::path folder = test::scratch_folder();
    Geotags tags = sample_tags();
    tags.view_json = std::string(70'000, 'v');
    const auto refused = create_picture(folder / "a.jpg", tags, false);
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().what.find("use PNG or TIFF"), std::string::npos) << refused.error().line();
    EXPECT_TRUE(fs::is_empty(folder));
    for (const char* name : {"a.png", "a.tif"}) {
        ASSERT_TRUE(write_sample(folder / name, tags).ok());
        EXPECT_EQ(*read_view_json(folder / name), tags.view_json);
    }
}

TEST(Picture, IsNotThereBeforeItIsFinished) {
    for (const std::string& ending : endings) {
        const fs::path folder = test::scratch_folder();
        const std::string name = "a." + ending;
        put(folder / name, "old");
        {
            auto picture = create_picture(folder / name, sample_tags(), true);
            ASSERT_TRUE(picture.ok()) << picture.error().line();
            for (int row = 0; row < 40; ++row) ASSERT_TRUE((*picture)->write_row(test::sample_row(row)).ok());
            EXPECT_EQ(content(folder / name), "old");
        }
        EXPECT_EQ(names_in(folder), std::vector<std::string>{name});
        auto short_of_rows = create_picture(folder / name, sample_tags(), true);
        ASSERT_TRUE(short_of_rows.ok());
        ASSERT_TRUE((*short_of_rows)->write_row(test::sample_row(0)).ok());
        const auto finished = (*short_of_rows)->finish();
        ASSERT_FALSE(finished.ok());
        EXPECT_NE(finished.error().what.find("1 of 75 rows"), std::string::npos) << finished.error().line();
        EXPECT_EQ(names_in(folder), std::vector<std::string>{name});
        EXPECT_EQ(content(folder / name), "old");
        const auto refused = create_picture(folder / name, sample_tags(), false);
        ASSERT_FALSE(refused.ok());
        EXPECT_EQ(content(folder / name), "old");
    }
}

TEST(Picture, RefusesRowsThatDoNotFit) {
    for (const std::string& ending : endings) {
        const fs::path folder = test::scratch_folder();
        auto narrow = create_picture(folder / ("a." + ending), sample_tags(), false);
        ASSERT_TRUE(narrow.ok());
        EXPECT_FALSE((*narrow)->write_row(std::vector<std::uint8_t>(5)).ok());
        EXPECT_TRUE(fs::is_empty(folder));
        EXPECT_FALSE((*narrow)->write_row(test::sample_row(0)).ok());
        EXPECT_FALSE((*narrow)->finish().ok());
        auto tall = create_picture(folder / ("a." + ending), sample_tags(), false);
        ASSERT_TRUE(tall.ok());
        for (int row = 0; row < test::sample_height; ++row)
            ASSERT_TRUE((*tall)->write_row(test::sample_row(row)).ok());
        EXPECT_FALSE((*tall)->write_row(test::sample_row(0)).ok());
        EXPECT_TRUE(fs::is_empty(folder));
    }
}

// A limit on the size of files fails in write(2) as a full disk does; it is met in the header, between rows,
// and at the end. Noise, so that no encoder makes the picture smaller than the limits.
TEST(Picture, FullDiskLeavesTheOldFileAndNoOther) {
    struct rlimit before {};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    Geotags tags = sample_tags();
    tags.width_px = 300;
    tags.height_px = 200;
    for (const std::string& ending : endings) {
        const fs::path folder = test::scratch_folder();
        const std::string name = "a." + ending;
        ASSERT_TRUE(write_sample(folder / name, tags, false, true).ok());
        const auto size = static_cast<rlim_t>(fs::file_size(folder / name));
        ASSERT_GT(size, 60'000U);
        put(folder / name, "old");
        for (const rlim_t limit : {rlim_t{0}, rlim_t{100}, rlim_t{3000}, rlim_t{5000}, rlim_t{30'000},
                                   size / 2, size - 5000, size - 100, size - 1}) {
            const struct rlimit small { limit, before.rlim_max };
            ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
            const auto written = write_sample(folder / name, tags, true, true);
            ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
            ASSERT_FALSE(written.ok()) << ending << ' ' << limit;
            EXPECT_EQ(written.error().kind, ErrorKind::failed);
            const std::string line = written.error().line();
            EXPECT_EQ(line, (folder / name).string() + ": cannot be written: File too large")
                << ending << ' ' << limit;
            EXPECT_EQ(names_in(folder), std::vector<std::string>{name}) << limit;
            EXPECT_EQ(content(folder / name), "old") << limit;
        }
        EXPECT_TRUE(write_sample(folder / name, tags, true, true).ok());
    }
}

TEST(Picture, CutOffFilesGiveTheViewOrOneLine) {
    const fs::path folder = test::scratch_folder();
    Geotags tags = sample_tags();
    tags.view_json = long_view();
    for (const std::string& ending : endings) {
        ASSERT_TRUE(write_sample(folder / ("whole." + ending), tags, false, true).ok());
        const std::string whole = content(folder / ("whole." + ending));
        int views = 0;
        const fs::path cut = folder / ("whole." + ending);
        for (std::size_t size = (whole.size() - 1) / 100 * 100; size > 0; size -= 100) {
            fs::resize_file(cut, size);
            const auto read = read_view_json(cut);
            if (read.ok()) {
                ++views;
                EXPECT_EQ(*read, tags.view_json) << ending << ' ' << size;
            } else {
                EXPECT_EQ(read.error().kind, ErrorKind::failed);
                EXPECT_EQ(read.error().line().find('\n'), std::string::npos);
            }
        }
        // A TIFF's directory stands at its end.
        if (ending == "tif")
            EXPECT_EQ(views, 0);
        else
            EXPECT_GT(views, 0) << ending;
    }
}

class MemoryBytes final : public PictureBytes {
  public:
    explicit MemoryBytes(const std::string& bytes) : bytes_(bytes) {}
    [[nodiscard]] std::uint64_t size() const override { return bytes_.size(); }
    bool read(std::uint64_t offset, void* to, std::size_t count) override {
        EXPECT_LE(offset + count, bytes_.size());
        std::memcpy(to, bytes_.data() + offset, count);
        return true;
    }

  private:
    const std::string& bytes_;
};

// One byte changed anywhere: no crash, and in a PNG, whose chunks carry sums, never another view.
TEST(Picture, ChangedBytesNeverCrash) {
    const fs::path folder = test::scratch_folder();
    for (const std::string& ending : endings) {
        ASSERT_TRUE(write_sample(folder / ("whole." + ending), sample_tags()).ok());
        const std::string whole = content(folder / ("whole." + ending));
        for (std::size_t at = 0; at < whole.size(); at += 3)
            for (const char mask : {'\x01', '\x80', '\xFF'}) {
                std::string changed = whole;
                changed[at] = static_cast<char>(changed[at] ^ mask);
                MemoryBytes bytes(changed);
                const auto read = find_view_json(bytes, "changed");
                if (read.ok() && ending == "png") {
                    EXPECT_EQ(*read, sample_tags().view_json) << at;
                }
            }
    }
}

TEST(Picture, FilesWithoutAViewSaySo) {
    const fs::path folder = test::scratch_folder();
    put(folder / "empty", "");
    put(folder / "text.png", "a text file");
    put(folder / "short.png", "\x89PNG\r\n\x1a\n");
    const std::string header("\x89PNG\r\n\x1a\n\0\0\0\0IEND\xae\x42\x60\x82", 20);
    put(folder / "none.png", header);
    put(folder / "scan.jpg", std::string("\xFF\xD8\xFF\xDA\0\2", 6));
    put(folder / "nothing.jpg", "\xFF\xD8\xFF");
    put(folder / "tiny.tif", std::string("II*\0\xFF\xFF\xFF\xFF", 8));
    fs::create_directory(folder / "folder.png");
    const struct {
        std::string name;
        std::string reason;
    } rows[] = {{"empty", "no PNG, JPEG or TIFF"},
                {"text.png", "no PNG, JPEG or TIFF"},
                {"short.png", "carries no view"},
                {"none.png", "carries no view"},
                {"scan.jpg", "carries no view"},
                {"nothing.jpg", "is damaged at byte 2"},
                {"tiny.tif", "is damaged at byte 4"},
                {"folder.png", "is a folder"},
                {"missing.png", "No such file or directory"}};
    for (const auto& row : rows) {
        const auto read = read_view_json(folder / row.name);
        ASSERT_FALSE(read.ok()) << row.name;
        EXPECT_NE(read.error().line().find(row.reason), std::string::npos) << read.error().line();
        EXPECT_TRUE(read.error().line().starts_with((folder / row.name).string())) << read.error().line();
    }
    const fs::path elevation = test::bundled_data() / "jacksboro.tif";
    if (fs::exists(elevation)) {
        const auto read = read_view_json(elevation);
        ASSERT_FALSE(read.ok());
        EXPECT_NE(read.error().line().find("carries no view of Orograph"), std::string::npos)
            << read.error().line();
    }
}

}  // namespace
}  // namespace oro
