// The legend of an error picture: small letters, no exponents, and all of it on the narrowest picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/accuracy/verification.h"
#include "apps/report/canvas.h"

namespace oro {
namespace {

constexpr int narrowest_px = 320;

Verification measured(double largest) {
    Verification made;
    made.errors.ground.summary_displacement_px = {largest, 0.5 * largest, 0.1 * largest, 0.001 * largest,
                                                  1000};
    made.errors.ground.summary_displacement_m = {1e6 * largest, 200.0 * largest, largest, 0.0, 1000};
    return made;
}

void expect_readable(const std::string& line) {
    SCOPED_TRACE(line);
    EXPECT_TRUE(Canvas::can_write(line)) << "a letter is blank";
    EXPECT_TRUE(std::none_of(line.begin(), line.end(), [](unsigned char c) { return std::isupper(c) != 0; }));
    EXPECT_LE(Canvas::text_width_px(line, 1), narrowest_px - 6);
    for (std::size_t at = line.find('e'); at != std::string::npos; at = line.find('e', at + 1))
        EXPECT_FALSE(at > 0 && std::isdigit(static_cast<unsigned char>(line[at - 1])) != 0) << "an exponent";
}

TEST(ErrorLegend, IsReadableWhateverWasMeasured) {
    for (const double largest : {0.0, 1e-9, 0.0042, 1.25, 4871.0, 1e7}) {
        for (const double tau_px : {0.0, 1e-7, 0.01, 1.0, 1000.0})
            for (const std::string& line : error_legend(measured(largest), tau_px)) expect_readable(line);
    }
}

TEST(ErrorLegend, SaysWhatColoursMeanAndItsUnits) {
    const std::vector<std::string> lines = error_legend(measured(0.0042), 0.5);
    ASSERT_EQ(lines.size(), 9U);
    EXPECT_EQ(lines[0], "colour: how far off, in pixels (px)");
    EXPECT_EQ(lines[1], "line: tau 0.5 px");
    EXPECT_EQ(error_legend(measured(0.0042), 0.0)[1], "tau 0 px") << "beyond the scale";
    EXPECT_EQ(lines[2], "               largest   99.99 %      99 %      mean");
    EXPECT_EQ(lines[3], "displacement    0.0042    0.0021    <0.001    <0.001");
    EXPECT_EQ(lines[6], "skyline            n/a       n/a       n/a       n/a") << "none in view";
}

// Nothing like what is drawn is seen within 32 px: how far it is off is not known, nor is the mean.
TEST(ErrorLegend, SaysWhatIsAtLeastThat) {
    Verification far = measured(0.0042);
    far.errors.seen.summary_px = {32.0, 32.0, 4.5, 1.25, 1000, 7, 32.0};
    EXPECT_EQ(error_legend(far, 0.5)[5], "seen            >=32.0    >=32.0       4.5     >=1.2");
    for (const std::string& line : error_legend(far, 0.5)) expect_readable(line);
    const std::string text = verification_text(far, {}, {});
    EXPECT_NE(text.find("\n  seen, px           >= 32.0     >= 32.0         4.50     >= 1.25\n"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("\n>=: at least this."), std::string::npos) << text;
    EXPECT_EQ(verification_text(measured(0.0042), {}, {}).find(">="), std::string::npos);
    const nlohmann::ordered_json json = verification_json(far);
    EXPECT_EQ(json["seen_px"]["at_least"].dump(), R"(["max","p9999","mean"])");
    EXPECT_EQ(json["surface_px"]["at_least"].dump(), "[]");
    EXPECT_EQ(json["largest_px_at_least"], true);
}

}  // namespace
}  // namespace oro
