#include "grading/check.h"

#include "interface.h"
#include "lyapunov_checks.h"
#include "pendulum_checks.h"
#include "plants.h"

using rex::grading::Check;
using rex::grading::Group;

namespace {

void interpolation(Check& check, Student& student) {
  for (int i = 0; i < 12; ++i) interpolates(check, student, static_cast<Place>(i % 4));
}

void bellmansEquation(Check& check, Student& student) {
  for (int i = 0; i < 5; ++i) sweeps(check, student, randomTable(check.rng()));
}

void torques(Check& check, Student& student) {
  for (int i = 0; i < 10; ++i) choosesTorques(check, student);
}

void horizon(Check& check, Student& student) {
  const Plant mass{(Eigen::Matrix2d() << 1, .1, 0, 1).finished(), Eigen::Vector2d(0, .1)};
  const Costs costs{Eigen::Vector2d(1, 0).asDiagonal(), Eigen::MatrixXd::Constant(1, 1, .1)};
  for (const int count : {1, 2, 20})
    horizonFits(check, student, mass, costs, 5 * Eigen::Matrix2d::Identity(), count);
}

void energy(Check& check, Student& student) {
  for (int i = 0; i < 10; ++i) hasEnergy(check, student, i < 3 ? Pendulum{} : randomPendulum(check.rng()));
}

void pump(Check& check, Student& student) {
  for (int i = 0; i < 10; ++i)
    pumps(check, student, i < 3 ? Pendulum{} : randomPendulum(check.rng()), i % 2 == 1);
}

void lyapunov(Check& check, Student& student) {
  for (const Candidate& candidate : energyCandidates(check.rng()))
    candidateIsJudged(check, student, candidate);
  candidateIsJudged(check, student, farFriction(check.rng()));
  for (const Eigen::Index n : {2, 3})
    for (const Candidate& candidate : cubicCandidates(check.rng(), n))
      candidateIsJudged(check, student, candidate);
  for (const Eigen::Index n : {1, 2, 4}) levelFits(check, student, n);
}

void level(Check& check, Student& student) {
  const Pendulum p;
  const Swing swing = regulatorOf(p);
  fallsBelow(check, student, "a pendulum, u = K x with at most 3 N m",
             regionOf(regulated(p, swing), swing.P));
  for (int i = 0; i < 3; ++i)
    fallsBelow(check, student, "Van der Pol's oscillator, backward in time", randomOscillator(check.rng()));
}

// From below; near upright, where it is caught at once; and from some turns away.
void swings(Check& check, Student& student) {
  swingsUp(check, student, {}, kPi, 1000);
  swingsUp(check, student, {}, -kPi, 1000);
  swingsUp(check, student, {}, 0, 100);
  swingsUp(check, student, {}, 6 * kPi - .05, 100);
  swingsUp(check, student, randomPendulum(check.rng()), 3 * kPi, 1000);
}

void slope(Check& check, Student& student) {
  for (const int N : {2, 1, 10, 30}) slopes(check, student, N);
}

void plan(Check& check, Student& student) {
  plans(check, student, .8, 30);
  plans(check, student, 2.5, 40);
}

// <hidden>
void otherGrids(Check& check, Student& student) {
  check.forEachCase(4, [&](int i) {
    if (i == 3) return climbs(check, student);
    interpolates(check, student, static_cast<Place>(i));
    sweeps(check, student, randomTable(check.rng()));
    choosesTorques(check, student);
  });
}

void otherHorizons(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    rex::Rng& rng = check.rng();
    const int n = 1 + rng.index(4), m = 1 + rng.index(3);
    horizonFits(check, student, randomPlant(rng, n, m),
                {randomPositive(rng, n, .1), randomPositive(rng, m, .2)}, 3 * randomPositive(rng, n, 0),
                1 + rng.index(12));
  });
}

void otherPendulums(Check& check, Student& student) {
  check.forEachCase(10, [&](int i) {
    const Pendulum p = randomPendulum(check.rng());
    hasEnergy(check, student, p);
    pumps(check, student, p, i % 2 == 0);
  });
}

void judgesOthers(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    for (const Candidate& candidate : cubicCandidates(check.rng(), 2 + i % 3))
      candidateIsJudged(check, student, candidate);
    levelFits(check, student, 1 + i);
  });
}

void otherCatches(Check& check, Student& student) {
  check.forEachCase(4, [&](int i) {
    const Pendulum p = randomPendulum(check.rng());
    const Swing swing = regulatorOf(p);
    if (i % 2 == 0)
      fallsBelow(check, student, "a pendulum", regionOf(regulated(p, swing), swing.P));
    else
      fallsBelow(check, student, "an oscillator", randomOscillator(check.rng()));
    swingsUp(check, student, p, (2 * i - 3) * kPi, 800);
  });
}

void otherPlans(Check& check, Student& student) {
  check.forEachCase(4, [&](int i) {
    slopes(check, student, 5 + 10 * i);
    plans(check, student, 1 + .5 * i, 25 + 5 * i);
  });
}
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"interpolation", "values", "V between the nodes, around, and beyond", 1, Group::kVisible,
       interpolation},
      {"bellman", "values", "A sweep of Bellman's equation", 2, Group::kVisible, bellmansEquation},
      {"torques", "values", "The best torque", 1, Group::kVisible, torques},
      {"horizon", "horizon", "Gains for a point mass", 1, Group::kVisible, horizon},
      {"energy", "energy", "The energy", 1, Group::kVisible, energy},
      {"pump", "energy", "The torque that pumps", 1, Group::kVisible, pump},
      {"lyapunov", "lyapunov", "Lyapunov candidates, right and wrong", 2, Group::kVisible, lyapunov},
      {"level", "catch", "The level up to which V falls", 1, Group::kVisible, level},
      {"swing", "catch", "From below to upright", 2, Group::kVisible, swings},
      {"slope", "plan", "The slope of the cost", 1, Group::kVisible, slope},
      {"plan", "plan", "Plans", 1, Group::kVisible, plan},
      // <hidden>
      {"other-grids", "values", "Other grids", 1, Group::kHidden, otherGrids},
      {"other-horizons", "horizon", "Other plants over other horizons", 1, Group::kHidden, otherHorizons},
      {"other-pendulums", "energy", "Other pendulums", 1, Group::kHidden, otherPendulums},
      {"judges-others", "lyapunov", "Other candidates", 1, Group::kHidden, judgesOthers},
      {"other-catches", "catch", "Other pendulums and flows", 1, Group::kHidden, otherCatches},
      {"other-plans", "plan", "Other plans", 1, Group::kHidden, otherPlans},
      // </hidden>
  };
}
