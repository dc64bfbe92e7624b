#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "approach_checks.h"
#include "grading/check.h"
#include "interface.h"
#include "motion_evidence.h"
#include "scene/ors_reader.h"
#include "scene/ors_writer.h"

// Arms that the grader simulates while the student's functions control them: parts 4 to 6 and 8.

// One step under the forces that the student's function returned. Larger forces and speeds than these never
// come from an attempt to control a small arm, and would only make the simulation fail.
inline void advance(rex::grading::Check& check, rex::Simulator& S, const Eigen::VectorXd& u) {
  check.shape("joint forces", u, S.getJointDimension(), 1);
  check.atMost("largest joint force", u.cwiseAbs().maxCoeff(), 1e3, "N m");
  try {
    S.stepDynamics(u, kTau);
  } catch (const rex::Error&) {
    check.that("the motion can be simulated", false);
  }
  check.atMost("largest joint speed", S.getJointVels().cwiseAbs().maxCoeff(), 200, "rad/s");
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

// The motion of an arm, step by step: its posture, and the angle farthest from zero.
struct ArmRecord {
  std::vector<Eigen::VectorXd> moments{};
  std::vector<double> farthest{};
};

// As a film beside the arm at zero.
inline rex::grading::Evidence seen(const rex::Simulator& S, const ArmRecord& record, double limit) {
  if (record.moments.empty()) return {};
  const std::vector<Eigen::VectorXd> wanted{Eigen::VectorXd::Zero(record.moments.front().size())};
  return filmed(S, record.moments, wanted, worstOf(record.farthest, limit),
                curveOf("The joint farthest from zero", "angle [rad]", record.farthest, limit));
}

// Four seconds under noise, with a push on all joints after one second; u(q, v, S) are the forces. The record
// is kept even if a requirement fails.
template <class Force>
inline void shaken(rex::grading::Check& check, rex::Simulator S, ArmRecord& record, const Force& u) {
  S.setDynamicSimulationNoise(1);
  S.setSeed(check.rng().next());
  for (int step = 0; step < 400; ++step) {
    const Eigen::VectorXd angles = S.getJointAngles();
    record.moments.push_back(angles);
    record.farthest.push_back(angles.cwiseAbs().maxCoeff());
    if (step == 100) S.setJointAnglesAndVels(angles, S.getJointVels() + Eigen::VectorXd::Ones(angles.size()));
    advance(check, S, u(angles, S.getJointVels(), S));
    if (step >= 300)
      check.atMost("largest joint speed in the last second", S.getJointVels().cwiseAbs().maxCoeff(), 3,
                   "rad/s");
  }
  record.moments.push_back(S.getJointAngles());
  record.farthest.push_back(S.getJointAngles().cwiseAbs().maxCoeff());
}

inline double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}
