#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include <Eigen/Eigenvalues>

#include "base/rng.h"
#include "bench/row.h"
#include "control/riccati.h"
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

}  // namespace

std::vector<Row> controlRows() { return {careRow(4), careRow(10), careRow(50)}; }

}  // namespace rex::bench
