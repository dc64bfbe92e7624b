#pragma once

#include <string>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "control/riccati.h"
#include "exercise.h"
#include "grading/check.h"
#include "systems/cart_pole.h"

// The plants and costs of the checks.

inline rex::CartPoleDynamics dynamicsOf(const PoleCart& cart) {
  return {.poleMass = cart.poleMass, .cartMass = cart.cartMass, .l = cart.l, .g = cart.g};
}

inline Plant plantOf(const PoleCart& cart) {
  const rex::LinearizedPlant plant = dynamicsOf(cart).linearized(Eigen::Vector4d::Zero(), 0);
  return {plant.A, plant.B};
}

inline PoleCart randomCart(rex::Rng& rng) {
  return {.poleMass = rng.uniform(.3, 2),
          .cartMass = rng.uniform(.5, 2),
          .l = rng.uniform(.4, 1.4),
          .g = rng.uniform(1.6, 12)};
}

inline std::string described(const PoleCart& cart) {
  return fmt::format("M_p = {:g}, M_c = {:g}, l = {:g}, g = {:g}", cart.poleMass, cart.cartMass, cart.l,
                     cart.g);
}

/// What a check says about a task: `text`, and the plant by its values, with more of them.
inline void describe(rex::grading::Check& check, const std::string& text, const Plant& plant) {
  check.input(text, {{"A", plant.A}, {"B", plant.B}});
}

inline void describe(rex::grading::Check& check, const std::string& text, const Plant& plant,
                     const Costs& costs) {
  check.input(text, {{"A", plant.A}, {"B", plant.B}, {"Q", costs.Q}, {"R", costs.R}});
}

/// The costs of the sheet, with c = rho = 1.
inline Costs costsOfTheSheet() {
  return {Eigen::Vector4d(1, 0, 1, 0).asDiagonal(), Eigen::MatrixXd::Identity(1, 1)};
}

inline Eigen::MatrixXd randomMatrix(rex::Rng& rng, Eigen::Index rows, Eigen::Index cols) {
  return rng.normalVector(static_cast<int>(rows * cols)).reshaped(rows, cols);
}

/// Symmetric, with eigenvalues from `least` up.
inline Eigen::MatrixXd randomPositive(rex::Rng& rng, Eigen::Index n, double least) {
  const Eigen::MatrixXd root = randomMatrix(rng, n, n) / std::sqrt(static_cast<double>(n));
  return root * root.transpose() + least * Eigen::MatrixXd::Identity(n, n);
}

/// A random change of coordinates of n states, in which no zero entry stays zero.
inline Eigen::MatrixXd randomCoordinates(rex::Rng& rng, Eigen::Index n) {
  for (;;) {
    const Eigen::MatrixXd T = Eigen::MatrixXd::Identity(n, n) + .5 * randomMatrix(rng, n, n);
    if (n == 0 || Eigen::JacobiSVD<Eigen::MatrixXd>(T).singularValues()[n - 1] > .25) return T;
  }
}

/// The same plant, with T x as its state.
inline Plant inCoordinates(const Plant& plant, const Eigen::MatrixXd& T) {
  const Eigen::MatrixXd back = rex::inverse(T);
  return {T * plant.A * back, T * plant.B};
}

inline Plant randomPlant(rex::Rng& rng, Eigen::Index n, Eigen::Index m) {
  return {randomMatrix(rng, n, n) / std::sqrt(static_cast<double>(n)), randomMatrix(rng, n, m)};
}

/// Two plants side by side; u moves only the first.
inline Plant besideUnmoved(const Plant& moved, const Eigen::MatrixXd& unmoved) {
  const Eigen::Index n = moved.A.rows(), k = unmoved.rows(), m = moved.B.cols();
  Plant both{Eigen::MatrixXd::Zero(n + k, n + k), Eigen::MatrixXd::Zero(n + k, m)};
  both.A.topLeftCorner(n, n) = moved.A;
  both.A.bottomRightCorner(k, k) = unmoved;
  both.B.topRows(n) = moved.B;
  return both;
}

inline double abscissa(const Eigen::MatrixXd& A) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues().real().maxCoeff();
}

struct Regulation {
  Plant plant;
  Costs costs;
  rex::RiccatiResult optimal;  ///< with the library's sign, u = -K x
};

inline Regulation regulationOf(const Plant& plant, const Costs& costs) {
  return {plant, costs, rex::solveCare(plant.A, plant.B, costs.Q, costs.R)};
}

/// A task of two states whose P can be computed even with usual mistakes in the Hamiltonian matrix.
inline Regulation smallRegulation() {
  Plant plant{Eigen::MatrixXd(2, 2), Eigen::MatrixXd(2, 2)};
  plant.A << 1, .5, .25, -2;
  plant.B << 1, .5, 0, 1;
  Costs costs{Eigen::MatrixXd(2, 2), Eigen::MatrixXd(2, 2)};
  costs.Q << 1, .2, .2, 2;
  costs.R << 4, 1, 1, 2;
  return regulationOf(plant, costs);
}

/// A random task whose closed loop is neither slow nor fast, so that the iteration of the sheet converges
/// with epsilon = 0.005, and whose P is not large. If `hasUnmoved`, it has a mode that u does not reach and
/// that decays by itself.
inline Regulation randomRegulation(rex::Rng& rng, bool hasUnmoved) {
  for (;;) {
    const Eigen::Index n = 1 + rng.index(4), m = 1 + rng.index(2);
    Plant plant = randomPlant(rng, n, m);
    if (hasUnmoved) {
      plant = besideUnmoved(plant, Eigen::MatrixXd::Constant(1, 1, -rng.uniform(.5, 2)));
      plant = inCoordinates(plant, randomCoordinates(rng, n + 1));
    }
    const Costs costs{randomPositive(rng, plant.A.rows(), .2), randomPositive(rng, m, .5)};
    Regulation found = regulationOf(plant, costs);
    if (found.optimal.status != rex::RiccatiStatus::kSolved || found.optimal.X.norm() > 50) continue;
    const Eigen::VectorXcd poles = found.optimal.closedLoop;
    if (poles.real().maxCoeff() < -.25 && poles.cwiseAbs().maxCoeff() < 10) return found;
  }
}

/// A task with a pole some thousand times as fast as the others, too stiff for an iteration in small steps.
inline Regulation stiffRegulation(rex::Rng& rng) {
  Plant plant = besideUnmoved(randomRegulation(rng, false).plant, Eigen::MatrixXd::Constant(1, 1, -3e3));
  plant.B.bottomRows(1).setOnes();
  plant = inCoordinates(plant, randomCoordinates(rng, plant.A.rows()));
  return regulationOf(plant,
                      {randomPositive(rng, plant.A.rows(), .2), randomPositive(rng, plant.B.cols(), .5)});
}
