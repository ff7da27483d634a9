// A closed mesh drawn by clusters, from many eyes: its silhouette is where the whole mesh has it, and nothing
// shows through it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::joined;
using oro::test::Outcome;
using oro::test::Pixels;
using oro::test::pixels_of;
using oro::test::run_orograph;
using oro::test::Words;

constexpr double pi = std::numbers::pi;
// A hilly ball in the sky: 3,120 triangles, its surface 75 to 85 m from its middle.
constexpr double middle_lat_deg = 36.605, middle_lon_deg = -84.176, middle_H_m = 1500.0, radius_m = 80.0;
// Of EGM96 there, by PROJ: places of geo: are above the ellipsoid.
constexpr double middle_N_m = -30.77;

std::string obj_in_the_sky() {
    constexpr int n = 40, around = 40;
    std::string text;
    char line[100];
    for (int i = 0; i <= n; ++i)
        for (int k = 0; k < around; ++k) {
            const double a = pi * i / n, b = 2.0 * pi * k / around;
            const double r = radius_m + (i > 0 && i < n ? 4.0 * std::sin(7.0 * a) * std::cos(6.0 * b) : 0.0);
            std::snprintf(line, sizeof line, "v %.9f %.9f %.4f\n",
                          middle_lon_deg + r * std::sin(a) * std::sin(b) / 89500.0,
                          middle_lat_deg + r * std::sin(a) * std::cos(b) / 111000.0,
                          middle_H_m + r * std::cos(a));
            text += line;
        }
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < around; ++k) {
            const int c = (k + 1) % around, a = 1 + i * around;
            if (i > 0)
                text += "f " + std::to_string(a + k) + " " + std::to_string(a + around + k) + " " +
                        std::to_string(a + c) + "\n";
            if (i + 1 < n)
                text += "f " + std::to_string(a + c) + " " + std::to_string(a + around + k) + " " +
                        std::to_string(a + around + c) + "\n";
        }
    return text;
}

struct Eye {
    double distance_m;  // from the ball's middle
    double fov_deg;
    Words words;
    std::string key;  // of a camera's path, without its time
};

// Around the ball, 200 to 4,000 m away, level with it or not; the ball fills most of the picture.
Eye random_eye(std::mt19937_64& random) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const double distance = 200.0 * std::pow(20.0, share(random)), way = 2.0 * pi * share(random),
                 up = std::min(0.25 * pi, 900.0 / distance) * (2.0 * share(random) - 1.0);
    const double level = distance * std::cos(up);
    char at[60], altitude[30], look[80], fov[20];
    std::snprintf(at, sizeof at, "%.9f,%.9f", middle_lat_deg - level * std::cos(way) / 111000.0,
                  middle_lon_deg - level * std::sin(way) / 89500.0);
    std::snprintf(altitude, sizeof altitude, "%.3f", middle_H_m - distance * std::sin(up));
    std::snprintf(look, sizeof look, "geo:%.9f,%.9f,%.3f", middle_lat_deg, middle_lon_deg,
                  middle_H_m + middle_N_m);
    const double fov_deg = 2.0 * std::atan(1.3 * radius_m / distance) * 180.0 / pi;
    std::snprintf(fov, sizeof fov, "%.6f", fov_deg);
    char key[200];
    std::snprintf(
        key, sizeof key,
        R"("eye": {"lat_deg": %.9f, "lon_deg": %.9f, "h_m": %.3f}, "heading_deg": %.6f, )"
        R"("pitch_deg": %.6f, "fov_deg": %.6f)",
        middle_lat_deg - level * std::cos(way) / 111000.0, middle_lon_deg - level * std::sin(way) / 89500.0,
        middle_H_m + middle_N_m - distance * std::sin(up), way * 180.0 / pi, up * 180.0 / pi, fov_deg);
    return {distance, fov_deg, {"--at", at, "--altitude", altitude, "--look-at", look, "--fov", fov}, key};
}

