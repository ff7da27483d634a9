// The tags as another program reads them: exiftool, an implementation that shares nothing with libexif and
// libtiff.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "geo/pictures/geotags_exif.h"
#include "geo/pictures/picture.h"
#include "tests/geo/pictures/sample_picture.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;
using test::sample_tags;
using test::write_sample;

const std::array<std::string, 3> endings{"png", "jpg", "tif"};

std::string output_of(const std::string& command) {
    std::string output;
    std::FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
    if (!pipe) return output;
    std::array<char, 4096> buffer{};
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
        output.append(buffer.data(), count);
    pclose(pipe);
    return output;
}

bool has_exiftool() {
    static const bool has = !output_of("exiftool -ver").empty() && output_of("exiftool -ver").front() != 's';
    return has;
}

#define NEEDS_EXIFTOOL() \
    if (!has_exiftool()) GTEST_SKIP() << "needs exiftool (libimage-exiftool-perl)"

// What exiftool says of each file, by the file's name.
std::map<std::string, nlohmann::json> tags_in(const fs::path& folder) {
    std::map<std::string, nlohmann::json> tags;
    const auto files = nlohmann::json::parse(output_of("exiftool -q -n -j -G1 -a '" + folder.string() + "'"));
    for (const auto& file : files) tags[fs::path(file.at("SourceFile").get<std::string>()).filename()] = file;
    return tags;
}

double as_number(const nlohmann::json& value) {
    return value.is_number() ? value.get<double>() : std::stod(value.get<std::string>());
}

struct Case {
    std::string name;
    Geotags tags;
    std::string lat_ref;
    std::string lon_ref;
    double direction_deg;  // as it must be read
};

Geotags standing_at(double lat_deg, double lon_deg, double H_m, double heading_deg) {
    Geotags tags = sample_tags();
    tags.lat_deg = lat_deg;
    tags.lon_deg = lon_deg;
    tags.H_m = H_m;
    tags.heading_deg = heading_deg;
    tags.destination = DestinationTag{-lat_deg, -lon_deg, heading_deg, 1.0e6 + std::abs(H_m)};
    return tags;
}

std::vector<Case> cases() {
    return {
        {"eiger", sample_tags(), "N", "E", 200.12345},
        {"ushuaia", standing_at(-54.8069123456, -68.3043123456, 5.5, 0), "S", "W", 0},
        {"dead_sea", standing_at(31.5, 35.5, -430.1234, 89.9999), "N", "E", 89.9999},
        {"fiji_180", standing_at(-16.5, 180, 0, 359.99999), "S", "E", 0},  // rounds to 360, which is 0
        {"minus_180", standing_at(16.5, -180, 0.00004, 359.9999), "N", "W", 359.9999},
        {"north_pole", standing_at(90, 0, 2, 180), "N", "E", 180},
        {"south_pole", standing_at(-90, 123.456789012, 2835, 12.3456), "S", "E", 12.3456},
        {"carry", standing_at(45.99999999999999, -7.999999999999999, 8848.86, 1e-9), "N", "W", 0},
        {"orbit", standing_at(0, 0, 400'000'000.3, 270), "N", "E", 270},
        {"tiny", standing_at(-1e-9, -1e-9, -0.0004, 45), "S", "W", 45},
    };
}

void expect_position(const nlohmann::json& read, const std::string& prefix, double lat_deg, double lon_deg) {
    // 1e-7 second of arc, and libtiff's fractions.
    EXPECT_NEAR(as_number(read.at("Composite:GPS" + prefix + "Latitude")), lat_deg, 1e-9);
    EXPECT_NEAR(as_number(read.at("Composite:GPS" + prefix + "Longitude")), lon_deg, 1e-9);
}

