// Codes of an image's values: bytes as they are, other numbers as light, or as the file or a user says.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "geo/drape/image_pixels.h"
#include "geo/drape/image_values.h"
#include "tests/drape/written_image.h"
#include "tests/drape/written_profile.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

// The first codes of a grey image's rows, which are opaque; `step` pixels averaged into one.
std::vector<float> codes_down(const ImageSource& image, int step) {
    const Dataset dataset(GDALOpenEx(image.file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, trusted_drivers(),
                                     nullptr, nullptr));
    EXPECT_TRUE(dataset);
    const auto pixels = read_pixels(image, dataset.get(), {0, 0, image.columns, image.rows}, step);
    EXPECT_TRUE(pixels.ok());
    if (!pixels.ok()) return {};
    std::vector<float> codes;
    for (int row = 0; row < pixels->rows; ++row) {
        const Colour& colour = pixels->colours[static_cast<std::size_t>(row * pixels->columns)];
        EXPECT_EQ(colour[0], colour[1]);
        EXPECT_EQ(colour[0], colour[2]);
        EXPECT_EQ(colour[3], 1.0F);
        codes.push_back(colour[0]);
    }
    return codes;
}

void expect_codes(const std::vector<float>& codes, const std::vector<float>& wanted) {
    ASSERT_EQ(codes.size(), wanted.size());
    for (std::size_t i = 0; i < codes.size(); ++i) EXPECT_NEAR(codes[i], wanted[i], 0.01F) << "row " << i;
}

// 10 x 10 pixels: two rows of black and white by turns, then one value a row.
std::string written(const std::string& name, GDALDataType type, double white, double dark, double darkest,
                    double half, const test::ProfileBytes& profile = {}, int bits = 0) {
    test::WrittenImage image{10, 10, {8.0, 0.01, 0.0, 47.0, 0.0, -0.01}};
    image.profile = profile;
    image.bits = bits;
    image.bands = 1;
    image.type = type;
    return test::write_image(test::scratch_folder() / name, image, [=](int, int row, int column) {
        if (row < 2) return column % 2 == 0 ? 0.0 : white;
        if (row < 4) return darkest;
        return row < 6 ? dark : half;
    });
}

// By hand: 20 of 10,000 is 0.002, and 255 x 12.92 x 0.002 = 6.589; 400 is 0.04, and 255 x (1.055 x 0.26153 -
// 0.055) = 56.334; 5,000 is 0.5, and 255 x (1.055 x 0.74915 - 0.055) = 187.516.
TEST(ImageValues, ThatAreNoBytesAreLight) {
    for (const GDALDataType type : {GDT_UInt16, GDT_Float32}) {
        const auto image = open_image(written("light.tif", type, 10000.0, 400.0, 20.0, 5000.0));
        ASSERT_TRUE(image.ok()) << image.error().line();
        ASSERT_FALSE(image->notes.empty());
        EXPECT_EQ(image->notes.front(), image->file +
                                            ": its values are no bytes and taken for linear light; 0 "
                                            "is shown as black, 10000 as white");
        const float darkest = 6.589F, dark = 56.334F, half = 187.516F;
        expect_codes(codes_down(*image, 1),
                     {0.0F, 0.0F, darkest, darkest, dark, dark, half, half, half, half});
        // Black and white are averaged as light.
        expect_codes(codes_down(*image, 2), {half, darkest, dark, half, half});
    }
}

TEST(ImageValues, OfBytesAreCodesAlready) {
    const auto image = open_image(written("bytes.tif", GDT_Byte, 200.0, 40.0, 2.0, 100.0));
    ASSERT_TRUE(image.ok()) << image.error().line();
    EXPECT_TRUE(image->notes.empty());
    expect_codes(codes_down(*image, 1),
                 {0.0F, 0.0F, 2.0F, 2.0F, 40.0F, 40.0F, 100.0F, 100.0F, 100.0F, 100.0F});
    expect_codes(codes_down(*image, 2), {100.0F, 2.0F, 40.0F, 100.0F, 100.0F});
}

// The profiles' exponents: 1, 2.2 (563 of 256) and 2.4 (157,286 of 65,536).
TEST(ImageValues, AreWhatAProfileSays) {
    using test::curve_of;
    using test::formula_of;
    using test::profile_with;
    constexpr auto light = ImageValues::reflectance, codes = ImageValues::codes;
    for (const char* const tag : {"rTRC", "kTRC"}) {
        EXPECT_EQ(values_by_profile(profile_with(tag, curve_of({}))), light);
        EXPECT_EQ(values_by_profile(profile_with(tag, curve_of({256}))), light);
        EXPECT_EQ(values_by_profile(profile_with(tag, curve_of({563}))), codes);
        EXPECT_EQ(values_by_profile(profile_with(tag, curve_of({0, 32768, 65535}))), light);
        EXPECT_EQ(values_by_profile(profile_with(tag, curve_of({0, 14025, 65535}))), codes);
        EXPECT_EQ(values_by_profile(profile_with(tag, formula_of(65536))), light);
        EXPECT_EQ(values_by_profile(profile_with(tag, formula_of(157286))), codes);
    }
    EXPECT_EQ(values_by_profile(profile_with("A2B0", curve_of({}))), codes) << "tables, no curve";
    EXPECT_EQ(values_by_profile({}), std::nullopt);
    EXPECT_EQ(values_by_profile(test::ProfileBytes(200)), std::nullopt) << "no profile";
}

