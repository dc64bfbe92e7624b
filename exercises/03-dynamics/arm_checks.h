#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "approach_checks.h"
#include "grading/check.h"
#include "interface.h"
#include "scene/ors_reader.h"
#include "scene/ors_writer.h"

// Arms that the grader simulates while the student's functions control them: parts 4 to 6 and 8.

// One step under what the student's function gave. Forces and speeds of more than this do not come from
// trying to control a small arm, and would only make the simulation fail.
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

// Four seconds under noise, with a push on all joints after one; u(q, v, S) are the forces. Returns the angle
// farthest from zero, step by step.
template <class Force>
inline std::vector<double> shaken(rex::grading::Check& check, rex::Simulator S, const Force& u) {
  S.setDynamicSimulationNoise(1);
  S.setSeed(check.rng().next());
  std::vector<double> farthest;
  for (int step = 0; step < 400; ++step) {
    const Eigen::VectorXd angles = S.getJointAngles();
    if (step == 100) S.setJointAnglesAndVels(angles, S.getJointVels() + Eigen::VectorXd::Ones(angles.size()));
    advance(check, S, u(angles, S.getJointVels(), S));
    farthest.push_back(S.getJointAngles().cwiseAbs().maxCoeff());
    if (step >= 300)
      check.atMost("largest joint speed in the last second", S.getJointVels().cwiseAbs().maxCoeff(), 3,
                   "rad/s");
  }
  return farthest;
}

inline double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}
