// Codes of an image's values: bytes as they are, other numbers as light.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "geo/drape/image_pixels.h"
#include "tests/drape/written_image.h"
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
                    double half) {
    test::WrittenImage image{10, 10, {8.0, 0.01, 0.0, 47.0, 0.0, -0.01}};
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

}  // namespace
}  // namespace oro
