#include <algorithm>
#include <vector>

#include "exercise.h"
#include "show.h"
// <solution headers>
// What a mistake in wrong.cpp takes from the library.
// <todo>
// </solution>

using namespace rex;

Prediction predicted(const Plant& plant, int N) {
  const Eigen::Index n = plant.A.rows(), m = plant.B.cols();
  Prediction p{Eigen::MatrixXd::Zero(N * n, n), Eigen::MatrixXd::Zero(N * n, N * m)};
  // <solution predicted>
  p.Sx.topRows(n) = plant.A;
  p.Su.topLeftCorner(n, m) = plant.B;
  for (int t = 1; t < N; ++t) {
    // x_{t+1} is A x_t, and what u_t adds.
    p.Sx.middleRows(t * n, n) = plant.A * p.Sx.middleRows((t - 1) * n, n);
    p.Su.middleRows(t * n, n) = plant.A * p.Su.middleRows((t - 1) * n, n);
    p.Su.block(t * n, t * m, n, m) = plant.B;
  }
  // <todo>
  //| // TODO: fill Sx and Su, n rows for each step.
  // </solution>
  return p;
}

Quadratic planCost(const Plant& plant, const Costs& costs, int N, const Eigen::VectorXd& x) {
  // <solution planCost>
  const Eigen::Index n = plant.A.rows(), m = plant.B.cols();
  const Prediction p = predicted(plant, N);
  Eigen::MatrixXd weighted = p.Su;
  for (int t = 0; t < N; ++t)
    weighted.middleRows(t * n, n) = (t + 1 < N ? costs.Q : costs.F) * p.Su.middleRows(t * n, n);
  Quadratic cost{2 * p.Su.transpose() * weighted, 2 * weighted.transpose() * (p.Sx * x)};
  for (int t = 0; t < N; ++t) cost.H.block(t * m, t * m, m, m) += 2 * costs.R;
  return cost;
  // <todo>
  //| // TODO: insert the prediction, and collect what is quadratic and what is linear in U.
  //| const Eigen::Index size = N * plant.B.cols();
  //| return {Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size)};
  // </solution>
}

Eigen::MatrixXd costToGo(const Plant& plant, const Eigen::MatrixXd& Q, const Eigen::MatrixXd& R) {
  // <solution costToGo>
  const auto &A = plant.A, &B = plant.B;
  Eigen::MatrixXd F = Q;
  for (int k = 0; k < 10000; ++k) {
    const Eigen::MatrixXd FB = F * B, gain = solve(R + B.transpose() * FB, FB.transpose() * A);
    const Eigen::MatrixXd before = Q + A.transpose() * F * (A - B * gain);
    const double change = (before - F).cwiseAbs().maxCoeff();
    F = .5 * (before + before.transpose());  // rounding errors grow where A is unstable
    if (change < 1e-10 * F.cwiseAbs().maxCoeff()) break;
  }
  return F;
  // <todo>
  //| // TODO: if x^T F x is the cost after one more step, what is the minimum cost before it?
  //| return Q;
  // </solution>
}

Eigen::VectorXd bestMoves(const Quadratic& cost, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                          const Eigen::VectorXd& z) {
  // <solution bestMoves>
  const Eigen::VectorXd slope = cost.H * z + cost.g;
  const Eigen::VectorXd best = z - slope.cwiseQuotient(cost.H.diagonal());
  return best.cwiseMax(lower).cwiseMin(upper) - z;
  // <todo>
  //| // TODO: the minimum of a parabola in z_i, and the bounds.
  //| return Eigen::VectorXd::Zero(z.size());
  // </solution>
}

