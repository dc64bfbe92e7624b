#pragma once

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "support/paths.h"

namespace rex {

inline constexpr const char* kPeerPython = "/usr/bin/python3";  // where Debian's packages are known

/// Skips a test that asks the package cvxopt where it is missing.
#define REX_NEEDS_CVXOPT()                                                  \
  if (!::rex::runProcess({::rex::kPeerPython, "-c", "import cvxopt"}).ok()) \
  GTEST_SKIP() << "python3-cvxopt is not installed"

/// Quadratic programs as in optim/quadratic_program.h, minimised by the package cvxopt.
class QuadraticPeer {
 public:
  struct Minimum {
    double value = NAN;
    Eigen::VectorXd x{};
  };

  void add(const Eigen::MatrixXd& H, const Eigen::VectorXd& g, const Eigen::MatrixXd& A,
           const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
    sizes_.push_back(g.size());
    request_ += fmt::format("{} {} {} {} {} {} {}\n", g.size(), lower.size(), fmt::join(H.reshaped(), " "),
                            fmt::join(g, " "), fmt::join(Eigen::MatrixXd(A.transpose()).reshaped(), " "),
                            fmt::join(lower, " "), fmt::join(upper, " "));
  }

  /// Of all programs added, in their order.
  std::vector<Minimum> minima() const {
    const ProcessResult result = runProcess({kPeerPython, sourcePath("tests/support/quadratic_peer.py")},
                                            {.input = request_, .timeout = 100});
    EXPECT_TRUE(result.ok()) << result.error;
    std::istringstream text(result.output);
    std::vector<Minimum> minima;
    for (const Eigen::Index size : sizes_) {
      Minimum& one = minima.emplace_back();
      one.x.resize(size);
      text >> one.value;
      for (double& number : one.x) text >> number;
    }
    EXPECT_TRUE(text);
    return minima;
  }

 private:
  std::string request_{};
  std::vector<Eigen::Index> sizes_{};
};

}  // namespace rex
