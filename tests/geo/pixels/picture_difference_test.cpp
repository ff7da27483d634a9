// A picture's file held against a drawing, in each format: what is the same, and what an edit leaves.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "geo/pixels/picture_difference.h"
#include "tests/geo/pictures/sample_picture.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

constexpr int width = 200, height = 120;
constexpr PixelSlack slack{3, 24};
using Image = std::vector<std::uint8_t>;

// Rough and smooth parts, as terrain and sky are.
Image drawn() {
    Image image(std::size_t{3} * width * height);
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            std::uint8_t* const rgb = image.data() + 3 * (width * y + x);
            const double rough = y < 40 ? 0.0 : 30 * std::sin(0.9 * static_cast<double>(x * y % 97));
            rgb[0] = static_cast<std::uint8_t>(120 + rough + static_cast<double>(x) / 4);
            rgb[1] = static_cast<std::uint8_t>(150 + rough);
            rgb[2] = static_cast<std::uint8_t>(200 - static_cast<double>(y) / 2);
        }
    }
    return image;
}

void square(Image& image, std::size_t left, std::size_t top, std::uint8_t change) {
    for (std::size_t y = top; y < top + 20; ++y) {
        for (std::size_t x = left; x < left + 20; ++x) image[3 * (width * y + x)] ^= change;
    }
}

std::string written(const fs::path& file, const Image& image) {
    Geotags tags = test::sample_tags();
    tags.width_px = width;
    tags.height_px = height;
    auto picture = create_picture(file, tags, true);
    EXPECT_TRUE(picture.ok()) << picture.error().line();
    for (std::size_t y = 0; y < height; ++y)
        EXPECT_TRUE((*picture)->write_row(std::span(image).subspan(3 * width * y, 3 * width)).ok());
    EXPECT_TRUE((*picture)->finish().ok());
    return file.string();
}

PictureDifference between(const std::string& file, const Image& image) {
    auto comparison = PictureComparison::open(file, width, height, slack);
    EXPECT_TRUE(comparison.ok()) << comparison.error().line();
    for (std::size_t y = 0; y < height; ++y) {
        const auto added = comparison->add_drawn_row(std::span(image).subspan(3 * width * y, 3 * width));
        EXPECT_TRUE(added.ok()) << added.error().line();
    }
    const auto found = comparison->finish();
    EXPECT_TRUE(found.ok()) << found.error().line();
    return *found;
}

TEST(PictureDifference, NoneBetweenADrawingAndItsFile) {
    const fs::path folder = test::scratch_folder();
    const Image image = drawn();
    PixelFingerprint fingerprint(width, height);
    fingerprint.add(image);
    for (const char* name : {"a.png", "a.tif", "a.jpg"}) {
        SCOPED_TRACE(name);
        const std::string file = written(folder / name, image);
        const PictureDifference found = between(file, image);
        EXPECT_EQ(found.pixels, 24000U);
        EXPECT_EQ(found.any.count, 0U);
        EXPECT_EQ(found.largest, 0);
        EXPECT_EQ(found.drawn_fingerprint, fingerprint.value());
        const auto of_file = fingerprint_of_pixels(file, width, height);
        ASSERT_TRUE(of_file.ok()) << of_file.error().line();
        EXPECT_EQ(found.lossy, std::string(name) == "a.jpg");
        EXPECT_EQ(found.file_fingerprint, *of_file);
        if (!found.lossy) {
            EXPECT_EQ(*of_file, fingerprint.value()) << "the same in each format that keeps pixels";
        }
    }
}

TEST(PictureDifference, AnEditedSquareIsItsBox) {
    const fs::path folder = test::scratch_folder();
    const Image image = drawn();
    Image edited = image;
    square(edited, 61, 70, 0x80);
    for (const char* name : {"a.png", "a.tif"}) {
        SCOPED_TRACE(name);
        const PictureDifference found = between(written(folder / name, edited), image);
        EXPECT_EQ(found.beyond.count, 400U);
        EXPECT_EQ(found.beyond.left, 61);
        EXPECT_EQ(found.beyond.right, 80);
        EXPECT_EQ(found.beyond.top, 70);
        EXPECT_EQ(found.beyond.bottom, 89);
        EXPECT_EQ(found.beyond.most_in_a_square, 64);
        EXPECT_EQ(found.largest, 128);
    }
    // In a JPEG, to the squares of 8 x 8 pixels that it is made of.
    const PictureDifference lossy = between(written(folder / "a.jpg", edited), image);
    EXPECT_GE(lossy.beyond.count, 380U);
    EXPECT_LE(lossy.beyond.count, 32U * 32U);
    EXPECT_GE(lossy.beyond.left, 56);
    EXPECT_LE(lossy.beyond.right, 87);
    EXPECT_GE(lossy.beyond.top, 64);
    EXPECT_LE(lossy.beyond.bottom, 95);
    EXPECT_EQ(lossy.beyond.most_in_a_square, 64);
}

// A drawing that another device has rounded otherwise: within the slack, also through a JPEG.
TEST(PictureDifference, RoundingStaysWithinTheSlack) {
    const fs::path folder = test::scratch_folder();
    const Image image = drawn();
    Image rounded = image;
    for (std::size_t i = 0; i < rounded.size(); i += 7)
        rounded[i] = static_cast<std::uint8_t>(rounded[i] + 1);
    for (const char* name : {"a.png", "a.tif", "a.jpg"}) {
        SCOPED_TRACE(name);
        const PictureDifference found = between(written(folder / name, rounded), image);
        EXPECT_GT(found.any.count, 1000U);
        EXPECT_EQ(found.beyond.count, 0U) << found.largest;
    }
}

TEST(PictureDifference, AnotherSizeAndHalfFilesAreErrors) {
    const fs::path folder = test::scratch_folder();
    const Image image = drawn();
    for (const char* name : {"a.png", "a.tif", "a.jpg"}) {
        SCOPED_TRACE(name);
        const std::string file = written(folder / name, image);
        const auto other = PictureComparison::open(file, width, height + 1, slack);
        ASSERT_FALSE(other.ok());
        EXPECT_NE(other.error().line().find("has 200x120 pixels, and its view 200x121"), std::string::npos);
        const std::string bytes = test::content(file);
        for (const double share : {0.0, 0.1, 0.5, 0.9, 0.99}) {
            if (share > 0.9 && std::string(name) == "a.tif") continue;  // behind its pixels
            const std::string half = (folder / "half").string();
            std::FILE* const out = std::fopen(half.c_str(), "wb");
            std::fwrite(bytes.data(), 1, static_cast<std::size_t>(share * static_cast<double>(bytes.size())),
                        out);
            std::fclose(out);
            const auto fingerprint = fingerprint_of_pixels(half, width, height);
            auto comparison = PictureComparison::open(half, width, height, slack);
            bool refused = !comparison.ok();
            for (std::size_t y = 0; y < height && !refused; ++y)
                refused = !comparison->add_drawn_row(std::span(image).subspan(3 * width * y, 3 * width)).ok();
            if (!refused) refused = !comparison->finish().ok();
            EXPECT_TRUE(refused) << share;
        }
    }
    EXPECT_FALSE(open_picture_rows((folder / "none.png").string(), 1, 1).ok());
    EXPECT_FALSE(open_picture_rows(folder.string(), 1, 1).ok());
}

}  // namespace
}  // namespace oro
