// A real view with all that the style `natural` has draws the same pixels by both ways of drawing, from tiles
// and from a baked region, and each time. That effects which a style does not have change nothing is held by
// the golden pictures (golden_test.cpp): they are of the style `default`, which has none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::joined;
using oro::test::Outcome;
using oro::test::Pixels;
using oro::test::run_orograph;
using oro::test::Words;

// Over Interlaken towards the lake of Brienz, in the light of an afternoon.
const Words lake{"--at",    "46.655,7.80", "--altitude", "3200", "--heading", "60",
                 "--pitch", "-16",         "--fov",      "50",   "--sun",     "250,28"};
constexpr const char* around_the_lake = "7.7,46.55,8.3,46.9";
// Up the valley of the Rhone, with a satellite's image of it.
const Words valley{"--at",    "46.12,7.05", "--altitude", "5200", "--heading", "55",
                   "--pitch", "-12",        "--fov",      "50",   "--sun",     "150,50"};

// Pixels, from the left and from the top.
using Places = std::vector<std::pair<int, int>>;

Places differing(const Pixels& one, const Pixels& other) {
    Places places;
    if (one.width != other.width || one.rgb.size() != other.rgb.size()) return {{-1, -1}};
    for (std::size_t i = 0; i < one.rgb.size() / 3; ++i) {
        if (!std::equal(&one.rgb[3 * i], &one.rgb[3 * i] + 3, &other.rgb[3 * i]))
            places.emplace_back(static_cast<int>(i % one.width), static_cast<int>(i / one.width));
    }
    return places;
}

class SameEverywhere : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    Words tiles;

    void SetUp() override {
        for (const char* name : {"alps/N46E007.SRTMGL3.hgt.zip", "alps/N46E008.SRTMGL3.hgt.zip"}) {
            const auto tile = oro::test::real_data(name);
            if (!tile) GTEST_SKIP() << "needs " << name;
            tiles.push_back(tile->string());
        }
    }

    // Of the two tiles only what the view needs: what is compared does not depend on how large the region is.
    void keep_to(const std::string& west_south_east_north) {
        tiles.push_back("--bbox=" + west_south_east_north);
    }

    // Width 0 when nothing was drawn.
    Pixels draw(const Words& sources, const Words& view, const std::string& style = "natural") const {
        const fs::path picture = folder / "p.png";
        const Words how{"--size",      "256x144", "--style", style, "-q", "--time", "2026-01-01T00:00:00Z",
                        "--overwrite", "--out",   picture};
        const Outcome outcome = run_orograph(joined(joined(joined({"shot"}, sources), view), how));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome.exit_code == 0 ? oro::test::pixels_of(picture) : Pixels{};
    }

    // natural.json with other values in some fields; null: without the field. Its path.
    [[nodiscard]] std::string changed(const std::string& name, const json& fields) const {
        std::ifstream file(oro::test::bundled_data() / "styles" / "natural.json");
        json style = json::parse(file);
        for (const auto& [field, value] : fields.items()) {
            style.erase(field);
            if (!value.is_null()) style[field] = value;
        }
        const fs::path path = folder / (name + ".json");
        oro::test::write_bytes(path, style.dump());
        return path;
    }

    // Four pictures, from tiles and from a baked region, each twice: one.
    Pixels hold_one_way(const Words& view) const {
        const fs::path baked = folder / "region.oro";
        if (!fs::exists(baked)) {
            const Outcome bake = run_orograph(joined({"bake"}, joined(tiles, {"--out", baked, "-q"})));
            EXPECT_EQ(bake.exit_code, 0) << bake.err;
        }
        const Pixels first = draw(tiles, view);
        EXPECT_GT(first.width, 0U);
        EXPECT_EQ(differing(first, draw(tiles, view)), Places{}) << "drawn again";
        for (int time = 1; time <= 2; ++time)
            EXPECT_EQ(differing(first, draw({baked}, view)), Places{}) << "baked, time " << time;
        return first;
    }

    // Both ways of drawing show the same but where a pixel's middle lies on the edge of two triangles and
    // they show it of one and of the other, as they do without any effect; smooth edges carry that on along
    // an edge.
    void hold_by_all_doors(const Words& view) const {
        const Words compute = joined(view, {"--pipeline", "compute"}),
                    mesh = joined(view, {"--pipeline", "mesh"});
        const Places apart = differing(hold_one_way(compute), hold_one_way(mesh));
        const std::string bare = changed("bare", {{"shadows", false},
                                                  {"sky_openness", false},
                                                  {"footprint", "point"},
                                                  {"water", nullptr},
                                                  {"voids", nullptr}});
        const Places ties = differing(draw(tiles, compute, bare), draw(tiles, mesh, bare));
        std::printf("%zu pixels differ between the two ways of drawing, %zu without effects\n", apart.size(),
                    ties.size());
        EXPECT_LE(ties.size(), std::size_t{8});
        constexpr int reach_px = 2;
        for (const auto& [x, y] : apart) {
            EXPECT_TRUE(std::ranges::any_of(ties,
                                            [&, x = x, y = y](const auto& tie) {
                                                return std::abs(tie.first - x) <= reach_px &&
                                                       std::abs(tie.second - y) <= reach_px;
                                            }))
                << "pixel " << x << "," << y;
        }
    }
};

