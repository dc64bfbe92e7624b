#pragma once

#include "dynamics/held_motion_internal.h"
#include "scene/state.h"

namespace rex::internal {

// Each moves q and v on by h, from one state to another that has its sizes already; time is the caller's.

/// Euler's steps: q moves by the old velocity or by the new one.
class Euler {
 public:
  void step(HeldMotion& motion, const State& from, double h, bool withNewVelocity, State& to);

 private:
  Eigen::VectorXd a_{}, d_{};
};

/// The classic one of fourth order. Quaternions take part as four numbers and are made unit ones at the end.
class RungeKutta {
 public:
  void step(HeldMotion& motion, const State& from, double h, State& to);
  /// The acceleration at `from`.
  const Eigen::VectorXd& firstAcceleration() const { return firstAcceleration_; }

 private:
  State stage_{};
  Eigen::VectorXd dq_{}, dv_{}, firstAcceleration_{};
};

/// After Beeman (Some multistep methods for use in molecular dynamics calculations, 1976), with velocities
/// predicted by Adams and Bashforth and corrected by Adams and Moulton. The acceleration at the predicted
/// velocity serves this step and the next.
class Beeman {
 public:
  void step(HeldMotion& motion, const State& from, const VectorArg& u, double h, State& to);
  void reset() { steps_ = 0; }

 private:
  bool continues(const State& from, const VectorArg& u, double h) const;
  void extrapolate(HeldMotion& motion, const State& from, double h, State& to);

  RungeKutta start_{};
  int steps_ = 0;                               // since the start, up to three
  Eigen::VectorXd now_{}, before_{}, first_{};  // the acceleration at `from`, and those at two states before
  Eigen::VectorXd next_{}, d_{};
  State last_{};  // what the last step led to, and what it was told
  Eigen::VectorXd u_{};
  double h_ = 0;
};

/// Half a step with the old velocity, a kick, half a step with the new one. The acceleration of the kick is
/// that in the middle, at the mean of both velocities: with h and -h the same. Where forces depend on q only,
/// this is the textbook's.
class Leapfrog {
 public:
  /// Throws Error naming time, h and the joint that changes most if that acceleration is not found.
  void step(HeldMotion& motion, const State& from, double h, State& to);

 private:
  void findMiddle(HeldMotion& motion, const Eigen::VectorXd& v, double h);

  Eigen::VectorXd q_{}, v_{}, a_{}, next_{}, d_{};
};

}  // namespace rex::internal
