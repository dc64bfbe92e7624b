#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace rex {

/// x' = rate(x, u) with two states and one control, at the cost of the integral of e^(-discount t) cost(x, u)
/// over all times to come (slide 8:10).
struct PlanarControlProblem {
  std::function<Eigen::Vector2d(const Eigen::Vector2d& x, double u)> rate{};
  std::function<double(const Eigen::Vector2d& x, double u)> cost{};  ///< per second, 0 or more
  double uMin = -1, uMax = 1;
  double discount = 0;  ///< per second
};

struct ValueGridOptions {
  Eigen::Vector2d lower{}, upper{};  ///< corners of the region
  Eigen::Vector2i nodes{101, 101};   ///< along each state
  Eigen::Vector2i isAngle{0, 0};     ///< 1: upper is where lower is, as for -pi and pi
  int controls = 21;                 ///< candidates from uMin to uMax
  double step = 0.05;                ///< seconds for which a control is held
  double tolerance = 1e-6;  ///< converged: no value changes by more than this fraction of the largest
  int maxSweeps = 5000;
};

/// The cost of the best motion from each state of a region, for controls that are held for `step` seconds:
/// the Hamilton-Jacobi-Bellman equation in semi-Lagrangian form (Falcone and Ferretti 2014, chapter 5).
/// Values between nodes are bilinear, so their error is of second order in the distance of the nodes where
/// the value is smooth, and larger around kinks and jumps: a motor too weak to stop a pendulum just in time
/// has to swing it up once more. A motion that leaves the region goes on at its border.
class ValueGrid {
 public:
  /// Throws Error for a problem without functions, options out of range, and rates or costs that are not
  /// finite at a node, or costs below 0, with the state.
  ValueGrid(const PlanarControlProblem& problem, const ValueGridOptions& options);

  [[nodiscard]] double value(const Eigen::Vector2d& x) const;
  /// The best of the candidates at x. Calls the functions of the problem.
  [[nodiscard]] double control(const Eigen::Vector2d& x) const;

  /// At the nodes: nodes[0] x nodes[1].
  [[nodiscard]] const Eigen::MatrixXd& values() const { return values_; }
  [[nodiscard]] bool isConverged() const { return isConverged_; }
  /// Nodes from which the best motion leaves the region at once: values there are too small or too large.
  [[nodiscard]] int leaving() const { return leaving_; }
  [[nodiscard]] int sweeps() const { return sweeps_; }
  [[nodiscard]] std::string message() const;

 private:
  struct Place {  // of a state: the cell's node, and how far the state is across the cell
    int node;
    float a, b;
    bool isInside;
  };
  struct Outcome {  // of a control
    Place after;
    double cost;
  };
  [[nodiscard]] double controlAt(int k) const;
  [[nodiscard]] Eigen::Vector2d stateAt(int node) const;
  [[nodiscard]] Place placeOf(const Eigen::Vector2d& x) const;
  [[nodiscard]] double valueAt(const Place& place) const;
  [[nodiscard]] Outcome outcomeOf(const Eigen::Vector2d& x, double u) const;
  void iterate(const std::vector<Outcome>& outcomes);

  PlanarControlProblem problem_;
  ValueGridOptions options_;
  Eigen::MatrixXd values_;
  bool isConverged_ = false;
  int leaving_ = 0, sweeps_ = 0;
};

}  // namespace rex
