#pragma once

#include <optional>
#include <string>

namespace rex {

/// A hub with all the mass and spokes without any that rolls down a slope: the simplest thing that walks.
/// McGeer 1990, Passive dynamic walking; the passive walking of slide 11:18. Its state is the rate omega of
/// the stance spoke just after an impact, rad/s, positive downhill. All functions throw Error for fewer than
/// five spokes, for l or g that are not positive, for a slope outside [0, pi/2), and for a rate that is not
/// finite.
struct RimlessWheel {
  int spokes = 8;
  double slope = 0.08;  ///< radians, downhill
  double l = 1;         ///< length of a spoke, metres
  double g = 9.81;      ///< m/s^2

  /// Half the angle between two spokes, radians.
  [[nodiscard]] double alpha() const;
  /// The rate that just carries the wheel over its stance spoke: at or below it, it rocks back. 0 where the
  /// slope is as steep as alpha().
  [[nodiscard]] double leastRate() const;
  /// The rate after one step, in closed form: omega'^2 = cos^2(2 alpha) (omega^2 + 4 g / l sin(alpha)
  /// sin(slope)). Rates that do not carry it over, and negative ones, rock it back or roll it uphill. On
  /// slopes above alpha() the spoke uphill comes down before the stance spoke is upright.
  struct Step {
    enum class Status {
      kRolled,
      kRockedBack,    ///< not over the stance spoke, back onto the one behind: rate negative
      kRolledUphill,  ///< a negative rate that carries it over, backwards
      kLostContact    ///< the spoke would have to pull at the ground
    };
    Status status = Status::kRolled;
    double rate = 0;  ///< just after the impact, rad/s, seen from the spoke that then stands
    std::string message{};
  };
  [[nodiscard]] Step step(double rate) const;

  /// The rate that a step reproduces, and its multiplier cos^2(2 alpha); none on slopes that do not carry it
  /// over the next spoke, or that make it lose contact.
  struct FixedPoint {
    double rate = 0, multiplier = 0;
  };
  [[nodiscard]] std::optional<FixedPoint> fixedPoint() const;
};

}  // namespace rex
