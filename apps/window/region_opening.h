// Another region, opened in the background while a window goes on to show its own.
#pragma once

#include <atomic>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "apps/drawing/region_scene.h"
#include "apps/project/project_file.h"
#include "apps/view/view.h"

namespace oro {

// All of a region that needs no device.
struct OpenedRegion {
    WindowOptions options;
    std::optional<Project> project;  // whose view it is
    View view;
    Region region;
    RegionCuts cuts;
    GridPages pages;         // all levels, or of every n-th post (first_pages())
    bool canopy_left_out{};  // it is known nowhere over this region

    // The paths as the user knows them.
    [[nodiscard]] std::vector<std::string> paths() const {
        return project ? std::vector{options.view_file} : options.region.paths;
    }
};

class RegionOpening {
  public:
    // Begins to read: what options name, or a project whose view they name. Where no thread is to be had,
    // wait() reads.
    RegionOpening(WindowOptions options, std::optional<Project> project);
    // Waits for the reading.
    ~RegionOpening() = default;
    RegionOpening(const RegionOpening&) = delete;
    RegionOpening& operator=(const RegionOpening&) = delete;

    [[nodiscard]] bool ready() const;
    // How far it is, 0 .. 1, and with what: "reading N46E008.hgt", "measuring levels".
    [[nodiscard]] double share() const { return share_; }
    [[nodiscard]] std::string step() const;
    // What the paths are called in a title.
    [[nodiscard]] const std::string& name() const { return name_; }
    // The region, once: waits for it. Errors: those of open_other_region(), cut_regions() and first_pages().
    Result<OpenedRegion> wait();

  private:
    Result<OpenedRegion> read(OpenedRegion opened);
    void tell(double share, const std::string& step);

    std::string name_;
    std::atomic<double> share_{0.0};
    mutable std::mutex mutex_;
    std::string step_;
    std::future<Result<OpenedRegion>> opened_;  // the last member: it waits for who uses the others
};

}  // namespace oro
