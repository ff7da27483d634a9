// A smooth flight of the eye from one view to another.
#pragma once

#include "core/earth/camera.h"
#include "core/earth/place_framing.h"

namespace oro {

inline constexpr double shortest_flight_s = 0.3;
inline constexpr double longest_flight_s = 3.0;

// The eye goes along the geodesic, and rises on its way as far as the distance asks for, so that ground
// passes at an even pace; it starts and ends slowly. It takes the longer the farther it goes, and the more it
// turns, within the two limits above. Once it is high over both ends it looks down. Source: J. J. van Wijk
// and W. A. A. Nuij, Smooth and efficient zooming and panning, IEEE InfoVis 2003, eq. 9, rho = 1.42; the
// width of the window there is the eye's height over the ground here.
//     const Flight flight(camera, there, ground_h_m);
//     while (time_s < flight.duration_s()) draw(flight.camera_at(time_s));
class Flight {
  public:
    // ground_h_m is kept and asked at each camera_at(): what it asks outlives the flight.
    Flight(const Camera& from, const Camera& to, GroundHeightAt ground_h_m);

    [[nodiscard]] double duration_s() const { return duration_s_; }
    // At a time since the start: `from` to the bit until 0, `to` from duration_s() on. Between them the eye
    // is at least eye_clearance_m over the ground. Each is a camera to stay at, or to fly on from: a flight
    // is broken off by not asking it any more. Sizes are those of `to`.
    [[nodiscard]] Camera camera_at(double time_s) const;
    [[nodiscard]] const Camera& to() const { return to_; }

  private:
    void choose_path(double from_width_m, double to_width_m);
    [[nodiscard]] double ground_share(double pace) const;
    [[nodiscard]] double width_m(double pace) const;
    [[nodiscard]] double bearing_at_deg(const Geodetic& place, double along_m) const;
    [[nodiscard]] double looks_down(double width_m) const;

    Camera from_;
    Camera to_;
    GroundHeightAt ground_h_m_;
    double distance_m_{};  // over the ground
    double start_bearing_deg_{};
    double from_width_m_{};  // heights over the ground
    double to_width_m_{};
    double start_r_{};  // r0 of the source
    double length_{};   // S of the source
    double duration_s_{};
    double from_turn_deg_{};  // headings, from the geodesic's direction
    double turn_deg_{};       // what the heading turns in all, from that direction
};

}  // namespace oro