// Wherever a profile ends there is an answer, and nothing beyond its end is read.
TEST(ImageValues, AreFoundInCutProfiles) {
    const test::ProfileBytes whole = test::profile_with("rTRC", test::curve_of({0, 32768, 65535}));
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const test::ProfileBytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_EQ(values_by_profile(cut).has_value(), size >= 40) << size;
        if (size >= 40) {
            EXPECT_EQ(values_by_profile(cut), ImageValues::codes) << size;
        }
    }
    test::ProfileBytes endless = whole;
    for (std::size_t at = 144 + 8; at < 144 + 12; ++at) endless[at] = std::byte{255};
    EXPECT_EQ(values_by_profile(endless), ImageValues::codes);
}

const test::ProfileBytes& profile_of_pictures() {
    static const test::ProfileBytes profile = test::profile_with("rTRC", test::curve_of({563}));
    return profile;
}

// 257 is a step of codes in 65,535: the codes of the bytes above.
TEST(ImageValues, OfSixteenBitsAreCodesWhereTheirProfileOrTheUserSaysSo) {
    const std::string with =
        written("with.tif", GDT_UInt16, 65535.0, 10280.0, 514.0, 25700.0, profile_of_pictures());
    const std::string without = written("without.tif", GDT_UInt16, 65535.0, 10280.0, 514.0, 25700.0);
    for (const auto& image : {open_image(with), open_image(without, ImageValues::codes)}) {
        ASSERT_TRUE(image.ok()) << image.error().line();
        EXPECT_FALSE(image->is_light);
        ASSERT_EQ(image->notes.size(), 1U);
        EXPECT_EQ(image->notes.front(), image->file +
                                            ": its values are no bytes and taken for sRGB codes; 0 is "
                                            "shown as black, 65535 as white");
        expect_codes(codes_down(*image, 1),
                     {0.0F, 0.0F, 2.0F, 2.0F, 40.0F, 40.0F, 100.0F, 100.0F, 100.0F, 100.0F});
        // Black and white are averaged as codes.
        expect_codes(codes_down(*image, 2), {127.5F, 2.0F, 40.0F, 100.0F, 100.0F});
    }
}

// By hand: 10,280 of 65,535 is 0.15686, and 255 x (1.055 x 0.46217 - 0.055) = 110.31.
TEST(ImageValues, OfSixteenBitsAreLightWhereTheirProfileOrTheUserSaysSo) {
    const std::string straight = written("straight.tif", GDT_UInt16, 65535.0, 10280.0, 514.0, 25700.0,
                                         test::profile_with("kTRC", test::curve_of({})));
    const std::string with =
        written("with.tif", GDT_UInt16, 65535.0, 10280.0, 514.0, 25700.0, profile_of_pictures());
    for (const auto& image : {open_image(straight), open_image(with, ImageValues::reflectance)}) {
        ASSERT_TRUE(image.ok()) << image.error().line();
        EXPECT_TRUE(image->is_light);
        EXPECT_NEAR(codes_down(*image, 1)[4], 110.31F, 0.01F);
    }
}

TEST(ImageValues, OfBytesAreLightWhereTheUserSaysSo) {
    const auto image =
        open_image(written("bytes.tif", GDT_Byte, 200.0, 40.0, 2.0, 100.0), ImageValues::reflectance);
    ASSERT_TRUE(image.ok()) << image.error().line();
    ASSERT_EQ(image->notes.size(), 1U);
    EXPECT_EQ(image->notes.front(),
              image->file + ": its values are taken for linear light; 0 is shown as black, 200 as white");
    EXPECT_NEAR(codes_down(*image, 1)[6], 187.516F, 0.01F);  // half of the light
}

TEST(ImageValues, ThatAreCodesHaveTheWhiteOfTheirType) {
    struct Case {
        GDALDataType type;
        double largest;
        int bits;
        double white;
    };
    for (const Case& one : {Case{GDT_UInt16, 60000.0, 0, 65535.0}, Case{GDT_UInt16, 3000.0, 12, 4095.0},
                            Case{GDT_Int16, 30000.0, 0, 32767.0}, Case{GDT_UInt16, 250.0, 0, 255.0},
                            Case{GDT_Float32, 0.9, 0, 1.0}, Case{GDT_Float32, 250.0, 0, 255.0},
                            Case{GDT_Float32, 60000.0, 0, 65535.0}, Case{GDT_UInt32, 4e9, 0, 4294967295.0}}) {
        const auto image = open_image(
            written("image.tif", one.type, one.largest, 0.0, 0.0, 0.0, {}, one.bits), ImageValues::codes);
        ASSERT_TRUE(image.ok()) << image.error().line();
        EXPECT_EQ(image->black, 0.0);
        EXPECT_EQ(image->white, one.white) << GDALGetDataTypeName(one.type) << " " << one.largest;
    }
}

// Bands that are named red, green and blue are no sign of codes.
TEST(ImageValues, OfScenesInColourAreLight) {
    test::WrittenImage scene{10, 10, {8.0, 0.01, 0.0, 47.0, 0.0, -0.01}};
    scene.type = GDT_UInt16;
    scene.photometric = "RGB";
    const auto image = open_image(test::write_image(test::scratch_folder() / "scene.tif", scene,
                                                    [](int, int row, int) { return 1000.0 * row; }));
    ASSERT_TRUE(image.ok()) << image.error().line();
    EXPECT_TRUE(image->is_light);
}

}  // namespace
}  // namespace oro
