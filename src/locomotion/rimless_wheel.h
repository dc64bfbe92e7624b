#pragma once

#include <optional>
#include <string>

namespace rex {

/// A hub with all the mass on massless spokes that rolls down a slope: the simplest walker. McGeer 1990,
/// Passive dynamic walking; slide 11:18. Its state is the rate omega of the stance spoke just after an
/// impact, rad/s, positive downhill. All functions throw Error for fewer than five spokes, for l or g that
/// are not positive, for a slope outside [0, pi/2), and for a rate that is not finite.
struct RimlessWheel {
  int spokes = 8;
  double slope = 0.08;  ///< radians, downhill
  double l = 1;         ///< length of a spoke, metres
  double g = 9.81;      ///< m/s^2

  /// Half the angle between two spokes, radians.
  [[nodiscard]] double alpha() const;
  /// The rate needed to carry the wheel over its stance spoke: at or below it, the wheel rocks back. 0 if
  /// the slope is as steep as alpha() or steeper.
  [[nodiscard]] double leastRate() const;
  /// The rate after one step, in closed form: omega'^2 = cos^2(2 alpha) (omega^2 + 4 g / l sin(alpha)
  /// sin(slope)). With lower or negative rates it rocks back or rolls uphill. On slopes above alpha() the
  /// uphill spoke lands before the stance spoke is upright.
  struct Step {
    enum class Status {
      kRolled,
      kRockedBack,    ///< not over the stance spoke but back onto the previous one: negative rate
      kRolledUphill,  ///< a negative rate that carries it over, backwards
      kLostContact    ///< the spoke would have to pull at the ground
    };
    Status status = Status::kRolled;
    double rate = 0;  ///< just after the impact, rad/s, about the new stance spoke
    std::string message{};
  };
  [[nodiscard]] Step step(double rate) const;

  /// The rate that a step reproduces, and its multiplier cos^2(2 alpha). Empty on slopes that do not carry
  /// the wheel over the next spoke or on which it loses contact.
  struct FixedPoint {
    double rate = 0, multiplier = 0;
  };
  [[nodiscard]] std::optional<FixedPoint> fixedPoint() const;
};

}  // namespace rex
