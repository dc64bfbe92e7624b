#pragma once

#include <array>
#include <vector>

#include <Eigen/Cholesky>

#include "physics/joint_law_internal.h"

namespace rex::internal {

/// The velocities v that minimise (v - M^-1 p)^T M (v - M^-1 p) / 2 plus, for each coordinate, the convex and
/// piecewise linear or quadratic cost whose slopes are the impulses of its goals: motors, friction and limits
/// of joints, solved exactly and together. Block principal pivoting: each coordinate is tried at a goal's
/// velocity or between two, and moves on as long as its impulse or its velocity lies outside. Júdice and
/// Pires, A block principal pivoting algorithm for large-scale strictly monotone linear complementarity
/// problems, 1994.
class JointImpulses {
 public:
  explicit JointImpulses(Eigen::Index count);

  /// Tells what coordinate i is to do in the next step.
  void set(Eigen::Index i, const JointGoals& goals);
  /// Solves for v, which holds the velocities of the last step. M is symmetric and positive definite and is
  /// overwritten. False if none is found, which only rounding can cause.
  bool solve(Eigen::MatrixXd& M, const Eigen::VectorXd& p, Eigen::VectorXd& v);
  /// Forgets where the last solution was, from which the next search begins.
  void reset();

 private:
  // The impulse drops from `highest` to `lowest` where the velocity is this.
  struct Edge {
    double velocity = 0, lowest = 0, highest = 0;
    int purpose = kMotor;
  };
  // An odd place 2 k + 1 is at edge k, an even one, 2 k, below edge k and above the one before.
  struct Coordinate {
    std::array<Edge, 4> edges{};
    int count = 0, place = 0, last = -1;  // last: the purpose at which it was at the end of the last step
    double softening = 0;                 // 1 / softness of the damping
  };

  static void insert(Coordinate& one, const Edge& edge);
  static double impulseAbove(const Coordinate& one, int edges);
  static bool isForbidden(const Coordinate& one);
  bool move(Eigen::Index i, double v, double impulse);
  void begin(const Eigen::VectorXd& v);

  std::vector<Coordinate> coordinates_;
  Eigen::MatrixXd A_;
  Eigen::VectorXd b_, impulse_;
  Eigen::LLT<Eigen::MatrixXd> llt_;
};

}  // namespace rex::internal
