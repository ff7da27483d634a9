// What photographs tell of where they were taken from: our own pictures, and EXIF byte by byte.
#include "geo/pictures/photograph_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "geo/pictures/geotags_exif.h"
#include "tests/geo/pictures/sample_picture.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

std::string written_photograph(const std::string& name, const std::string& bytes) {
    const fs::path file = test::scratch_folder() / name;
    std::ofstream(file, std::ios::binary) << bytes;
    return file.string();
}

// A JPEG of tags alone.
std::string jpeg_with(const std::string& exif, const std::string& xmp = "") {
    const auto segment = [](const std::string& content) {
        const std::size_t length = content.size() + 2;
        return std::string("\xFF\xE1") + static_cast<char>(length >> 8U) + static_cast<char>(length & 255U) +
               content;
    };
    std::string jpeg = "\xFF\xD8";
    if (!exif.empty()) jpeg += segment(std::string("Exif\0\0", 6) + exif);
    if (!xmp.empty()) jpeg += segment(std::string("http://ns.adobe.com/xap/1.0/\0", 29) + xmp);
    return jpeg + std::string("\xFF\xDA\0\x02", 4);
}

// An EXIF block as exif_block() writes it.
std::string block_of(const ExifFields& fields) {
    const auto block = exif_block(fields);
    EXPECT_TRUE(block.ok());
    return {block->begin(), block->end()};
}

ExifField fractions(std::uint16_t tag, ExifRationals values) {
    return {tag, ExifType::rational, std::move(values)};
}
ExifField words(std::uint16_t tag, const std::string& text) {
    return {tag, ExifType::ascii, text};
}

// 46 34' 39.5" N, 8 0' 18" W, 3,967 m above sea level, at the moment, to the south-west by compass.
ExifFields telephones() {
    ExifFields fields;
    fields.image = {{0x0112, ExifType::short_integer, std::vector<std::uint32_t>{6}}};  // shown upright
    fields.photo = {words(0x9003, "2024:06:07 14:34:56"),
                    words(0x9011, "+02:00"),
                    {0xA002, ExifType::long_integer, std::vector<std::uint32_t>{4000}},
                    {0xA003, ExifType::long_integer, std::vector<std::uint32_t>{3000}},
                    {0xA405, ExifType::short_integer, std::vector<std::uint32_t>{26}}};
    fields.gps = {words(1, "N"),
                  fractions(2, {{46, 1}, {34, 1}, {395, 10}}),
                  words(3, "W"),
                  fractions(4, {{8, 1}, {0, 1}, {18, 1}}),
                  {5, ExifType::byte, std::vector<std::uint8_t>{0}},
                  fractions(6, {{3967, 1}}),
                  words(16, "M"),
                  fractions(17, {{225, 1}}),
                  words(18, "TOKYO")};
    return fields;
}

TEST(PhotographView, OurOwnPicturesComeBack) {
    const Geotags tags = test::sample_tags();
    for (const char* const name : {"a.png", "a.jpg", "a.tif"}) {
        const fs::path file = test::scratch_folder() / name;
        ASSERT_TRUE(test::write_sample(file, tags).ok());
        const auto view = photograph_view(file.string());
        ASSERT_TRUE(view.ok()) << view.error().line();
        EXPECT_NEAR(view->lat_deg, tags.lat_deg, 1e-10) << name;
        EXPECT_NEAR(view->lon_deg, tags.lon_deg, 1e-10);
        EXPECT_NEAR(view->height_m.value(), tags.H_m, 1e-4);
        EXPECT_FALSE(view->is_height_ellipsoidal);
        EXPECT_NEAR(view->heading_deg.value(), tags.heading_deg, 1e-4);
        EXPECT_EQ(view->pitch_deg, tags.pitch_deg);
        EXPECT_EQ(view->roll_deg, tags.roll_deg);
        EXPECT_EQ(view->vertical_fov_deg, tags.vertical_fov_deg);
        EXPECT_EQ(view->width_px, test::sample_width);
        EXPECT_EQ(view->height_px, test::sample_height);
        EXPECT_EQ(view->time_utc_s, tags.time_utc_s);
        EXPECT_TRUE(view->notes.empty());
    }
}

TEST(PhotographView, OfACamera) {
    const auto view = photograph_view(written_photograph("p.jpg", jpeg_with(block_of(telephones()))));
    ASSERT_TRUE(view.ok()) << view.error().line();
    EXPECT_NEAR(view->lat_deg, 46.0 + 34.0 / 60 + 39.5 / 3600, 1e-12);
    EXPECT_NEAR(view->lon_deg, -8.005, 1e-12);
    EXPECT_EQ(view->height_m, 3967.0);
    EXPECT_EQ(view->heading_deg, 225.0);
    EXPECT_FALSE(view->pitch_deg);
    EXPECT_EQ(view->width_px, 3000) << "it is turned upright";
    EXPECT_EQ(view->height_px, 4000);
    // tan = 43.2666 mm / 2 / 26 mm * 4000 / 5000.
    EXPECT_NEAR(view->vertical_fov_deg.value(),
                2.0 * std::atan(0.5 * 43.26661530 / 26.0 * 0.8) * 180.0 / M_PI, 1e-6);
    EXPECT_EQ(view->time_utc_s, 1717763696) << "2024-06-07T12:34:56Z";
    ASSERT_EQ(view->notes.size(), 2U);
    EXPECT_NE(view->notes[0].find("datum 'TOKYO'"), std::string::npos);
    EXPECT_NE(view->notes[1].find("magnetic"), std::string::npos);
}