void expect_exif(const nlohmann::json& read, const Case& expected) {
    const Geotags& tags = expected.tags;
    EXPECT_EQ(read.at("GPS:GPSVersionID"), "2 3 0 0");
    EXPECT_EQ(read.at("GPS:GPSLatitudeRef"), expected.lat_ref);
    EXPECT_EQ(read.at("GPS:GPSLongitudeRef"), expected.lon_ref);
    expect_position(read, "", tags.lat_deg, tags.lon_deg);
    // 0.05 mm below 429 km, then 50 mm, which libtiff's fractions make 100 mm.
    EXPECT_NEAR(as_number(read.at("Composite:GPSAltitude")), tags.H_m,
                std::abs(tags.H_m) < 1e5 ? 6e-5 : 0.11);
    EXPECT_EQ(read.at("GPS:GPSAltitudeRef"), tags.H_m < -5e-5 ? 1 : 0);
    EXPECT_EQ(read.at("GPS:GPSImgDirectionRef"), "T");
    EXPECT_NEAR(as_number(read.at("GPS:GPSImgDirection")), expected.direction_deg, 5.1e-5);
    EXPECT_LT(as_number(read.at("GPS:GPSImgDirection")), 360);
    EXPECT_EQ(read.at("GPS:GPSMapDatum"), "WGS-84");
    expect_position(read, "Dest", tags.destination->lat_deg, tags.destination->lon_deg);
    EXPECT_EQ(read.at("GPS:GPSDestBearingRef"), "T");
    const double bearing_deg = expected.name == "eiger" ? 202.4567 : expected.direction_deg;
    EXPECT_NEAR(as_number(read.at("GPS:GPSDestBearing")), bearing_deg, 5.1e-5);
    EXPECT_EQ(read.at("GPS:GPSDestDistanceRef"), "K");
    const double distance_km = tags.destination->distance_m / 1000;
    EXPECT_NEAR(as_number(read.at("GPS:GPSDestDistance")), distance_km, std::max(6e-7, 2e-9 * distance_km));
    EXPECT_EQ(read.at("GPS:GPSDateStamp"), "2024:06:07");
    EXPECT_EQ(read.at("GPS:GPSTimeStamp"), "12:34:56");
    EXPECT_EQ(read.at("GPS:GPSProcessingMethod"), "MANUAL");
    EXPECT_EQ(read.at("ExifIFD:DateTimeOriginal"), "2024:06:07 12:34:56");
    EXPECT_EQ(read.at("ExifIFD:OffsetTimeOriginal"), "+00:00");
    // 120 x 75 pixels, 40 degrees: sqrt(36^2 + 24^2) / 2 / (tan 20 * sqrt(120^2 + 75^2) / 75) = 31.50 mm
    EXPECT_EQ(read.at("ExifIFD:FocalLengthIn35mmFormat"), 32);
    // Whole millimetres are half a degree off; these fields are not.
    EXPECT_EQ(read.at("ExifIFD:FocalPlaneResolutionUnit"), 3) << "centimetres";
    const double frame_mm = 10 * 75 / as_number(read.at("ExifIFD:FocalPlaneYResolution"));
    const double focal_mm = as_number(read.at("ExifIFD:FocalLength"));
    EXPECT_NEAR(focal_mm, 31.50156, 1e-5);
    EXPECT_NEAR(2 * std::atan(frame_mm / 2 / focal_mm) * 180 / M_PI, 40.0, 1e-6);
    EXPECT_EQ(read.at("ExifIFD:FocalPlaneXResolution"), read.at("ExifIFD:FocalPlaneYResolution"));
    EXPECT_EQ(read.at("ExifIFD:ColorSpace"), 1);
    EXPECT_EQ(read.at("IFD0:Software"), "Orograph 0.1.0");
    EXPECT_EQ(read.at("IFD0:Copyright"), tags.attribution);
    EXPECT_EQ(read.at("Composite:ImageSize"), "120 75");
}

