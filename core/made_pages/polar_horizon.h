// Which directions the ground around an eye hides, whatever is farther away, from parts of that ground in any
// order of azimuths.
#pragma once

#include <cstddef>
#include <vector>

namespace oro {

// Cells around an eye, by azimuth and by distance across its vertical. Tangents are of the angle over the
// plane that is level at the eye. One thread.
class PolarHorizon {
  public:
    // Azimuths within half_rad of 0 (pi: all around), distances below reach_m in steps of step_m.
    PolarHorizon(double half_rad, double reach_m, double step_m);

    // A place around which, so far in azimuth and in distance, ground is no lower than tangent says:
    // -infinity where it may be anything. All ground of a cell must have been taken, or what is beside it,
    // for the cell to hide anything.
    void take(double azimuth_rad, double around_rad, double nearest_m, double farthest_m, float tangent);
    // Ground nearer than this has been taken.
    void finish_to(double distance_m);
    // The least, over some azimuths, of what the cells that are wholly nearer hide everything below; they
    // are finished.
    [[nodiscard]] float hidden_below(double from_rad, double to_rad, double distance_m) const;

  private:
    [[nodiscard]] std::size_t at(int bin, int ring) const {
        return static_cast<std::size_t>(ring) * static_cast<std::size_t>(bins_) +
               static_cast<std::size_t>(bin);
    }
    template <class Asked>
    void each_bin(double from_rad, double to_rad, const Asked& asked) const;

    bool is_whole_;  // all around
    double half_rad_, bin_rad_, step_m_;
    int bins_, rings_, finished_{};
    std::vector<float> least_;   // of what was taken in a cell
    std::vector<float> hidden_;  // of a cell's azimuths: by all nearer ones
};

}  // namespace oro