Eigen::VectorXd boxed(const Quadratic& cost, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  // <solution boxed>
  const int size = static_cast<int>(lower.size());
  Eigen::VectorXd z = Eigen::VectorXd::Zero(size).cwiseMax(lower).cwiseMin(upper);
  std::vector<bool> isHeld(static_cast<std::size_t>(size), false);
  for (;;) {
    // A Newton step of all that are free, as far as the first bound.
    std::vector<int> free;
    for (int i = 0; i < size; ++i)
      if (!isHeld[static_cast<std::size_t>(i)]) free.push_back(i);
    const Eigen::VectorXd slope = cost.H * z + cost.g;
    Eigen::VectorXd step(0);
    if (!free.empty()) step = -solve(cost.H(free, free), slope(free));
    double share = 1;
    int hit = -1;
    for (std::size_t k = 0; k < free.size(); ++k) {
      const double s = step[static_cast<Eigen::Index>(k)];
      const double room = (s > 0 ? upper : lower)[free[k]] - z[free[k]];
      if (s == 0 || room / s >= share) continue;
      share = room / s;
      hit = free[k];
    }
    z(free) += share * step;
    if (hit >= 0) {
      z[hit] = z[hit] - lower[hit] < upper[hit] - z[hit] ? lower[hit] : upper[hit];
      isHeld[static_cast<std::size_t>(hit)] = true;
      continue;
    }
    // The best of what is free. Does one of those at a bound want to leave it?
    const Eigen::VectorXd moves = bestMoves(cost, lower, upper, z);
    int eager = -1;
    for (int i = 0; i < size; ++i)
      if (isHeld[static_cast<std::size_t>(i)] &&
          std::abs(moves[i]) > (eager < 0 ? 1e-10 : std::abs(moves[eager])))
        eager = i;
    if (eager < 0) return z;
    isHeld[static_cast<std::size_t>(eager)] = false;
  }
  // <todo>
  //| // TODO: start within the bounds, and take steps that decrease the cost until no move is left.
  //| return Eigen::VectorXd::Zero(lower.size()).cwiseMax(lower).cwiseMin(upper);
  // </solution>
}

Eigen::MatrixXd planned(const Task& task, const Eigen::VectorXd& x) {
  // <solution planned>
  const Eigen::VectorXd U = boxed(planCost(task.plant, task.costs, task.N, x), task.uMin.replicate(task.N, 1),
                                  task.uMax.replicate(task.N, 1));
  return U.reshaped(task.uMin.size(), task.N);
  // <todo>
  //| // TODO: parts 2 and 3, with the bounds of each step.
  //| return Eigen::MatrixXd::Zero(task.uMin.size(), task.N);
  // </solution>
}

Drive driven(const Task& task, const Eigen::VectorXd& start, const Eigen::MatrixXd& pushes) {
  const Eigen::Index T = pushes.cols();
  Drive drive{Eigen::MatrixXd::Zero(start.size(), T + 1), Eigen::MatrixXd::Zero(task.uMin.size(), T)};
  drive.X.col(0) = start;
  // <solution driven>
  for (Eigen::Index t = 0; t < T; ++t) {
    drive.U.col(t) = planned(task, drive.X.col(t)).col(0);
    drive.X.col(t + 1) = task.plant.A * drive.X.col(t) + task.plant.B * drive.U.col(t) + pushes.col(t);
  }
  // <todo>
  //| // TODO: plan, use the first control, step, repeat.
  // </solution>
  return drive;
}

RateBounds rateBounds(const ArmLimits& limits, const Eigen::VectorXd& q, double tau) {
  // <solution rateBounds>
  const Eigen::VectorXd &most = limits.rateMax, least = -most;
  return {((limits.qMin - q) / tau).cwiseMax(least).cwiseMin(most),
          ((limits.qMax - q) / tau).cwiseMax(least).cwiseMin(most)};
  // <todo>
  //| // TODO: how fast may a joint turn if it has to stop at its limit, and what if it is beyond it already?
  //| return {-limits.rateMax, limits.rateMax};
  // </solution>
}