void expect_xmp(const nlohmann::json& read, const Geotags& tags) {
    EXPECT_EQ(as_number(read.at("XMP-orograph:Yaw")), tags.heading_deg);
    EXPECT_EQ(as_number(read.at("XMP-orograph:Pitch")), -5.25);
    EXPECT_EQ(as_number(read.at("XMP-orograph:Roll")), 0.125);
    EXPECT_EQ(as_number(read.at("XMP-orograph:VerticalFieldOfView")), 40);
    EXPECT_EQ(as_number(read.at("XMP-orograph:OrthometricHeight")), tags.H_m);
    EXPECT_EQ(as_number(read.at("XMP-orograph:EllipsoidalHeight")), 2517.8034);
    EXPECT_EQ(as_number(read.at("XMP-orograph:GeoidUndulation")), 50.68);
    EXPECT_EQ(read.at("XMP-orograph:Geoid"), "EGM96 (egm96_15.gtx)");
    EXPECT_EQ(read.at("XMP-dc:Rights"), tags.attribution);
    EXPECT_EQ(read.at("XMP-xmp:CreatorTool"), "Orograph 0.1.0");
    EXPECT_EQ(read.at("XMP-xmp:CreateDate"), "2024:06:07 12:34:56Z");
    EXPECT_EQ(read.at("XMP-orograph:View"), tags.view_json);
}

TEST(Geotags, AreWhatExiftoolReads) {
    NEEDS_EXIFTOOL();
    const fs::path folder = test::scratch_folder();
    for (const Case& picture : cases())
        for (const std::string& ending : endings) {
            const auto written = write_sample(folder / (picture.name + "." + ending), picture.tags);
            ASSERT_TRUE(written.ok()) << written.error().line();
        }
    auto read = tags_in(folder);
    for (const Case& picture : cases())
        for (const std::string& ending : endings) {
            const std::string name = picture.name + "." + ending;
            SCOPED_TRACE(name);
            ASSERT_TRUE(read.count(name));
            ASSERT_NO_THROW(expect_exif(read[name], picture)) << read[name].dump(1);
            ASSERT_NO_THROW(expect_xmp(read[name], picture.tags)) << read[name].dump(1);
        }
}

TEST(Geotags, LeaveOutWhatIsNotKnown) {
    NEEDS_EXIFTOOL();
    const fs::path folder = test::scratch_folder();
    Geotags tags = sample_tags();
    tags.destination.reset();
    tags.attribution.clear();
    for (const std::string& ending : endings) ASSERT_TRUE(write_sample(folder / ("a." + ending), tags).ok());
    for (const auto& [name, read] : tags_in(folder)) {
        SCOPED_TRACE(name);
        EXPECT_TRUE(read.contains("GPS:GPSLatitude"));
        for (const char* absent : {"GPS:GPSDestLatitude", "GPS:GPSDestLongitude", "GPS:GPSDestBearing",
                                   "GPS:GPSDestDistance", "IFD0:Copyright", "XMP-dc:Rights"})
            EXPECT_FALSE(read.contains(absent)) << absent;
    }
}

TEST(Geotags, AreValid) {
    NEEDS_EXIFTOOL();
    const fs::path folder = test::scratch_folder();
    for (const std::string& ending : endings) {
        const fs::path file = folder / ("a." + ending);
        ASSERT_TRUE(write_sample(file, sample_tags()).ok());
        const std::string report =
            output_of("exiftool -q -validate -warning -error -a -s3 '" + file.string() + "'");
        // Adobe's deflate (8) came after TIFF 6.0, whose list exiftool checks; every TIFF library has it.
        const std::string expected =
            ending == "tif" ? "1 Warning\nInvalid value for IFD0 tag 0x0103 Compression\n" : "OK\n";
        EXPECT_EQ(report, expected) << ending;
    }
}

TEST(Geotags, SurviveAnotherProgramsEdit) {
    NEEDS_EXIFTOOL();
    const fs::path folder = test::scratch_folder();
    for (const std::string& ending : endings) {
        const fs::path file = folder / ("a." + ending);
        ASSERT_TRUE(write_sample(file, sample_tags()).ok());
        output_of("exiftool -q -overwrite_original -XMP-dc:Title='<First> & more' '" + file.string() + "'");
        ASSERT_NE(test::content(file).find("&lt;First&gt;"), std::string::npos);
        const auto view = read_view_json(file);
        ASSERT_TRUE(view.ok()) << view.error().line();
        EXPECT_EQ(*view, sample_tags().view_json) << ending;
    }
}

