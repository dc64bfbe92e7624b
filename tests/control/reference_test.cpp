#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "control/computed_torque.h"
#include "kinematics/task_motion.h"
#include "support/expect_error.h"
#include "support/random_scene.h"

namespace rex::reference_test {

// A robot with joints of all types, also quaternions.
const Model kModel = [] {
  Rng rng(3);
  return compile(randomScene(rng, 14));
}();

Eigen::VectorXd posture(Rng& rng) {
  return integrate(kModel, kModel.initialPositions(), 0.3 * rng.normalVector(kModel.nv()));
}

TEST(Reference, StandsStill) {
  const Reference still = standAt(kModel, kModel.initialPositions());
  EXPECT_EQ(still.q, kModel.initialPositions());
  EXPECT_EQ(still.v, Eigen::VectorXd::Zero(kModel.nv()));
  EXPECT_EQ(still.a, Eigen::VectorXd::Zero(kModel.nv()));
}

// Velocity and acceleration by differences of the postures, of which the frames are those of v.
TEST(Reference, HasTheDerivativesOfItsWay) {
  Rng rng(4);
  const Eigen::VectorXd q0 = posture(rng), qT = posture(rng);
  const double h = 1e-4;
  for (const double t : {0.3, 1., 1.9}) {
    const auto at = [&](double when) {
      return referenceAlong(kModel, q0, qT, 2, when, {.shape = ProfileShape::kMinimumJerk});
    };
    const Reference now = at(t), before = at(t - h), after = at(t + h);
    EXPECT_LT((difference(kModel, before.q, after.q) / (2 * h) - now.v).norm(), 1e-6);
    EXPECT_LT(((after.v - before.v) / (2 * h) - now.a).norm(), 1e-6);
    EXPECT_GT(now.v.norm(), 0.01);
  }
  const Reference start = referenceAlong(kModel, q0, qT, 2, 0), end = referenceAlong(kModel, q0, qT, 2, 5);
  EXPECT_LT(difference(kModel, start.q, q0).norm(), 1e-12);
  EXPECT_LT(difference(kModel, end.q, qT).norm(), 1e-12);
  EXPECT_EQ(end.v, Eigen::VectorXd::Zero(kModel.nv()));
}

TEST(Reference, IsReadFromSamples) {
  Rng rng(5);
  const Eigen::VectorXd q0 = posture(rng), qT = posture(rng);
  double before = 0;
  for (const int steps : {50, 100, 200}) {
    const Eigen::MatrixXd Q = interpolatePostures(kModel, q0, qT, steps);
    double worst = 0;
    for (int i = 1; i < steps; ++i) {
      const Reference exact = referenceAlong(kModel, q0, qT, 2, 2. * i / steps);
      const Reference sampled = referenceAt(kModel, Q, 2. / steps, i);
      EXPECT_EQ(sampled.q, Q.col(i));
      worst = std::max({worst, (sampled.v - exact.v).norm(), (sampled.a - exact.a).norm()});
    }
    EXPECT_LT(worst, 0.01);
    if (before > 0) {  // second order
      EXPECT_NEAR(before / worst, 4, 0.2);
    }
    before = worst;
  }
}

// A motion that is under way at its first and last sample is not kicked there: q0 (+) p(t) direction.
TEST(Reference, IsExactToSecondOrderAtTheEnds) {
  Rng rng(6);
  const Eigen::VectorXd q0 = posture(rng), direction = rng.normalVector(kModel.nv());
  const auto samplesOf = [&](const std::function<double(double)>& p, int count, double tau) {
    Eigen::MatrixXd Q(q0.size(), count);
    for (int i = 0; i < count; ++i) Q.col(i) = integrate(kModel, q0, p(i * tau) * direction);
    return Q;
  };
  for (const int count : {2, 3, 4, 9}) {
    const double tau = 0.1, bend = count > 2 ? 0.3 : 0;
    const Eigen::MatrixXd Q =
        samplesOf([&](double t) { return 0.2 + 0.4 * t + bend * t * t / 2; }, count, tau);
    for (const int i : {0, count - 1}) {
      const Reference end = referenceAt(kModel, Q, tau, i);
      EXPECT_LT((end.v - (0.4 + bend * i * tau) * direction).norm(), 1e-10) << count << ' ' << i;
      EXPECT_LT((end.a - bend * direction).norm(), 1e-10) << count << ' ' << i;
    }
  }
  EXPECT_EQ(referenceAt(kModel, q0, 0.1, 0).v, Eigen::VectorXd::Zero(kModel.nv()));
  Eigen::Vector2d before(0, 0);
  for (const int steps : {40, 80, 160}) {
    const double tau = 1. / steps;
    const Eigen::MatrixXd Q = samplesOf([](double t) { return std::sin(t + 0.5); }, steps + 1, tau);
    Eigen::Vector2d worst(0, 0);
    for (const int i : {0, steps}) {
      const Reference end = referenceAt(kModel, Q, tau, i);
      const double t = i * tau + 0.5;
      worst = worst.cwiseMax(Eigen::Vector2d((end.v - std::cos(t) * direction).norm(),
                                             (end.a + std::sin(t) * direction).norm()));
    }
    for (int k = 0; k < 2 && steps > 40; ++k) EXPECT_NEAR(before[k] / worst[k], 4, 0.5);
    before = worst;
  }
}

TEST(FollowReference, PullsLikeASpringToTheReference) {
  Rng rng(7);
  const Reference reference{posture(rng), rng.normalVector(kModel.nv()), rng.normalVector(kModel.nv())};
  const PdGains gains{.Kp = 7, .Kd = 3};
  EXPECT_LT((followReference(kModel, {reference.q, reference.v}, reference, gains) - reference.a).norm(),
            1e-12);
  const Eigen::VectorXd behind = 0.1 * rng.normalVector(kModel.nv()), slower = rng.normalVector(kModel.nv());
  const State state{integrate(kModel, reference.q, -behind), reference.v - slower};
  EXPECT_LT(
      (followReference(kModel, state, reference, gains) - (reference.a + 7 * behind + 3 * slower)).norm(),
      1e-12);
}

TEST(Reference, RefusesWhatIsNone) {
  const Eigen::VectorXd& q = kModel.initialPositions();
  const Eigen::MatrixXd Q = q.replicate(1, 3);
  const Eigen::VectorXd wrong = Eigen::VectorXd::Zero(2);
  EXPECT_REX_ERROR(standAt(kModel, wrong), "posture q: found a vector of size 2");
  EXPECT_REX_ERROR(referenceAlong(kModel, q, q, 0, 1), "seconds: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(referenceAlong(kModel, q, wrong, 1, 1), "found a vector of size 2");
  EXPECT_REX_ERROR(referenceAt(kModel, Q, 0, 1), "time between samples tau: found 0");
  EXPECT_REX_ERROR(referenceAt(kModel, Q, 1, 3), "sample of a reference: found 3, wanted 0 to 2");
  EXPECT_REX_ERROR(referenceAt(kModel, Q, 1, -1), "sample of a reference: found -1");
  EXPECT_REX_ERROR(referenceAt(kModel, q.replicate(1, 0), 1, 0),
                   "samples of a reference: found none, wanted at least one");
  Reference reference = standAt(kModel, q);
  const State state = initialState(kModel);
  EXPECT_REX_ERROR(followReference(kModel, {q, wrong}, reference, {}), "joint velocities v: found a vector");
  reference.a = wrong;
  EXPECT_REX_ERROR(followReference(kModel, state, reference, {}), "reference accelerations: found a vector");
  reference.v = wrong;
  EXPECT_REX_ERROR(followReference(kModel, state, reference, {}), "reference velocities: found a vector");
}

TEST(Reference, RefusesNumbersThatAreNotFinite) {
  const double nan = std::nan("");
  const Eigen::VectorXd q = kModel.initialPositions();
  Eigen::VectorXd bad = q;
  bad[1] = nan;
  EXPECT_REX_ERROR(standAt(kModel, bad), "posture q: number 1: found nan, wanted a finite number");
  EXPECT_REX_ERROR(referenceAlong(kModel, bad, q, 1, 0), "posture q0: number 1: found nan");
  EXPECT_REX_ERROR(referenceAlong(kModel, q, bad, 1, 0), "posture qT: number 1: found nan");
  EXPECT_REX_ERROR(referenceAlong(kModel, q, q, 1, nan), "time of a motion profile: found nan");
  Eigen::MatrixXd Q = q.replicate(1, 7);
  Q.col(2) = bad;
  for (const int i : {0, 1, 2, 3})
    EXPECT_REX_ERROR(referenceAt(kModel, Q, 1, i), "sample 2 of a reference: number 1: found nan");
  EXPECT_NO_THROW(static_cast<void>(referenceAt(kModel, Q, 1, 6)));
}

TEST(FollowReference, RefusesNumbersThatAreNotFinite) {
  const double nan = std::nan("");
  const Reference good = standAt(kModel, kModel.initialPositions());
  const auto follow = [&](const State& state, const Reference& reference, const PdGains& gains = {}) {
    return followReference(kModel, state, reference, gains);
  };
  State state = initialState(kModel);
  EXPECT_REX_ERROR(follow(state, good, {.Kp = nan}), "gain Kp: found nan, wanted a finite number");
  EXPECT_REX_ERROR(follow(state, good, {.Kd = nan}), "gain Kd: found nan");
  Reference reference = good;
  reference.a[2] = nan;
  EXPECT_REX_ERROR(follow(state, reference), "reference accelerations: number 2: found nan");
  reference.v[1] = nan;
  EXPECT_REX_ERROR(follow(state, reference), "reference velocities: number 1: found nan");
  reference.q[0] = nan;
  EXPECT_REX_ERROR(follow(state, reference), "reference positions: number 0: found nan");
  state.v[3] = nan;
  EXPECT_REX_ERROR(follow(state, good), "joint velocities v: number 3: found nan");
  state.q[3] = nan;
  EXPECT_REX_ERROR(follow(state, good), "joint positions q: number 3: found nan");
}

}  // namespace rex::reference_test
