// Which sight lines of one azimuth may meet unknown ground. Within core; unseen_ground.h says why it is so.
#pragma once

#include <optional>
#include <vector>

#include "core/truth/oracle.h"
#include "core/truth/true_surface.h"
#include "core/unseen/ground_track.h"
#include "core/unseen/known_ground.h"

namespace oro {

// From one elevation to another: angles above the eye's level, as seen (through the air).
struct ElevationInterval {
    double low_rad;
    double high_rad;
};

// Lines of elevations in (low, high] come into `cell` first of all where there are no data.
struct BeyondData {
    ElevationInterval lines;
    UnseenPlace place;
};

class AzimuthSights {
  public:
    // All outlive it. The ceiling is above the ellipsoid.
    AzimuthSights(const Oracle& oracle, const TrueSurface& surface, const KnownGround& known,
                  const Geodetic& eye, const Sight& sight, double ceiling_h_m);

    // What lines meet that never come so low over places without data.
    struct Look {
        std::vector<BeyondData> beyond;  // lowest first
        double ground_below_rad;         // known ground, up to here; ground or sky above
    };
    // `ahead`: a unit ECEF direction across the eye's vertical. `wanted`: nothing need be told of lines
    // outside. Ends that known ground makes are right to `exact_rad`. `guess_rad`: where the first
    // such end may be; gets where it is.
    [[nodiscard]] Look look(const glm::dvec3& ahead, const ElevationInterval& wanted, double exact_rad,
                            std::optional<double>& guess_rad) const;

  private:
    struct Stretch {
        double begin_rad;  // angles along the track
        double end_rad;
    };
    struct Azimuth {
        const GroundTrack& track;
        const glm::dvec3& ahead;
        ElevationInterval wanted;
        double exact_rad;
    };
    [[nodiscard]] std::vector<Stretch> without_data(const GroundTrack& track) const;
    // Of the point at that height over a place of the track.
    [[nodiscard]] double elevation_rad(const Azimuth& azimuth, double angle_rad, double h_m) const;
    // The place of the track over which a height is seen highest up: its horizon; the eye's own from below.
    [[nodiscard]] double horizon_of(const Azimuth& azimuth, double h_m) const;
    // True when known ground before that place is in a line's way.
    [[nodiscard]] bool meets_ground(const Azimuth& azimuth, double elevation, double before_rad) const;
    // The highest elevation that known ground before a place reaches, within `between`.
    [[nodiscard]] double ground_top(const Azimuth& azimuth, double before_rad, ElevationInterval between,
                                    const std::optional<double>& guess_rad) const;
    [[nodiscard]] std::vector<BeyondData> beyond(const Azimuth& azimuth,
                                                 const std::vector<Stretch>& stretches,
                                                 std::optional<double>& guess_rad) const;
    void add(const Azimuth& azimuth, const Stretch& stretch, double top_angle_rad, double floor_rad,
             std::vector<BeyondData>& found) const;

    const Oracle& oracle_;
    const KnownGround& known_;
    Geodetic eye_;
    glm::dvec3 up_;
    const Sight& sight_;
    double ceiling_h_m_;
    double lowest_h_m_;
};

}  // namespace oro