class MeshSilhouettes : public ::testing::Test {
  protected:
    void SetUp() override {
        const std::string mesh = (folder_ / "ball.obj").string();
        oro::test::write_bytes(mesh, obj_in_the_sky());
        const Outcome baked = run_orograph(
            {"bake", bundled(), "--mesh-file", mesh, "--mesh-crs", "EPSG:4326", "--out", region_, "-q"});
        ASSERT_EQ(baked.exit_code, 0) << baked.err;
    }
    [[nodiscard]] json drawn(const Eye& eye, const Words& more) const {
        const Outcome done =
            run_orograph(joined(joined({"shot", region_, "--mesh", "clusters", "--size", size_, "--out",
                                        picture_, "--overwrite", "-q", "--json"},
                                       eye.words),
                                more));
        EXPECT_EQ(done.exit_code, 0) << done.err;
        return done.exit_code == 0 ? json::parse(done.out) : json::object();
    }
    // Pixels within the ball, by its radius alone, that are as without it.
    static void count_through(const Eye& eye, int side_px, const fs::path& picture, const fs::path& empty,
                              int& within, int& through) {
        const Pixels with = pixels_of(picture), without = pixels_of(empty);
        ASSERT_EQ(with.rgb.size(), without.rgb.size());
        const double per_pixel = std::tan(eye.fov_deg * pi / 360.0) / (0.5 * side_px);
        for (int y = 0; y < side_px; ++y)
            for (int x = 0; x < side_px; ++x) {
                const double across = (x + 0.5 - 0.5 * side_px) * per_pixel,
                             down = (y + 0.5 - 0.5 * side_px) * per_pixel;
                const double aside_m = eye.distance_m * std::sin(std::atan(std::hypot(across, down)));
                if (aside_m > 70.0) continue;
                ++within;
                const std::size_t at = 3 * static_cast<std::size_t>(y * side_px + x);
                through += std::equal(with.rgb.begin() + static_cast<std::ptrdiff_t>(at),
                                      with.rgb.begin() + static_cast<std::ptrdiff_t>(at + 3),
                                      without.rgb.begin() + static_cast<std::ptrdiff_t>(at))
                               ? 1
                               : 0;
            }
    }
    const fs::path folder_ = oro::test::scratch_folder();
    const std::string region_ = (folder_ / "ball.oro").string(), picture_ = (folder_ / "ball.png").string(),
                      empty_ = (folder_ / "empty.png").string();
    std::string size_{"96x96"};
};

// tau, what an edge is found to, and 1/64 of a pixel.
TEST_F(MeshSilhouettes, AreWithinTauOfTheWholeMeshFromTwelveEyes) {
    constexpr unsigned seed = 5231;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    double worst_px = 0.0;
    for (int i = 0; i < 12; ++i) {
        const Eye eye = random_eye(random);
        for (const char* const pipeline : {"compute", "mesh"}) {
            const json said = drawn(eye, {"--verify", "--pipeline", pipeline});
            ASSERT_FALSE(said.empty());
            EXPECT_LT(said["meshes"]["triangles"], 3000) << i;
            for (const char* const part : {"surface_px", "skyline_px"}) {
                const double px = said["error"][part]["max"].get<double>();
                EXPECT_LE(px, 1.0 + 0.05 + 1.0 / 64.0) << part << ", eye " << i << ", " << pipeline;
                worst_px = std::max(worst_px, px);
            }
        }
    }
    std::printf("worst %.3f px\n", worst_px);
}

TEST_F(MeshSilhouettes, NothingShowsThroughTheBallFromManyEyes) {
    constexpr unsigned seed = 5232;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    size_ = "64x64";
    int within = 0, through = 0;
    for (int i = 0; i < 12; ++i) {
        const Eye eye = random_eye(random);
        const char* const tau = i % 3 == 0 ? "0.5" : i % 3 == 1 ? "2" : "6";
        ASSERT_FALSE(drawn(eye, {"--tau", tau, "--pipeline", i % 2 == 0 ? "compute" : "mesh"}).empty());
        const Outcome without = run_orograph(
            joined({"shot", bundled(), "--size", size_, "--out", empty_, "--overwrite", "-q"}, eye.words));
        ASSERT_EQ(without.exit_code, 0) << without.err;
        const int before = through;
        count_through(eye, 64, picture_, empty_, within, through);
        EXPECT_EQ(through, before) << "eye " << i << " at " << eye.words[1] << ", " << eye.words[3]
                                   << " m, tau " << tau;
    }
    std::printf("%d pixels within the ball, %d show something else\n", within, through);
    EXPECT_GT(within, 12 * 500);
    EXPECT_EQ(through, 0);
}

// Each frame of a film has its own cut.
TEST_F(MeshSilhouettes, NothingShowsThroughTheBallInFiveHundredFrames) {
    constexpr unsigned seed = 5233;
    constexpr int frames = 500;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    std::vector<Eye> eyes;
    std::string path = R"({"orograph_path": 1, "keys": [)";
    for (int i = 0; i < frames; ++i) {
        eyes.push_back(random_eye(random));
        path += (i > 0 ? ",\n{\"time_s\": " : "\n{\"time_s\": ") + std::to_string(i) + ", " +
                eyes.back().key + "}";
    }
    const std::string file = (folder_ / "eyes.json").string();
    oro::test::write_bytes(file, path + "]}");
    const auto film = [&](const Words& data, const char* out) {
        const Outcome done = run_orograph(joined({"film", file, "--out", (folder_ / out).string(), "--fps",
                                                  "1", "--size", "64x64", "--tau", "2", "-q"},
                                                 data));
        EXPECT_EQ(done.exit_code, 0) << done.err;
    };
    film({region_, "--mesh", "clusters"}, "with");
    film({bundled()}, "without");
    int within = 0, through = 0;
    for (int i = 0; i < frames; ++i) {
        char name[40];
        std::snprintf(name, sizeof name, "frame-%06d.png", i + 1);
        count_through(eyes[static_cast<std::size_t>(i)], 64, folder_ / "with" / name,
                      folder_ / "without" / name, within, through);
    }
    std::printf("%d pixels within the ball, %d show something else\n", within, through);
    EXPECT_GT(within, frames * 500);
    EXPECT_EQ(through, 0);
}

}  // namespace