TEST(PhotographView, TheSensorTellsTheAngleMoreFinely) {
    ExifFields fields = telephones();
    fields.image.clear();
    // 3000 rows, 1250 a centimetre: 24 mm; before 35 mm of focal length. 36 x 24 mm film has 35 mm, too.
    fields.photo = {fractions(0x920A, {{352, 10}}),
                    {0xA002, ExifType::long_integer, std::vector<std::uint32_t>{4500}},
                    {0xA003, ExifType::long_integer, std::vector<std::uint32_t>{3000}},
                    fractions(0xA20E, {{1250, 1}}),
                    fractions(0xA20F, {{1250, 1}}),
                    {0xA210, ExifType::short_integer, std::vector<std::uint32_t>{3}},
                    {0xA405, ExifType::short_integer, std::vector<std::uint32_t>{35}}};
    const auto fov_deg = [&] {
        return photograph_view(written_photograph("p.jpg", jpeg_with(block_of(fields))))
            ->vertical_fov_deg.value();
    };
    EXPECT_NEAR(fov_deg(), 2.0 * std::atan(12.0 / 35.2) * 180.0 / M_PI, 1e-6);
    // Made smaller by a program that left the resolution as it was: no such sensor.
    fields.photo[1] = {0xA002, ExifType::long_integer, std::vector<std::uint32_t>{1500}};
    fields.photo[2] = {0xA003, ExifType::long_integer, std::vector<std::uint32_t>{1000}};
    EXPECT_NEAR(fov_deg(), 2.0 * std::atan(12.0 / 35.0) * 180.0 / M_PI, 1e-6);
}

TEST(PhotographView, XmpOfADroneTellsPitchAndRoll) {
    ExifFields fields = telephones();
    std::erase_if(fields.gps, [](const ExifField& field) { return field.tag == 16 || field.tag == 17; });
    const std::string xmp =
        "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
        "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">"
        "<rdf:Description xmlns:drone-dji=\"http://www.dji.com/drone-dji/1.0/\" "
        "drone-dji:GimbalYawDegree=\"-60.50\" drone-dji:GimbalPitchDegree=\"-20.10\" "
        "drone-dji:GimbalRollDegree=\"+0.00\"/></rdf:RDF></x:xmpmeta>";
    const auto view = photograph_view(written_photograph("p.jpg", jpeg_with(block_of(fields), xmp)));
    ASSERT_TRUE(view.ok()) << view.error().line();
    EXPECT_EQ(view->heading_deg, 299.5);
    EXPECT_EQ(view->pitch_deg, -20.1);
    EXPECT_EQ(view->roll_deg, 0.0);
}

TEST(PhotographView, WithoutAPlaceIsOneLine) {
    const auto fault = [](const std::string& bytes) {
        const std::string file = written_photograph("p.jpg", bytes);
        const auto view = photograph_view(file);
        EXPECT_FALSE(view.ok());
        if (view.ok()) return std::string();
        EXPECT_EQ(view.error().kind, ErrorKind::failed);
        EXPECT_EQ(view.error().where, file);
        return view.error().what;
    };
    ExifFields fields = telephones();
    fields.gps.clear();
    EXPECT_EQ(fault(jpeg_with(block_of(fields))),
              "does not tell where it was taken: its EXIF has no GPS position");
    EXPECT_EQ(fault(jpeg_with("")), "does not tell where it was taken: it has no EXIF");
    fields = telephones();
    fields.gps[1] = fractions(2, {{0, 0}, {0, 0}, {0, 0}});  // what telephones write that know of none
    EXPECT_EQ(fault(jpeg_with(block_of(fields))),
              "does not tell where it was taken: its GPS position is none");
    fields.gps[1] = fractions(2, {{91, 1}, {0, 1}, {0, 1}});
    EXPECT_EQ(fault(jpeg_with(block_of(fields))),
              "does not tell where it was taken: its GPS position is none");
    EXPECT_EQ(fault("text"), "is no JPEG, PNG or TIFF picture");
    EXPECT_EQ(fault(""), "is no JPEG, PNG or TIFF picture");
    EXPECT_EQ(fault(jpeg_with("nothing")), "its EXIF is damaged: it has no directory");
    EXPECT_NE(fault("\xFF\xD8\xFF\xE0\x10\x10").find("the JPEG ends before its picture"), std::string::npos);
    EXPECT_FALSE(photograph_view((test::scratch_folder() / "none.jpg").string()).ok());
}

// Bytes changed and cut by chance: an answer or an error, and nothing else (sanitizers watch).
TEST(PhotographView, DamagedOnesEndInOrder) {
    const unsigned seed = std::random_device{}();
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const std::string whole = jpeg_with(block_of(telephones()));
    for (int i = 0; i < 500; ++i) {
        std::string damaged = whole;
        for (std::size_t j = 0, count = 1 + random() % 4; j < count; ++j)
            damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
        if (random() % 4 == 0) damaged.resize(random() % damaged.size());
        const auto view = photograph_view(written_photograph("p.jpg", damaged));
        if (!view.ok()) continue;
        EXPECT_LE(std::abs(view->lat_deg), 90.0);
        EXPECT_LE(std::abs(view->lon_deg), 180.0);
        EXPECT_LT(view->vertical_fov_deg.value_or(0.0), 180.0);
    }
}

}  // namespace
}  // namespace oro
