#include "control/controllability.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <fmt/format.h>

#include "base/error.h"
#include "control/linear_system_internal.h"
#include "control/require_internal.h"
#include "control/riccati.h"
#include "control/stability.h"

namespace rex {
namespace {

// The dual system: what is found for its B holds for C of the given one.
LinearSystem dual(const LinearSystem& given) {
  const LinearSystem system = completed(given);
  return {.A = system.A.transpose(),
          .B = system.C.transpose(),
          .C = system.B.transpose(),
          .D = system.D.transpose(),
          .step = system.step};
}

// The modes of the block that u does not enter.
std::vector<HiddenMode> hiddenModes(const Eigen::MatrixXd& A, const Eigen::MatrixXd& unreachable) {
  std::vector<HiddenMode> modes;
  if (unreachable.cols() == 0) return modes;
  const Eigen::MatrixXd moved = A * unreachable, block = moved.transpose() * unreachable;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(block);
  for (Eigen::Index i = 0; i < block.rows(); ++i)
    modes.push_back({solver.eigenvalues()[i], (unreachable * solver.eigenvectors().col(i)).normalized()});
  return modes;
}

ReachableStates staircase(const LinearSystem& system, double tolerance, const char* verb) {
  if (!(tolerance > 0 && tolerance < 1))
    throw Error({.what = "tolerance of a rank",
                 .found = fmt::format("{:g}", tolerance),
                 .wanted = "a number between 0 and 1"});
  const Eigen::Index n = system.A.rows();
  const double scaleA = system.A.cwiseAbs().maxCoeff();
  ReachableStates result;
  // Each round adds the directions into which A turns the newest ones; the length of a control's column says
  // nothing about where it leads.
  Eigen::MatrixXd basis(n, 0), next = system.B;
  for (Eigen::Index i = 0; i < next.cols(); ++i)
    if (!next.col(i).isZero(0)) next.col(i) /= next.col(i).cwiseAbs().maxCoeff(), next.col(i).normalize();
  for (double scale = 1; next.cols() > 0 && basis.cols() < n; scale = scaleA) {
    for (int twice = 0; twice < 2; ++twice) {
      const Eigen::MatrixXd known = basis.transpose() * next;
      next -= basis * known;
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(next, Eigen::ComputeThinU);
    const Eigen::Index fresh =
        std::min<Eigen::Index>((svd.singularValues().array() > tolerance * scale).count(), n - basis.cols());
    const Eigen::MatrixXd newest = svd.matrixU().leftCols(fresh);
    basis.conservativeResize(n, basis.cols() + fresh);
    basis.rightCols(fresh) = newest;
    next = system.A * newest;
  }
  result.rank = static_cast<int>(basis.cols());
  result.reachable = basis;
  result.unreachable = Eigen::MatrixXd::Identity(n, n);
  if (result.rank > 0)
    result.unreachable = Eigen::MatrixXd(Eigen::HouseholderQR<Eigen::MatrixXd>(basis).householderQ())
                             .rightCols(n - basis.cols());
  result.modes = hiddenModes(system.A, result.unreachable);
  result.isComplete = result.rank == n;
  result.message = fmt::format("rank {} of {}", result.rank, n);
  for (std::size_t i = 0; i < result.modes.size(); ++i)
    result.message +=
        fmt::format("{} {}", i == 0 ? std::string(": ") + verb + " the mode of eigenvalue" : ",",
                    internal::eigenvalueText(result.modes[i].eigenvalue));
  return result;
}

// M W M^T.
Eigen::MatrixXd carried(const Eigen::MatrixXd& M, const Eigen::MatrixXd& W) { return M * W * M.transpose(); }

// The sum over the first `count` steps, by doubling: W_{2k} = W_k + A^k W_k A^kT.
Eigen::MatrixXd summed(const LinearSystem& system, long count) {
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(system.A.rows(), system.A.rows()), power = system.A,
                  part = system.B * system.B.transpose(),
                  shift = Eigen::MatrixXd::Identity(W.rows(), W.rows());
  for (; count > 0; count /= 2) {
    if (count % 2 == 1) {
      W += carried(shift, part);
      if (count == 1) break;
      shift = (shift * power).eval();
    }
    part += carried(power, part);
    power = (power * power).eval();
  }
  return W;
}

// The integral, by the exponential of (-A BB^T; 0 A^T) over a short time (Van Loan 1978), then doubled.
Eigen::MatrixXd integrated(const LinearSystem& system, double T) {
  const Eigen::Index n = system.A.rows();
  const int doublings =
      std::max(0, static_cast<int>(std::ceil(std::log2(std::max(1e-300, T * system.A.norm())))));
  const double h = std::ldexp(T, -doublings);
  Eigen::MatrixXd generator = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  generator.topLeftCorner(n, n) = -h * system.A;
  generator.topRightCorner(n, n) = system.B * system.B.transpose();
  generator.bottomRightCorner(n, n) = h * system.A.transpose();
  const Eigen::MatrixXd flow = internal::exponential(generator);
  Eigen::MatrixXd power = flow.bottomRightCorner(n, n).transpose(), W = flow.topRightCorner(n, n);
  W = h * (power * W).eval();
  for (int i = 0; i < doublings; ++i) {
    W += carried(power, W);
    power = (power * power).eval();
  }
  return 0.5 * (W + W.transpose());
}

// W for controls in units that make B's largest entry one: next to a large block, the exponential would lose
// the small ones.
template <class Gramian>
Eigen::MatrixXd inUnitsOfB(LinearSystem system, const Gramian& gramian) {
  const double unit = system.B.size() == 0 || system.B.isZero(0) ? 1 : system.B.cwiseAbs().maxCoeff();
  system.B /= unit;
  const Eigen::MatrixXd W = unit * (unit * gramian(system));
  if (!W.allFinite())
    throw Error({.what = "Gramian", .found = "entries that are not finite", .wanted = "a shorter time T"});
  return W;
}

Eigen::MatrixXd gramian(const LinearSystem& given, double T) {
  requirePositive("time T of a Gramian", T);
  if (given.step && !(T / *given.step < 1e15))
    throw Error({.what = "time T of a Gramian",
                 .found = fmt::format("{:g}", T),
                 .wanted = fmt::format("less than 1e15 steps of {:g} s", *given.step)});
  return inUnitsOfB(given, [T](const LinearSystem& system) {
    return system.step ? summed(system, std::lround(T / *system.step)) : integrated(system, T);
  });
}

Eigen::MatrixXd gramian(const LinearSystem& system) {
  const StabilityResult stability = system.step ? discreteStability(system.A) : continuousStability(system.A);
  if (stability.stability != Stability::kAsymptotic)
    throw Error({.what = "Gramian of all time",
                 .found = "a system that is " + stability.message,
                 .wanted = "one that is asymptotically stable"});
  const Eigen::MatrixXd source = system.B * system.B.transpose();
  return system.step ? solveDiscreteLyapunov(system.A.transpose(), source)
                     : solveLyapunov(system.A.transpose(), source);
}

}  // namespace

Eigen::MatrixXd controllabilityMatrix(const LinearSystem& given) {
  const LinearSystem system = completed(given);
  const Eigen::Index n = system.A.rows(), m = system.B.cols();
  Eigen::MatrixXd matrix(n, n * m);
  Eigen::MatrixXd block = system.B;
  for (Eigen::Index i = 0; i < n; ++i, block = (system.A * block).eval()) matrix.middleCols(i * m, m) = block;
  return matrix;
}

Eigen::MatrixXd observabilityMatrix(const LinearSystem& system) {
  return controllabilityMatrix(dual(system)).transpose();
}

ReachableStates controllability(const LinearSystem& system, double tolerance) {
  return staircase(completed(system), tolerance, "the control cannot reach");
}

ReachableStates observability(const LinearSystem& system, double tolerance) {
  return staircase(dual(system), tolerance, "the measurement does not show");
}

Eigen::MatrixXd controllabilityGramian(const LinearSystem& system, double T) {
  return gramian(completed(system), T);
}
Eigen::MatrixXd controllabilityGramian(const LinearSystem& system) { return gramian(completed(system)); }
Eigen::MatrixXd observabilityGramian(const LinearSystem& system, double T) {
  return gramian(dual(system), T);
}
Eigen::MatrixXd observabilityGramian(const LinearSystem& system) { return gramian(dual(system)); }

}  // namespace rex