const ExifField* find(const std::vector<ExifField>& fields, std::uint16_t tag) {
    for (const ExifField& field : fields)
        if (field.tag == tag) return &field;
    return nullptr;
}

std::vector<ExifRational> rationals(const std::vector<ExifField>& fields, std::uint16_t tag) {
    const ExifField* const field = find(fields, tag);
    return field ? std::get<ExifRationals>(field->value) : ExifRationals{};
}

// Without exiftool, by hand: 7.99999999999999 degrees are 7 d 59' 59.99999999996", which carries to 8 0' 0".
TEST(Geotags, SecondsNeverReachSixty) {
    Geotags tags = sample_tags();
    tags.lat_deg = 7.99999999999999;
    tags.lon_deg = -0.5 - 1.0 / 3600;
    const auto fields = exif_fields(tags);
    ASSERT_TRUE(fields.ok());
    const auto lat = rationals(fields->gps, 2);
    ASSERT_EQ(lat.size(), 3U);
    EXPECT_EQ(lat[0].numerator, 8U);
    EXPECT_EQ(lat[1].numerator, 0U);
    EXPECT_EQ(lat[2].numerator, 0U);
    const auto lon = rationals(fields->gps, 4);
    ASSERT_EQ(lon.size(), 3U);
    EXPECT_EQ(lon[0].numerator, 0U);
    EXPECT_EQ(lon[1].numerator, 30U);
    EXPECT_EQ(lon[2].numerator, 10'000'000U);
    EXPECT_EQ(lon[2].denominator, 10'000'000U);
}

