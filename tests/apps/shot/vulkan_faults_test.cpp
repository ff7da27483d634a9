// A GPU that is not as it should be: which device is taken of those that are there, and what is said when its
// memory is full or it is lost, at each single call of Vulkan.
#include "tests/apps/shot/vulkan_faults.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/test_data.h"

namespace {
using nlohmann::json;
using oro::test::bundled;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::FaultyRun;
using oro::test::no_device;
using oro::test::Outcome;
using oro::test::run_with_faults;
using oro::test::Words;

constexpr const char* out_of_memory = "VK_ERROR_OUT_OF_DEVICE_MEMORY";
constexpr const char* lost = "VK_ERROR_DEVICE_LOST";

// A corner of the bundled region, baked: half of what a picture of it takes before its first call of Vulkan
// is for coordinate systems.
std::string corner() {
    static const std::string file = [] {
        std::string path = oro::test::scratch_folder() / "corner.oro";
        const Outcome baked = oro::test::run_orograph(
            {"bake", bundled(), "--bbox=-84.25,36.5,-84.2,36.55", "-q", "--out", path});
        EXPECT_EQ(baked.exit_code, 0) << baked.err;
        return path;
    }();
    return file;
}

// A picture of 36 pages of terrain at most; 124: it hung.
Words shot_in_time(const Words& more) {
    Words words{"timeout", "60",     OROGRAPH_PROGRAM, "shot", corner(), "--style",
                "default", "--size", "64x48",          "-q",   "--out",  "p.png"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}
Words window() {
    return {OROGRAPH_ON_DISPLAY, "timeout", "60",     OROGRAPH_PROGRAM, "view", bundled(),
            "--style",           "default", "--size", "160x120",        "-q"};
}

// The device that draws where the machine has these.
std::string chosen_of(const std::string& devices, const Words& environment = {}) {
    const FaultyRun run = run_with_faults(shot_in_time({"--json"}), "", devices, environment);
    EXPECT_EQ(run.outcome.exit_code, 0) << devices << ": " << run.outcome.err;
    const json said = json::parse(run.outcome.out, nullptr, false);
    return said.is_object() ? said["device"]["name"].get<std::string>() : "";
}

TEST(DeviceChoice, TakesTheBestThatCanDraw) {
    EXPECT_EQ(chosen_of("software S;integrated I;discrete D"), "D");
    EXPECT_EQ(chosen_of("software S;virtual V;integrated I"), "I");
    EXPECT_EQ(chosen_of("software S;virtual V"), "V");
    EXPECT_EQ(chosen_of("discrete A;discrete B"), "A");
    EXPECT_EQ(chosen_of("software S"), "S");
    // A better kind that cannot draw is none.
    EXPECT_EQ(chosen_of("discrete D without mesh_shader,atomics;integrated I"), "I");
    EXPECT_EQ(chosen_of("discrete D without vulkan13;software S"), "S");
    EXPECT_EQ(chosen_of("discrete D without timestamps;software S"), "S");
    EXPECT_EQ(chosen_of("discrete D without addresses;integrated I without mesh_shader,atomics;software S"),
              "S");
    // One way of drawing is enough.
    EXPECT_EQ(chosen_of("discrete D without mesh_shader;integrated I"), "D");
    EXPECT_EQ(chosen_of("discrete D without atomics;integrated I"), "D");
    EXPECT_EQ(chosen_of("integrated I;discrete D without swapchain"), "D");
}

TEST(DeviceChoice, TakesTheOneThatIsNamed) {
    const std::string devices = "software Slow One;integrated Small;discrete Big";
    EXPECT_EQ(chosen_of(devices, {"OROGRAPH_DEVICE=Slow"}), "Slow One");
    EXPECT_EQ(chosen_of(devices, {"OROGRAPH_DEVICE=1"}), "Small");
    const FaultyRun unknown = run_with_faults(shot_in_time({}), "", devices, {"OROGRAPH_DEVICE=Radeon"});
    expect_refusal(unknown.outcome, no_device, {"OROGRAPH_DEVICE", "no device is called 'Radeon'"});
    const FaultyRun unable = run_with_faults(
        shot_in_time({}), "", "software S;discrete Big without mesh_shader,atomics", {"OROGRAPH_DEVICE=Big"});
    expect_refusal(unable.outcome, no_device, {"Big lacks VK_EXT_mesh_shader and 64-bit atomics"});
}

TEST(DeviceChoice, SaysWhatEachOneLacks) {
    const FaultyRun none = run_with_faults(shot_in_time({}), "", "none");
    expect_refusal(none.outcome, no_device, {"no driver answers (no device)", "scripts/set-up"});
    const FaultyRun unable = run_with_faults(
        shot_in_time({}), "", "discrete A without vulkan13;integrated B without addresses,timestamps");
    expect_refusal(unable.outcome, no_device,
                   {"A lacks Vulkan 1.3", "B lacks bufferDeviceAddress, a queue for graphics"});
    const FaultyRun blind = run_with_faults(window(), "", "discrete D without swapchain");
    expect_refusal(blind.outcome, no_device, {"D lacks VK_KHR_swapchain"});
    const FaultyRun refused =
        run_with_faults(shot_in_time({}), "vkCreateDevice 1 VK_ERROR_INITIALIZATION_FAILED", "discrete D");
    expect_refusal(refused.outcome, no_device, {"D: cannot be used", "VK_ERROR_INITIALIZATION_FAILED"});
}

// Of 64 bits of a timestamp a device may count in fewer, which begin anew; the rest is noise.
TEST(DeviceChoice, TimesCountValidBitsAlone) {
    const FaultyRun run =
        run_with_faults(shot_in_time({"--json"}), "", "discrete D without whole_timestamps");
    ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    const json times = json::parse(run.outcome.out)["times_s"];
    for (const char* step : {"gpu_choose", "gpu_raster", "gpu_shade"}) {
        EXPECT_GE(times[step].get<double>(), 0.0) << step;
        EXPECT_LT(times[step].get<double>(), times["draw_and_write"].get<double>()) << step;
    }
}

// What may happen when a call of Vulkan gives an error.
std::set<std::string> results_of(const std::string& call, bool first) {
    std::set<std::string> results{out_of_memory};
    if (first) results.insert("VK_ERROR_OUT_OF_HOST_MEMORY");
    for (const char* one : {"vkCreateDevice", "vkQueueSubmit2", "vkWaitForFences", "vkGetQueryPoolResults",
                            "vkAcquireNextImageKHR", "vkQueuePresentKHR", "vkCreateSwapchainKHR"}) {
        if (call == one) results.insert(lost);
    }
    return results;
}

// One clear line, the right exit code, nothing left behind: neither on the disk nor on the device.
void expect_reported(const FaultyRun& run, const std::string& result) {
    EXPECT_EQ(run.faults, 1);
    expect_refusal(run.outcome, failed, {result});
    EXPECT_EQ(run.files, Words{});
    EXPECT_EQ(run.messages, Words{});
}

// Room for fewer pages was asked for and found: the picture is as good as ever.
bool made_do_with_fewer_pages(const std::string& call, const std::string& result, const FaultyRun& run,
                              const FaultyRun& good) {
    return call == "vkAllocateMemory" && result == out_of_memory && run.outcome.exit_code == 0 &&
           run.calls.at(call) == good.calls.at(call) + 1 && run.files == good.files && run.messages.empty();
}

// The two ways of drawing make mostly the same calls. So the tests take turns: what fails in one does not in
// the other, but for allocations, which decide how many pages there is room for, and for what one way alone
// calls. scripts/faults --long: all in both.
bool is_asked(const std::string& way, const std::string& call, int turn) {
    const char* const runs = std::getenv("OROGRAPH_FAULTS");
    const bool all = runs && std::strtol(runs, nullptr, 10) >= 1000;
    return all || call == "vkAllocateMemory" || call == "vkCreateGraphicsPipelines" ||
           (turn % 2 == 0) == (way == "mesh");
}

class EachCallOfVulkan : public testing::TestWithParam<const char*> {};

TEST_P(EachCallOfVulkan, FailsWithALineAndNothingLeft) {
    const Words words = shot_in_time({"--pipeline", GetParam()});
    const FaultyRun good = run_with_faults(words, "");
    ASSERT_EQ(good.outcome.exit_code, 0) << good.outcome.err;
    EXPECT_EQ(good.messages, Words{});
    EXPECT_EQ(good.files, Words{"p.png"});
    EXPECT_GE(good.calls.size(), 25U);
    int fewer_pages = 0;
    for (const auto& [call, count] : good.calls) {
        int turn = 0;  // begins anew with each call, so that it is the same in both ways
        for (int number = 1; number <= count; ++number) {
            for (const std::string& result : results_of(call, number == 1)) {
                if (!is_asked(GetParam(), call, turn++)) continue;
                const std::string fault = call + " " + std::to_string(number) + " " + result;
                SCOPED_TRACE(fault);
                const FaultyRun run = run_with_faults(words, fault);
                if (made_do_with_fewer_pages(call, result, run, good)) {
                    ++fewer_pages;
                } else {
                    expect_reported(run, result);
                }
            }
        }
    }
    EXPECT_EQ(fewer_pages, 1);
}
INSTANTIATE_TEST_SUITE_P(Pipelines, EachCallOfVulkan, testing::Values("mesh", "compute"),
                         [](const auto& way) { return std::string(way.param); });

// The budget is a wish: a GPU with less room holds fewer pages, and draws the same picture, or says that it
// cannot.
TEST(GpuMemory, FewerPagesAreEnoughWhereTheyAre) {
    const Words words{"timeout", "60",      OROGRAPH_PROGRAM, "shot",    bundled(),
                      "--style", "default", "--size",         "320x240", "--tau",
                      "0",       "-q",      "--out",          "p.png",   "--json"};
    const FaultyRun good = run_with_faults(words, "");
    ASSERT_EQ(good.outcome.exit_code, 0) << good.outcome.err;
    const int pages = json::parse(good.outcome.out)["pages"]["on_gpu"];
    ASSERT_GT(pages, 16);
    // The allocation of pages is the first after the renderer's own.
    int number = 0;
    for (int i = 1; i <= good.calls.at("vkAllocateMemory") && number == 0; ++i) {
        const FaultyRun run =
            run_with_faults(words, "vkAllocateMemory " + std::to_string(i) + " " + out_of_memory);
        if (run.outcome.exit_code != 0) continue;
        number = i;
        const json said = json::parse(run.outcome.out);
        EXPECT_EQ(said["settled"], true);
        EXPECT_LT(said["pages"]["bytes_on_gpu"], json::parse(good.outcome.out)["pages"]["bytes_on_gpu"]);
    }
    EXPECT_GT(number, 0) << "no allocation was tried again with fewer pages";
}

// The device of a window is lost when it shows its so many-th picture. Then the window goes on with another,
// for which orders are counted anew; that is lost, too, and the window ends.
std::string lost_at(int picture) {
    return "vkQueuePresentKHR " + std::to_string(picture) + " " + lost;
}

// Nothing was wrong but what was ordered, and nothing is left behind.
void expect_ended(const FaultyRun& run, const std::string& result) {
    expect_refusal(run.outcome, failed, {result});
    EXPECT_EQ(run.files, Words{});
    EXPECT_EQ(run.messages, Words{});
}

// What a window asks of Vulkan beyond a picture, and a device that is lost in its second frame.
TEST(WindowFaults, EndItWithALine) {
    const FaultyRun good = run_with_faults(window(), lost_at(2));
    EXPECT_EQ(good.faults, 2);
    expect_ended(good, lost);
    for (const char* call :
         {"vkGetPhysicalDeviceSurfaceSupportKHR", "vkGetPhysicalDeviceSurfaceCapabilitiesKHR",
          "vkGetPhysicalDeviceSurfaceFormatsKHR", "vkCreateXcbSurfaceKHR", "vkCreateSemaphore",
          "vkCreateSwapchainKHR", "vkGetSwapchainImagesKHR", "vkAcquireNextImageKHR", "vkQueueSubmit2",
          "vkWaitForFences", "vkQueuePresentKHR"}) {
        ASSERT_TRUE(good.calls.contains(call)) << call;
        for (const std::string& result : results_of(call, false)) {
            const std::string fault = std::string(call) + " 1 " + result;
            SCOPED_TRACE(fault);
            expect_reported(run_with_faults(window(), fault), result);
        }
    }
}

TEST(WindowFaults, SuboptimalSwapchainsAreMadeAnew) {
    for (const char* call : {"vkAcquireNextImageKHR", "vkQueuePresentKHR"}) {
        const FaultyRun run =
            run_with_faults(window(), std::string(call) + " 2 VK_SUBOPTIMAL_KHR;" + lost_at(3));
        expect_ended(run, lost);
        EXPECT_EQ(run.faults, 4) << call;
        EXPECT_EQ(run.calls.at("vkCreateSwapchainKHR"), 4) << call;  // two by each device
    }
}

// Where every image of a window system is suboptimal no better swapchain can be had.
TEST(WindowFaults, OfSuboptimalSwapchainsOneIsEnough) {
    const FaultyRun run =
        run_with_faults(window(), "vkAcquireNextImageKHR 0 VK_SUBOPTIMAL_KHR;" + lost_at(4));
    expect_ended(run, lost);
    EXPECT_EQ(run.calls.at("vkCreateSwapchainKHR"), 4);
}

// A window that nobody sees may be given no image; it goes on, and is shown once it is.
TEST(WindowFaults, AHiddenWindowWaitsForNoImage) {
    const FaultyRun run = run_with_faults(
        window(), "vkAcquireNextImageKHR 2 VK_TIMEOUT;vkAcquireNextImageKHR 3 VK_TIMEOUT;" + lost_at(3));
    expect_ended(run, lost);
    EXPECT_EQ(run.faults, 6);
    EXPECT_EQ(run.calls.at("vkAcquireNextImageKHR"), 10);
}

TEST(WindowFaults, ALostDeviceIsReplacedOnce) {
    const FaultyRun run = run_with_faults(window(), lost_at(3));
    expect_ended(run, lost);
    EXPECT_EQ(run.faults, 2);
    EXPECT_EQ(run.calls.at("vkCreateDevice"), 2);
    EXPECT_EQ(run.calls.at("vkQueuePresentKHR"), 6);
}

// Memory is full, or the device lost, at calls of a window's life: of each kind one in its middle and a late
// one.
TEST(WindowFaults, AtAnyCallEndItWithALine) {
    constexpr int pictures = 4;
    const FaultyRun good = run_with_faults(window(), lost_at(pictures));
    expect_ended(good, lost);
    for (const auto& [call, of_both] : good.calls) {
        // What waits for the end hears of nothing.
        if (call == "vkDeviceWaitIdle") continue;
        // Pages come as they are ready: a device may do with some calls fewer than another.
        const int count = of_both / 2 - of_both / 20;
        for (const int number : std::set<int>{(count + 1) / 2, count}) {
            if (number < 1 || number > count) continue;
            for (const std::string& result : results_of(call, false)) {
                const std::string fault = call + " " + std::to_string(number) + " " + result;
                SCOPED_TRACE(fault);
                const FaultyRun run = run_with_faults(window(), fault + ";" + lost_at(pictures));
                EXPECT_GE(run.faults, 1);
                // Where room for fewer pages is enough the end is that of a lost device.
                expect_refusal(run.outcome, failed, {"VK_ERROR_"});
                EXPECT_EQ(run.files, Words{});
                EXPECT_EQ(run.messages, Words{});
            }
        }
    }
}

}  // namespace