TEST_F(SameEverywhere, AViewWithEveryEffect) {
    keep_to(around_the_lake);
    hold_by_all_doors(lake);
}

TEST_F(SameEverywhere, AViewUnderAnImage) {
    const auto image = oro::test::real_data("drape/S2B_T32TLS_20220618_R60m_B01.jp2");
    if (!image) GTEST_SKIP() << "needs drape/S2B_T32TLS_20220618_R60m_B01.jp2";
    keep_to("6.99,46.05,8.1,46.5");
    const Words under = joined(valley, {"--drape", image->string()});
    hold_by_all_doors(under);
    EXPECT_NE(differing(draw(tiles, under), draw(tiles, valley)), Places{}) << "no image is seen";
}

// The control of the first: each effect is in that view. What an option switches off is off as in a style
// without it.
TEST_F(SameEverywhere, EachEffectIsInTheView) {
    keep_to(around_the_lake);
    const Pixels all = draw(tiles, lake);
    const auto without = [&](const char* effect, const json& off) {
        Pixels drawn = draw(tiles, lake, changed(effect, {{effect, off}}));
        EXPECT_NE(differing(all, drawn), Places{}) << effect << " is not in the view";
        return drawn;
    };
    const Pixels no_shadows = without("shadows", false), no_openness = without("sky_openness", false);
    EXPECT_EQ(differing(no_shadows, draw(tiles, joined(lake, {"--shadows", "off"}))), Places{});
    EXPECT_EQ(differing(no_openness, draw(tiles, joined(lake, {"--sky-openness", "off"}))), Places{});
    const Pixels steps = without("edges", "steps");
    EXPECT_EQ(differing(steps, draw(tiles, joined(lake, {"--edges", "steps"}))), Places{});
    without("footprint", "point");
    without("water", nullptr);
}

// Edges are the style's or as somebody asks for, in any style; samples stay samples; the view tells what was
// asked for.
TEST_F(SameEverywhere, EdgesByChoice) {
    keep_to(around_the_lake);
    const Words smooth{"--edges", "smooth"}, steps{"--edges", "steps"}, sampled{"--samples", "2"};
    const Pixels plain = draw(tiles, lake, "default");
    EXPECT_EQ(differing(plain, draw(tiles, joined(lake, steps), "default")), Places{});
    const Pixels asked = draw(tiles, joined(lake, smooth), "default");
    EXPECT_NE(differing(plain, asked), Places{});
    const Outcome again = run_orograph({"shot", "--view", folder / "p.png", "--out", folder / "q.png", "-q"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(differing(asked, oro::test::pixels_of(folder / "q.png")), Places{});
    EXPECT_EQ(differing(draw(tiles, lake), draw(tiles, joined(lake, smooth))), Places{});
    const Words two = joined(lake, sampled);
    EXPECT_EQ(differing(draw(tiles, two), draw(tiles, joined(two, steps))), Places{});
}

}  // namespace
