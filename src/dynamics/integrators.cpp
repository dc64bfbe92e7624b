#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "dynamics/integrators_internal.h"
#include "scene/coordinates.h"

namespace rex::internal {

void Euler::step(HeldMotion& motion, const State& from, double h, bool withNewVelocity, State& to) {
  a_.resizeLike(from.v);
  motion.accelerate(from.q, from.v, a_);
  to.v = from.v + h * a_;
  d_ = h * (withNewVelocity ? to.v : from.v);
  to.q = from.q;
  motion.move(to.q, d_);
}

void RungeKutta::step(HeldMotion& motion, const State& from, double h, State& to) {
  constexpr std::array<double, 4> kShareOfStep{0, 0.5, 0.5, 1}, kWeight{1. / 6, 1. / 3, 1. / 3, 1. / 6};
  dq_.setZero(from.q.size());
  dv_.setZero(from.v.size());
  to.q = from.q;
  to.v = from.v;
  for (std::size_t i = 0; i < kWeight.size(); ++i) {
    stage_.q = from.q + kShareOfStep[i] * h * dq_;
    stage_.v = from.v + kShareOfStep[i] * h * dv_;
    motion.rate(stage_.q, stage_.v, dq_);
    motion.accelerate(stage_.q, stage_.v, dv_);
    if (i == 0) firstAcceleration_ = dv_;
    to.q += kWeight[i] * h * dq_;
    to.v += kWeight[i] * h * dv_;
  }
  motion.normalize(to.q);
}

bool Beeman::continues(const State& from, const VectorArg& u, double h) const {
  return steps_ > 0 && h == h_ && from.q == last_.q && from.v == last_.v && u == u_;
}

void Beeman::step(HeldMotion& motion, const State& from, const VectorArg& u, double h, State& to) {
  constexpr int kStartingSteps = 2;
  if (!continues(from, u, h)) steps_ = 0;
  if (steps_ < kStartingSteps) {
    start_.step(motion, from, h, to);
    first_.swap(before_);
    before_ = start_.firstAcceleration();
  } else {
    now_.resizeLike(from.v);
    if (steps_ == kStartingSteps) motion.accelerate(from.q, from.v, now_);
    extrapolate(motion, from, h, to);
  }
  steps_ = std::min(steps_ + 1, kStartingSteps + 1);
  last_.q = to.q;
  last_.v = to.v;
  u_ = u;
  h_ = h;
}

void Beeman::extrapolate(HeldMotion& motion, const State& from, double h, State& to) {
  to.q = from.q;
  to.v = from.v + h / 12 * (23 * now_ - 16 * before_ + 5 * first_);
  d_ = h * from.v + h * h / 24 * (19 * now_ - 10 * before_ + 3 * first_);
  // Turns about a moving axis do not simply add up: this is the next term of Magnus (1954).
  for (const HeldMotion::QuaternionPlace& at : motion.quaternions())
    d_.segment<3>(at.vIndex) += h * h / 12 * from.v.segment<3>(at.vIndex).cross(to.v.segment<3>(at.vIndex));
  motion.move(to.q, d_);
  next_.resizeLike(from.v);
  motion.accelerate(to.q, to.v, next_);
  to.v = from.v + h / 24 * (9 * next_ + 19 * now_ - 5 * before_ + first_);
  first_.swap(before_);
  before_.swap(now_);
  now_.swap(next_);
}

void Leapfrog::step(HeldMotion& motion, const State& from, double h, State& to) {
  q_ = from.q;
  d_ = h / 2 * from.v;
  motion.move(q_, d_);
  findMiddle(motion, from.v, h);
  to.v = from.v + h * a_;
  to.q = q_;
  d_ = h / 2 * to.v;
  motion.move(to.q, d_);
}

void Leapfrog::findMiddle(HeldMotion& motion, const Eigen::VectorXd& v, double h) {
  constexpr int kMostIterations = 100;
  constexpr double kSmall = 1e-9;
  a_.resizeLike(v);
  next_.resizeLike(v);
  motion.accelerate(q_, v, a_);
  double change = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostIterations; ++i) {
    v_ = v + h / 2 * a_;
    motion.accelerate(q_, v_, next_);
    const double before = change;
    change = (next_ - a_).lpNorm<Eigen::Infinity>();
    a_.swap(next_);
    // Changes that are small and no longer shrink are rounding.
    const bool isSmall =
        change <= kSmall * (a_.lpNorm<Eigen::Infinity>() + v.lpNorm<Eigen::Infinity>() / std::abs(h));
    if (change == 0 || (isSmall && change >= before / 2)) return;
  }
  Eigen::Index most = 0;
  (next_ - a_).cwiseAbs().maxCoeff(&most);
  throw Error(
      {.what = fmt::format(
           "joint '{}': its acceleration in the middle of the leapfrog step to {:g} s does not converge",
           jointOfVelocity(motion.model(), most).name, motion.time()),
       .found = fmt::format("a step of {:g} s", h),
       .wanted = "a shorter one"});
}

}  // namespace rex::internal
