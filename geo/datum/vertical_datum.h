// What heights refer to: geoids and ellipsoidal heights, through PROJ and its grids.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/terrain/post_grid.h"
#include "geo/places/bounding_box.h"

namespace oro {

// The vertical part of a CRS.
struct StatedDatum {
    std::string name;             // "EPSG:5703 NAVD88 height", "ellipsoidal height (WGS 84)"
    double metres_per_unit{1.0};  // negative where the axis points down
    bool is_egm96{false};
};
// Nothing when the CRS (WKT, or a name such as EPSG:4326+5773) has no vertical part.
std::optional<StatedDatum> stated_datum(const std::string& crs);

// A grid of PROJ's on this machine.
struct GridState {
    std::string path;    // "" where PROJ finds none
    std::string damage;  // why it cannot be used; "" where all of it can be read
};
// Reads all of the grids for a CRS's heights (EPSG:4326+5773 for EGM96, +3855 for EGM2008): for `doctor`.
GridState grid_state(const std::string& heights_crs);

struct VerticalLibrary;  // PROJ's context, hidden

// EGM96 and the ways to it. PROJ gives heights back unchanged, without an error, when it lacks a grid; so
// each operation is looked up and its grids are checked before it is used.
class GeoidOfRegion {
  public:
    // Errors: the EGM96 grid is missing and strict is set (else N = 0 stands in, and note() says so); the
    // grid, or PROJ's database, is there and cannot be used.
    static Result<GeoidOfRegion> open(bool strict);
    GeoidOfRegion(GeoidOfRegion&&) noexcept;
    GeoidOfRegion& operator=(GeoidOfRegion&&) noexcept;
    ~GeoidOfRegion();

    [[nodiscard]] const std::string& name() const { return name_; }  // "EGM96 (egm96_15.gtx)"
    [[nodiscard]] const std::string& note() const { return note_; }
    // N over a box whose east may run past 180: at the grid's own nodes, so that interpolating between them
    // is what PROJ does. Errors: N that PROJ does not give, or that is not what GDAL reads in the same grid
    // to within 1 mm (PROJ takes what it fails to read for a value), with the grid's file and the place.
    [[nodiscard]] Result<UndulationField> undulation(const BoundingBox& unwrapped) const;

    // Turns heights of a stated vertical CRS into H above this geoid.
    class Shift {
      public:
        Shift();
        Shift(Shift&&) noexcept;
        Shift& operator=(Shift&&) noexcept;
        ~Shift();
        // Heights in metres at posts along one row; void posts are left alone. Error: 1 mm where the grids
        // are there. Errors: a grid that gives no height inside itself, or not the same twice.
        Result<void> apply(const UndulationField& undulation, double lat_deg, std::span<const double> lon_deg,
                           std::span<float> H_m);
        // True where the way from the stated datum is missing; note() says what of it.
        [[nodiscard]] bool egm96_stands_in() const { return egm96_stands_in_; }
        [[nodiscard]] const std::string& note() const { return note_; }
        [[nodiscard]] bool does_nothing() const { return ways_ == nullptr; }
        // Posts outside the grids, whose heights were left as they are.
        [[nodiscard]] std::size_t beyond_grid() const { return beyond_grid_; }

      private:
        friend class GeoidOfRegion;
        struct Ways;
        Result<bool> is_beyond_grids(double lat_deg, double lon_deg);

        std::unique_ptr<Ways> ways_;
        std::string name_;  // of the datum, in errors
        double metres_per_unit_{1.0};
        bool egm96_stands_in_{};
        std::string note_;
        std::size_t beyond_grid_{};
    };
    // Errors: a grid for the datum is there and damaged; with strict also: the datum is not known, or a grid
    // for it is missing. Without, EGM96 stands in, and the shift's note names what is missing. The shift must
    // not outlive this object.
    [[nodiscard]] Result<Shift> shift_from(const std::string& crs, const BoundingBox& unwrapped,
                                           bool strict) const;

  private:
    GeoidOfRegion();
    std::unique_ptr<VerticalLibrary> library_;
    std::string name_;
    std::string note_;
};

}  // namespace oro