Quadratic rateCost(const HandTask& task) {
  const Eigen::Index n = task.J.cols();
  Quadratic cost{Eigen::MatrixXd::Zero(n + 1, n + 1), Eigen::VectorXd::Zero(n + 1)};
  // <solution rateCost>
  Eigen::MatrixXd rows(task.J.rows(), n + 1);  // of z, gives the error of the hand's velocity
  rows << task.J, -task.v;
  cost.H = 2 * rows.transpose() * task.W * rows;
  cost.H.diagonal().head(n).array() += 2 * task.damping;
  cost.H(n, n) += 2 * task.slowness;
  cost.g[n] = -2 * task.slowness;
  // <todo>
  //| // TODO: write J w - s v as a matrix times z.
  // </solution>
  return cost;
}

Eigen::VectorXd limitedRates(const HandTask& task, const ArmLimits& limits, const Eigen::VectorXd& q,
                             double tau) {
  // <solution limitedRates>
  const RateBounds rates = rateBounds(limits, q, tau);
  Eigen::VectorXd lower(q.size() + 1), upper(q.size() + 1);
  lower << rates.lower, 0;
  upper << rates.upper, 1;
  return boxed(rateCost(task), lower, upper);
  // <todo>
  //| // TODO: part 3, with the bounds of the rates and of the share.
  //| return Eigen::VectorXd::Zero(q.size() + 1);
  // </solution>
}

Eigen::MatrixXd traced(const Arm& arm, const ArmLimits& limits, const Eigen::VectorXd& q,
                       const Eigen::VectorXd& goal, double pace, double tau, int T) {
  Eigen::MatrixXd Q = q.replicate(1, T + 1);
  // <solution traced>
  const Eigen::Index joints = q.size();
  const Eigen::VectorXd start = arm(q).p;
  double r = 0;
  for (int t = 1; t <= T; ++t) {
    const Hand hand = arm(Q.col(t - 1));
    const double next = std::min(1., r + pace);
    const Eigen::VectorXd v = (start + next * (goal - start) - hand.p) / tau;
    const HandTask task{.J = hand.J, .v = v, .W = Eigen::MatrixXd::Identity(v.size(), v.size())};
    const Eigen::VectorXd z = limitedRates(task, limits, Q.col(t - 1), tau);
    Q.col(t) = Q.col(t - 1) + tau * z.head(joints);
    r += z[joints] * (next - r);
  }
  // <todo>
  //| // TODO: look where the hand is, ask for the next point, step, and remember how far you are.
  // </solution>
  return Q;
}

Eigen::MatrixXd plannedWithin(const Task& task, const Corridor& corridor, const Eigen::VectorXd& x) {
  // <solution plannedWithin>
  // Beside U, wished states Y within the corridor. Whatever separates them from the predicted ones costs.
  const Prediction p = predicted(task.plant, task.N);
  const Quadratic plain = planCost(task.plant, task.costs, task.N, x);
  const Eigen::Index controls = p.Su.cols(), states = p.Su.rows();
  const double w = 2 * corridor.weight;
  const Eigen::VectorXd drift = p.Sx * x;
  Quadratic cost{Eigen::MatrixXd::Identity(controls + states, controls + states) * w,
                 Eigen::VectorXd(controls + states)};
  cost.H.topLeftCorner(controls, controls) = plain.H + w * p.Su.transpose() * p.Su;
  cost.H.bottomLeftCorner(states, controls) = -w * p.Su;
  cost.H.topRightCorner(controls, states) = -w * p.Su.transpose();
  cost.g << plain.g + w * p.Su.transpose() * drift, -w * drift;
  Eigen::VectorXd lower(controls + states), upper(controls + states);
  lower << task.uMin.replicate(task.N, 1), corridor.xMin.replicate(task.N, 1);
  upper << task.uMax.replicate(task.N, 1), corridor.xMax.replicate(task.N, 1);
  return boxed(cost, lower, upper).head(controls).reshaped(task.uMin.size(), task.N);
  // <todo>
  //| // TODO: the cost beyond the corridor is a parabola only outside. Where is it one with bounds?
  //| return planned(task, x);
  // </solution>
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
