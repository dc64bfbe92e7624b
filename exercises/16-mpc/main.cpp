#include <algorithm>
#include <vector>

#include "exercise.h"
#include "show.h"

using namespace rex;

Prediction predicted(const Plant& plant, int N) {
  const Eigen::Index n = plant.A.rows(), m = plant.B.cols();
  Prediction p{Eigen::MatrixXd::Zero(N * n, n), Eigen::MatrixXd::Zero(N * n, N * m)};
  // TODO: fill Sx and Su, n rows for each step.
  return p;
}

Quadratic planCost(const Plant& plant, const Costs& costs, int N, const Eigen::VectorXd& x) {
  // TODO: insert the prediction, and collect what is quadratic and what is linear in U.
  const Eigen::Index size = N * plant.B.cols();
  return {Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size)};
}

Eigen::MatrixXd costToGo(const Plant& plant, const Eigen::MatrixXd& Q, const Eigen::MatrixXd& R) {
  // TODO: if x^T F x is the cost after one more step, what is the minimum cost before it?
  return Q;
}

Eigen::VectorXd bestMoves(const Quadratic& cost, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                          const Eigen::VectorXd& z) {
  // TODO: the minimum of a parabola in z_i, and the bounds.
  return Eigen::VectorXd::Zero(z.size());
}

Eigen::VectorXd boxed(const Quadratic& cost, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  // TODO: start within the bounds, and take steps that decrease the cost until no move is left.
  return Eigen::VectorXd::Zero(lower.size()).cwiseMax(lower).cwiseMin(upper);
}

Eigen::MatrixXd planned(const Task& task, const Eigen::VectorXd& x) {
  // TODO: parts 2 and 3, with the bounds of each step.
  return Eigen::MatrixXd::Zero(task.uMin.size(), task.N);
}

Drive driven(const Task& task, const Eigen::VectorXd& start, const Eigen::MatrixXd& pushes) {
  const Eigen::Index T = pushes.cols();
  Drive drive{Eigen::MatrixXd::Zero(start.size(), T + 1), Eigen::MatrixXd::Zero(task.uMin.size(), T)};
  drive.X.col(0) = start;
  // TODO: plan, use the first control, step, repeat.
  return drive;
}

RateBounds rateBounds(const ArmLimits& limits, const Eigen::VectorXd& q, double tau) {
  // TODO: how fast may a joint turn if it has to stop at its limit, and what if it is beyond it already?
  return {-limits.rateMax, limits.rateMax};
}

Quadratic rateCost(const HandTask& task) {
  const Eigen::Index n = task.J.cols();
  Quadratic cost{Eigen::MatrixXd::Zero(n + 1, n + 1), Eigen::VectorXd::Zero(n + 1)};
  // TODO: write J w - s v as a matrix times z.
  return cost;
}

Eigen::VectorXd limitedRates(const HandTask& task, const ArmLimits& limits, const Eigen::VectorXd& q,
                             double tau) {
  // TODO: part 3, with the bounds of the rates and of the share.
  return Eigen::VectorXd::Zero(q.size() + 1);
}

Eigen::MatrixXd traced(const Arm& arm, const ArmLimits& limits, const Eigen::VectorXd& q,
                       const Eigen::VectorXd& goal, double pace, double tau, int T) {
  Eigen::MatrixXd Q = q.replicate(1, T + 1);
  // TODO: look where the hand is, ask for the next point, step, and remember how far you are.
  return Q;
}

Eigen::MatrixXd plannedWithin(const Task& task, const Corridor& corridor, const Eigen::VectorXd& x) {
  // TODO: the cost beyond the corridor is a parabola only outside. Where is it one with bounds?
  return planned(task, x);
}

// What follows is given, and never graded: change it as you like. show.h says what each line draws.

int main() {
  const Task trolley = trolleyTask();
  // Part 1: what the prediction says, and what happens.
  showPrediction(trolley.plant);
  // Part 2: how much the horizon matters, and how little if F is right.
  showHorizons(trolley);
  // Part 3: why the constrained optimum is not the clipped one.
  showBox();
  // Part 4: a trolley that must brake in time, and a pole that a weak motor keeps upright.
  showTrolley(trolley);
  showPole();
  // Part 5: a hand that shall move faster than its joints may turn, on a line that leads to their limits.
  showLine();
  // Part 6: a wall.
  showWall(trolley);
}
