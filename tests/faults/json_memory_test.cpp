// JSON without memory: whichever allocation fails in the making of a text, std::bad_alloc comes out of it,
// and nothing falls over.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <functional>
#include <new>
#include <nlohmann/json.hpp>

#include "apps/accuracy/verification.h"
#include "apps/report/region_json.h"
#include "apps/trade/trade_page.h"
#include "apps/view/view.h"
#include "geo/region/region_description.h"

namespace {

long allocations_left = -1;  // until one fails; below 0: none does

void* allocate(std::size_t size) {
    if (allocations_left > 0 && --allocations_left == 0) throw std::bad_alloc();
    if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) {
    return allocate(size);
}
void* operator new[](std::size_t size) {
    return allocate(size);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete[](void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace {

enum End { made = 0, no_memory = 1, made_without_memory = 2 };

// Where an object is destroyed the library may need memory, too: the program's own way out is this one.
[[noreturn]] void end_without_memory() {
    try {
        if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
        _exit(no_memory);
    } catch (...) {
    }
    std::abort();
}

// What becomes of the process whose allocation number `number` of the making fails.
int status_without(long number, const std::function<std::string()>& make) {
    const pid_t child = fork();
    if (child == 0) {
        std::set_terminate(&end_without_memory);
        int end = made;
        allocations_left = number;
        try {
            (void)make();
            if (allocations_left == 0) end = made_without_memory;
        } catch (const std::bad_alloc&) {
            end = no_memory;
        }
        _exit(end);
    }
    int status = -1;
    waitpid(child, &status, 0);
    return status;
}

void expect_no_fall(const char* what, const std::function<std::string()>& make) {
    for (long number = 1;; ++number) {
        const int status = status_without(number, make);
        ASSERT_TRUE(WIFEXITED(status))
            << what << ", allocation " << number << ": signal " << WTERMSIG(status);
        if (WEXITSTATUS(status) == made) {
            EXPECT_GT(number, 20) << what;
            return;
        }
        ASSERT_EQ(WEXITSTATUS(status), no_memory) << what << ", allocation " << number;
    }
}

oro::View a_view() {
    oro::View view;
    view.region.paths = {"tiles of somewhere/N46E008.SRTMGL3.hgt", "\xFF.hgt"};
    view.region.box = oro::BoundingBox{8.0, 46.0, 8.5, 46.5};
    view.camera.eye = {46.25, 8.25, 4000.0};
    view.sun = oro::SunDirection{270.0, 20.0};
    view.pipeline = "compute";
    view.time_utc_s = 1790000000;
    return view;
}

oro::Region a_region() {
    oro::Region region{std::vector<oro::RegionGrid>(1)};
    region.grids[0].geoid = "EGM96 (egm96_15.gtx), read by PROJ";
    region.grids[0].missing_cells = {"N45E008", "N45E009"};
    region.grids[0].notes = {"a note that is longer than what a string has room for itself"};
    oro::SourceReport source;
    source.path = "tiles of somewhere/N46E008.SRTMGL3.hgt";
    source.vertical_datum.name = "EPSG:5773 EGM96 height, as its CRS says";
    region.grids[0].sources = {source, source};
    return region;
}

TEST(JsonWithoutMemory, OfViews) {
    const oro::View view = a_view();
    expect_no_fall("a view written", [&] { return oro::view_to_json(view, true); });
    const std::string text = oro::view_to_json(view, false);
    expect_no_fall("a view read", [&] { return oro::view_from_json(text, "a picture").ok() ? "" : "no"; });
}

TEST(JsonWithoutMemory, OfRegions) {
    const oro::Region region = a_region();
    expect_no_fall("sources", [&] { return oro::sources_json(region.grids[0].sources).dump(); });
    expect_no_fall("a region's seams and notes", [&] { return oro::region_description(region.grids[0]); });
}

TEST(JsonWithoutMemory, OfMeasurements) {
    expect_no_fall("errors", [] { return oro::verification_json({}).dump(); });
    oro::TradeReport report;
    report.settings.resize(1);
    report.settings[0].key = {oro::EffectKind::float32_view, {}, {}};
    report.settings[0].options = "--tau 0 --heights f32 --earth ellipsoid";
    report.shots.resize(1);
    report.shots[0].view = "far over the Alps";
    report.shots[0].setting = report.settings[0].key;
    report.effects.resize(1);
    report.effects[0].view = "far over the Alps";
    report.effects[0].key = report.settings[0].key;
    report.effects[0].measured_m = 1.0;
    report.pictures = {{"far over the Alps", "as it is seen from 4,000 m", {}}};
    expect_no_fall("a trade", [&] { return oro::trade_page_json(report).dump(); });
}

}  // namespace
