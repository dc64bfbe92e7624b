#pragma once

#include <string>
#include <utility>
#include <vector>

#include "approach_checks.h"
#include "formats/ors_reader.h"
#include "formats/ors_writer.h"
#include "grading/check.h"
#include "interface.h"
#include "motion_evidence.h"

// Arms that the grader simulates while the student's functions control them: parts 4 to 6 and 8.

// The motion of an arm over time, and what is required of it.
struct ArmRecord {
  explicit ArmRecord(std::string itsFunction) : function(std::move(itsFunction)) {}

  std::string function;  ///< the student's function that moves it
  std::vector<Eigen::VectorXd> moments{};
  rex::grading::Signal farthest{.axis = "time [s]"}, speeds = farthest, forces = farthest;
  bool isOver = false;  ///< it cannot be simulated any more

  double now() const { return kTau * static_cast<double>(moments.size()); }

  void add(const rex::Simulator& S) {
    farthest.add(now(), S.getJointAngles().cwiseAbs().maxCoeff());
    speeds.add(now(), S.getJointVels().cwiseAbs().maxCoeff());
    moments.push_back(S.getJointAngles());
  }
};

// Larger forces and speeds than these never come from an attempt to control a small arm, and would only make
// the simulation fail.
inline constexpr double kMostForce = 1e3, kMostSpeed = 200;

// Records S and moves it by one step under the forces that the student's function returned.
inline void advance(rex::grading::Check& check, ArmRecord& record, rex::Simulator& S,
                    const Eigen::VectorXd& u) {
  check.shape("joint forces of " + record.function, u, S.getJointDimension(), 1);
  record.forces.add(record.now(), u.cwiseAbs().maxCoeff());
  record.add(S);
  record.isOver = u.cwiseAbs().maxCoeff() > kMostForce;
  if (record.isOver) return;
  try {
    S.stepDynamics(u, kTau);
  } catch (const rex::Error&) {
    record.isOver = true;
  }
  if (S.getJointVels().cwiseAbs().maxCoeff() > kMostSpeed) {
    record.isOver = true;
    record.add(S);
  }
}

// Whether some joint changes the sign of its velocity in each of the last steps.
inline bool alternates(const std::vector<Eigen::VectorXd>& moments) {
  constexpr std::size_t kSteps = 5;
  if (moments.size() < kSteps + 2) return false;
  Eigen::ArrayXd count = Eigen::ArrayXd::Zero(moments[0].size());
  for (std::size_t i = moments.size() - kSteps; i < moments.size(); ++i)
    count += ((moments[i] - moments[i - 1]).array() * (moments[i - 1] - moments[i - 2]).array() < 0)
                 .cast<double>();
  return count.maxCoeff() >= static_cast<double>(kSteps);
}

inline void couldBeSimulated(rex::grading::Check& check, const ArmRecord& record) {
  check.atMostAlong("largest joint force of " + record.function, record.forces, kMostForce, "N m");
  check.atMostAlong("largest joint speed under " + record.function, record.speeds, kMostSpeed, "rad/s");
  check.that("the motion under " + record.function + " can be simulated", !record.isOver);
}

// Every mass of a scene, with its inertia, times a factor between 1 - share and 1 + share.
inline rex::Simulator withOtherMasses(const std::string& scene, double share, rex::Rng& rng) {
  rex::SimulatorDescription description = rex::Simulator(scene).description();
  rex::SceneSpec spec = rex::parseOrs(description.sceneText, description.sceneName).spec;
  for (rex::BodySpec& body : spec.bodies) {
    const double factor = rng.uniform(1 - share, 1 + share);
    body.mass *= factor;
    if (body.inertia) *body.inertia *= factor;
  }
  description.sceneText = rex::writeOrs(spec);
  return rex::Simulator(description);
}

// As a film beside the arm at zero.
inline rex::grading::Evidence seen(const rex::Simulator& S, const ArmRecord& record) {
  return filmed(S, record.moments, {Eigen::VectorXd::Zero(record.moments.front().size())});
}

// Four seconds under noise, with a push on all joints after one second; u(q, v, S) are the forces.
template <class Force>
inline void shaken(rex::grading::Check& check, rex::Simulator S, ArmRecord& record, const Force& u) {
  S.setDynamicSimulationNoise(1);
  S.setSeed(check.rng().next());
  for (int step = 0; step < 400 && !record.isOver; ++step) {
    const Eigen::VectorXd angles = S.getJointAngles();
    if (step == 100) S.setJointAnglesAndVels(angles, S.getJointVels() + Eigen::VectorXd::Ones(angles.size()));
    advance(check, record, S, u(angles, S.getJointVels(), S));
  }
  if (!record.isOver) record.add(S);
}

// What stays within its limits after the push and the noise.
inline void isNearZero(rex::grading::Check& check, const ArmRecord& record, double limit) {
  const auto swings =
      check.ask("A joint changes its direction at every step of 0.01 s: is its damping too large?",
                alternates(record.moments));
  check.atMostAlong("largest |q_i| under " + record.function, record.farthest, limit, "rad");
  couldBeSimulated(check, record);
  rex::grading::Signal atLast{.axis = "time [s]"};
  for (std::size_t i = 301; i < record.speeds.at.size(); ++i)
    atLast.add(record.speeds.at[i], record.speeds.values[i]);
  check.atMostAlong("largest joint speed in the last second under " + record.function, atLast, 3, "rad/s");
}
