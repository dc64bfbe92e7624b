#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "approach_checks.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/inverse_dynamics.h"
#include "grading/check.h"
#include "interface.h"
#include "random_chain.h"

// Part 7: the recursion of Newton and Euler.

// First with everything, then what of it is right.
inline void forcesOf(rex::grading::Check& check, Student& student, const std::vector<ChainLink>& chain,
                     const Eigen::Vector3d& gravity) {
  rex::Rng& rng = check.rng();
  const auto n = static_cast<int>(chain.size());
  const Eigen::VectorXd q = 2 * rng.normalVector(n), v = rng.normalVector(n), a = rng.normalVector(n),
                        none = Eigen::VectorXd::Zero(n);
  const rex::Model model = modelOf(chain);
  const auto forces = [&](const Eigen::VectorXd& rate, const Eigen::VectorXd& acceleration) {
    return rex::inverseDynamics(model, q, rate, acceleration, gravity);
  };
  check.input("a random chain", {{"links", n}, {"q", q}, {"v", v}, {"a", a}, {"gravity", gravity}});
  const Eigen::VectorXd got = student.newtonEuler(chain, q, v, a, gravity), wanted = forces(v, a);
  check.shape("newtonEuler", got, n, 1);
  const double tolerance = 1e-9 * (1 + wanted.norm());
  const auto fits = [&](const Eigen::VectorXd& rate, const Eigen::VectorXd& acceleration) {
    const Eigen::VectorXd one = student.newtonEuler(chain, q, rate, acceleration, gravity);
    return one.size() == n && (one - forces(rate, acceleration)).norm() <= tolerance;
  };
  const bool isWrong = (got - wanted).cwiseAbs().maxCoeff() > tolerance;
  const bool isStill = isWrong && fits(none, a);
  const auto moving =
      check.ask("It is right for v = 0: is a term with velocities missing or wrong?", isStill);
  const auto resting = check.ask(
      "It is wrong even for v = 0 and a = 0: do force and torque reach the link before, with their lever "
      "arms?",
      isWrong && !isStill && n > 1 && !fits(none, none));
  check.near("newtonEuler", got, wanted, tolerance, "N m");
}

inline void newtonAndEuler(rex::grading::Check& check, Student& student) {
  rex::Rng& rng = check.rng();
  const double mass = rng.uniform(0.5, 2), length = rng.uniform(0.3, 1), moment = 0.02;
  const ChainLink link{
      Eigen::Matrix3d::Identity(),         {0, 0, 2}, Eigen::Vector3d::UnitX(), mass, {0, 0, -length},
      moment * Eigen::Matrix3d::Identity()};
  const Eigen::VectorXd q = rng.normalVector(1), v = rng.normalVector(1), a = rng.normalVector(1);
  const double wanted = (mass * length * length + moment) * a[0] + mass * 9.81 * length * std::sin(q[0]);
  check.input("a pendulum (3:21): one link, axis x, its centre of mass below the hinge",
              {{"mass", mass}, {"length", length}, {"inertia", moment}, {"q", q}, {"v", v}, {"a", a}});
  check.near("newtonEuler", student.newtonEuler({link}, q, v, a, {0, 0, -9.81}),
             Eigen::VectorXd::Constant(1, wanted), 1e-9, "N m");
  for (const int n : {1, 2, 3, 7}) forcesOf(check, student, randomChain(rng, n), rex::earthGravity());
}

inline void terms(rex::grading::Check& check, Student& student) {
  rex::Rng& rng = check.rng();
  for (const int n : {2, 5}) {
    const std::vector<ChainLink> chain = randomChain(rng, n);
    const rex::Model model = modelOf(chain);
    const Eigen::VectorXd q = rng.normalVector(n), v = rng.normalVector(n);
    check.input("a random chain", {{"links", n}, {"q", q}, {"v", v}});
    const auto near = [&](const std::string& property, const Eigen::MatrixXd& got,
                          const Eigen::MatrixXd& wanted) {
      check.near(property, got, wanted, 1e-9 * (1 + wanted.norm()));
    };
    const Eigen::MatrixXd M = rex::massMatrix(model, q);
    const Eigen::VectorXd G = rex::gravityForces(model, q),
                          Cv = rex::biasForces(model, q, v, Eigen::Vector3d::Zero());
    near("M of inertiaMatrix", student.inertiaMatrix(chain, q), M);
    near("G of gravityTerm", student.gravityTerm(chain, q, rex::earthGravity()), G);
    near("C v of coriolisTerm", student.coriolisTerm(chain, q, v), Cv);
  }
}