TEST(Geotags, DirectionsTurnIntoTheCircle) {
    const struct {
        double heading_deg;
        std::uint32_t ten_thousandths;
    } rows[] = {
        {0, 0},     {-90, 2'700'000}, {360, 0},  {720.5, 5'000}, {359.99999, 0}, {359.99994, 3'599'999},
        {-1e-9, 0}, {-0.0, 0},        {1e-5, 0}, {6e-5, 1}};
    for (const auto& row : rows) {
        Geotags tags = sample_tags();
        tags.heading_deg = row.heading_deg;
        const auto direction = rationals(exif_fields(tags)->gps, 17);
        ASSERT_EQ(direction.size(), 1U);
        EXPECT_EQ(direction[0].numerator, row.ten_thousandths) << row.heading_deg;
        EXPECT_EQ(direction[0].denominator, 10'000U);
    }
}

// A 50 mm lens sees 26.99 degrees over 24 mm and 46.79 over the diagonal; a square picture of the same
// diagonal angle has the same equivalent.
// A cylinder has no angle of view that a lens could have.
TEST(Geotags, PanoramasHaveNoFocalLength) {
    Geotags tags;
    tags.vertical_fov_deg = 20.0;
    tags.width_px = 900;
    tags.height_px = 300;
    const auto numbers = [&] {
        std::vector<int> all;
        const auto fields = exif_fields(tags);
        EXPECT_TRUE(fields.ok());
        for (const ExifField& field : fields->photo) all.push_back(field.tag);
        return all;
    };
    const std::vector<int> of_plane = numbers();
    EXPECT_NE(std::find(of_plane.begin(), of_plane.end(), 0x920A), of_plane.end());
    tags.panorama = PanoramaTag{360.0, 100, 0, 300};
    const std::vector<int> of_cylinder = numbers();
    EXPECT_EQ(of_cylinder.size() + 5, of_plane.size());
    for (const int lens : {0x920A, 0xA20E, 0xA20F, 0xA210, 0xA405})
        EXPECT_EQ(std::find(of_cylinder.begin(), of_cylinder.end(), lens), of_cylinder.end()) << lens;
}

TEST(Geotags, FocalLengthIsByTheDiagonal) {
    EXPECT_NEAR(focal_length_35mm(26.9915, 3000, 2000), 50, 1e-3);
    EXPECT_NEAR(focal_length_35mm(26.9915, 300, 200), 50, 1e-3);
    const double square_fov_deg =
        2 * std::atan(std::tan(46.7930 / 2 * M_PI / 180) / std::sqrt(2.0)) * 180 / M_PI;
    EXPECT_NEAR(focal_length_35mm(square_fov_deg, 1000, 1000), 50, 1e-3);
}

TEST(Geotags, TimesAreUtcOverAllYears) {
    const struct {
        std::int64_t time_utc_s;
        std::string text;
    } rows[] = {{0, "1970:01:01 00:00:00"},
                {951782400, "2000:02:29 00:00:00"},
                {-1, "1969:12:31 23:59:59"},
                {4102444800, "2100:01:01 00:00:00"},
                {-62167219200, "0000:01:01 00:00:00"},
                {253402300799, "9999:12:31 23:59:59"}};
    for (const auto& row : rows) {
        Geotags tags = sample_tags();
        tags.time_utc_s = row.time_utc_s;
        const auto fields = exif_fields(tags);
        ASSERT_TRUE(fields.ok());
        EXPECT_EQ(std::get<std::string>(find(fields->photo, 0x9003)->value), row.text);
    }
}

TEST(Geotags, RefuseWhatCannotBe) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const fs::path folder = test::scratch_folder();
    const auto refused = [&](const std::string& reason, auto&& spoil) {
        Geotags tags = sample_tags();
        spoil(tags);
        for (const std::string& ending : endings) {
            const auto picture = create_picture(folder / ("a." + ending), tags, false);
            ASSERT_FALSE(picture.ok()) << reason;
            EXPECT_NE(picture.error().line().find(reason), std::string::npos) << picture.error().line();
        }
    };
    refused("latitude", [](Geotags& tags) { tags.lat_deg = 90.1; });
    refused("latitude", [](Geotags& tags) { tags.lat_deg = nan; });
    refused("longitude", [](Geotags& tags) { tags.lon_deg = 181; });
    refused("height H", [](Geotags& tags) { tags.H_m = infinity; });
    refused("height h", [](Geotags& tags) { tags.h_m = nan; });
    refused("heading", [](Geotags& tags) { tags.heading_deg = nan; });
    refused("field of view", [](Geotags& tags) { tags.vertical_fov_deg = 0; });
    refused("field of view", [](Geotags& tags) { tags.vertical_fov_deg = 180; });
    refused("destination's latitude", [](Geotags& tags) { tags.destination->lat_deg = -91; });
    refused("bearing", [](Geotags& tags) { tags.destination->bearing_deg = infinity; });
    refused("distance", [](Geotags& tags) { tags.destination->distance_m = -1; });
    refused("the years 0 to 9999", [](Geotags& tags) { tags.time_utc_s = 253402300800; });
    refused("the years 0 to 9999",
            [](Geotags& tags) { tags.time_utc_s = std::numeric_limits<std::int64_t>::min(); });
    refused("view holds at byte 1 a control character", [](Geotags& tags) { tags.view_json = "a\x01"; });
    refused("view holds at byte 0 a control character",
            [](Geotags& tags) { tags.view_json = std::string(1, '\0'); });
    refused("attribution holds at byte 2 something that is not UTF-8",
            [](Geotags& tags) { tags.attribution = "ab\xFF"; });
    refused("not UTF-8", [](Geotags& tags) { tags.attribution = "\xC0\x80"; });  // too long a form of 0
    refused("not UTF-8", [](Geotags& tags) { tags.geoid = "\xED\xA0\x80"; });    // half a surrogate pair
    refused("not UTF-8", [](Geotags& tags) { tags.software = "\xE2\x82"; });
    EXPECT_TRUE(fs::is_empty(folder));
}

}  // namespace
}  // namespace oro
