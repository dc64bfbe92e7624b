#pragma once

#include <cmath>
#include <vector>

#include "problems.h"
#include "scenes.h"
#include "trajectory/motion_terms.h"
#include "trajectory/trajectory_optimizer.h"

// Errands for the checks, drawn at random so that nobody knows the way in advance.

/// Balls, where the arm starts among them, and what it is to do. The budget follows from the rest.
struct Scene {
  std::vector<Ball> balls;
  Eigen::VectorXd start;
  Errand errand;
};

/// The same, mirrored at the height of the shoulder at (0, 1) if `mirror`, and turned about the shoulder.
inline Scene turned(Scene scene, double angle, bool mirror) {
  const double sign = mirror ? -1 : 1, cosine = std::cos(angle), sine = std::sin(angle);
  for (Ball& ball : scene.balls) {
    const double y = ball.y, z = sign * (ball.z - 1);
    ball.y = cosine * y - sine * z;
    ball.z = 1 + sine * y + cosine * z;
  }
  for (Eigen::VectorXd* q : {&scene.start, &scene.errand.goal, &scene.errand.detour}) {
    *q *= sign;
    (*q)[0] += angle;
  }
  return scene;
}

/// 25 % above the cost that the library's optimiser reaches from the way through the detour. Over 40 seeds
/// of each scene the reference reaches 0.94 to 1.09 of that cost, and at most 1.21 with another start,
/// penalty or number of samples.
inline double budgetOf(const Scene& scene) {
  const Errand& errand = scene.errand;
  const rex::Simulator S(armAmong(scene.balls, scene.start));
  const rex::ContactModel contacts(S.model());
  std::vector<rex::TrajectoryTerm> terms = rex::restTerms(errand.goal, errand.steps);
  terms.push_back(rex::accelerationTerm());
  terms.push_back(rex::clearanceTerm(S.model(), contacts, {errand.margin, 8}));
  const rex::TrajectoryProblem problem(terms, scene.start.replicate(1, 2), errand.steps, errand.tau);
  const int end = errand.steps - 1;
  Eigen::MatrixXd points = errand.goal.replicate(1, 2);
  points.col(0) = errand.detour;
  const rex::TrajectoryResult least =
      rex::optimizeTrajectory(problem, leastAcceleration(scene.start, points, {end / 2, end}),
                              {.tolerance = 1e-4, .stationarity = 1e-4, .penalty = 3000});
  return 1.25 * least.solution.cost;
}

/// A random scene similar to this one. With larger changes, ways through the detour end in several local
/// minima.
inline Scene drawnLike(Scene scene, rex::Rng& rng) {
  for (Ball& ball : scene.balls) {
    ball.y += rng.uniform(-0.02, 0.02);
    ball.z += rng.uniform(-0.02, 0.02);
    ball.radius -= rng.uniform(0, 0.01);
  }
  scene.start += rng.uniformVector(3, -0.1, 0.1);
  scene.errand.goal += rng.uniformVector(3, -0.1, 0.1);
  scene = turned(scene, rng.uniform(-0.5, 0.5), rng.index(2) == 0);
  scene.errand.budget = budgetOf(scene);
  return scene;
}
