#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include <Eigen/Eigenvalues>

#include "base/rng.h"
#include "bench/robots.h"
#include "bench/row.h"
#include "control/ilqr.h"
#include "control/predictive_controller.h"
#include "control/riccati.h"
#include "control/robot_steps.h"
#ifdef REX_WITH_SLICOT
#include "bench/slicot_peer.h"
#endif

namespace rex::bench {
namespace {

Eigen::MatrixXd randomMatrix(int rows, int columns, Rng& rng) {
  return rng.normalVector(rows * columns).reshaped(rows, columns);
}

struct Problem {
  Eigen::MatrixXd A, B, Q, R;
};

// A random system whose slowest mode decays with 1/10 per second.
Problem stableProblem(int n, Rng& rng) {
  const int m = std::max(1, n / 4);
  Problem problem{randomMatrix(n, n, rng), randomMatrix(n, m, rng), Eigen::MatrixXd::Identity(n, n),
                  Eigen::MatrixXd::Identity(m, m)};
  const double fastest =
      Eigen::EigenSolver<Eigen::MatrixXd>(problem.A, false).eigenvalues().real().maxCoeff();
  problem.A.diagonal().array() -= fastest + 0.1;
  return problem;
}

Row careRow(int n) {
  Rng rng(static_cast<std::uint64_t>(n));
  const auto problem = std::make_shared<const Problem>(stableProblem(n, rng));
  const auto ours = [problem] { return solveCare(problem->A, problem->B, problem->Q, problem->R); };
  if (ours().status != RiccatiStatus::kSolved) throw std::logic_error(ours().message);
  Row row{.name = "care-" + std::to_string(n),
          .ours = timed([=] { (void)ours(); }),
          .peerName = "SLICOT",
          .target = 1.,
          .unit = "us"};
#ifdef REX_WITH_SLICOT
  const auto peer = [problem] { return careBySlicot(problem->A, problem->B, problem->Q); };
  const Eigen::MatrixXd X = ours().X;
  if (!((X - peer()).norm() <= 1e-9 * X.norm())) throw std::logic_error("not the X that SLICOT finds");
  row.peer = timed([=] { (void)peer(); });
#endif
  return row;
}

// Seven joints as double integrators, 20 steps of .05 s ahead, with limits on accelerations, rates and
// positions, on the way of one second from a random posture home: planned anew from the last plan and a state
// that noise has moved.
Row predictiveRow() {
  constexpr int kJoints = 7;
  LinearSystem arm{.A = Eigen::MatrixXd::Zero(2 * kJoints, 2 * kJoints),
                   .B = Eigen::MatrixXd::Zero(2 * kJoints, kJoints)};
  arm.A.topRightCorner(kJoints, kJoints).setIdentity();
  arm.B.bottomRows(kJoints).setIdentity();
  arm = discretized(arm, 0.05);
  PredictiveOptions options{.Q = Eigen::MatrixXd::Identity(2 * kJoints, 2 * kJoints),
                            .R = 0.01 * Eigen::MatrixXd::Identity(kJoints, kJoints)};
  options.uMax.setConstant(kJoints, 2);
  options.uMin = -options.uMax;
  options.xMax.setConstant(2 * kJoints, 1);
  options.xMax.head(kJoints).setConstant(3);
  options.xMin = -options.xMax;
  struct Way {
    PredictiveController controller;
    std::vector<Eigen::VectorXd> states;
    std::vector<PredictedMotion> plans;
  };
  const auto way = std::make_shared<Way>(Way{PredictiveController(arm, options), {}, {}});
  Rng rng(1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2 * kJoints);
  x.head(kJoints) = rng.uniformVector(kJoints, -2.5, 2.5);
  for (int t = 0; t <= 20; ++t) {
    way->states.push_back(x);
    way->plans.push_back(way->controller.plan(x));
    if (way->plans.back().status != QuadraticStatus::kOptimal)
      throw std::logic_error(way->plans.back().message);
    x = arm.A * x + arm.B * way->plans.back().U.col(0) + 0.002 * rng.normalVector(2 * kJoints);
  }
  const auto replan = [way] {
    for (std::size_t t = 1; t < way->states.size(); ++t)
      (void)way->controller.plan(way->states[t], &way->plans[t - 1]);
  };
  return {.name = "predictive-control-arm7",
          .ours = [=, all = timed(replan)] { return all() / 20; },
          .unit = "us"};
}

// Seven joints plan a second to another posture, by ten steps of iLQR with exact derivatives; the peer is
// iLQR with differences.
Row ilqrRow() {
  constexpr int kJoints = 7, kSteps = 30;
  const auto robot = std::make_shared<const Robot>(robots().front());
  const auto steps = std::make_shared<RobotSteps>(robot->model, 1. / kSteps, 2);
  using Eigen::VectorXd;
  const ControlProblem differences{
      .next = [=](const VectorXd& x, const VectorXd& u) { return steps->next(x, u); },
      .stage = [](const VectorXd&, const VectorXd& u, int) -> VectorXd { return 0.02 * u; },
      .final = [=](const VectorXd& x) -> VectorXd {
        VectorXd e = 2 * x;
        e.head(kJoints) = 20 * (x.head(kJoints) - robot->Q.col(0));
        return e;
      },
      .start = VectorXd::Zero(2 * kJoints)};
  ControlProblem exact = differences;
  exact.derivative = [=](const VectorXd& x, const VectorXd& u) { return steps->derivative(x, u); };
  exact.stageDerivative = [](const VectorXd&, const VectorXd&, int) {
    return MotionJacobians{Eigen::MatrixXd::Zero(kJoints, 2 * kJoints),
                           0.02 * Eigen::MatrixXd::Identity(kJoints, kJoints)};
  };
  exact.finalDerivative = [](const VectorXd&) {
    Eigen::MatrixXd J = 2 * Eigen::MatrixXd::Identity(2 * kJoints, 2 * kJoints);
    J.topLeftCorner(kJoints, kJoints) *= 10;
    return J;
  };
  const auto planned = [](const ControlProblem& problem) {
    return ilqr(problem, Eigen::MatrixXd::Zero(kJoints, kSteps), {.maxIterations = 10});
  };
  const double cost = planned(exact).cost;
  if (!(std::abs(planned(differences).cost - cost) <= 1e-6 * cost))
    throw std::logic_error("iLQR plans otherwise with differences");
  return {.name = "ilqr-arm7",
          .ours = timed([=] { (void)planned(exact); }),
          .peerName = "differences",
          .peer = timed([=] { (void)planned(differences); }),
          .target = 0.4,
          .unit = "ms"};
}

}  // namespace

std::vector<Row> controlRows() { return {careRow(50), ilqrRow(), predictiveRow()}; }

}  // namespace rex::bench
