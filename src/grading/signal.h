#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "render/figure.h"

namespace rex::grading {

/// A quantity along a motion: values[i] belongs to at[i], a step or a time. All have the same size.
struct Signal {
  std::string axis = "step";  ///< with its unit, if it has one: "time [s]"
  std::vector<double> at{};
  std::vector<Eigen::VectorXd> values{};

  void add(double place, const Eigen::VectorXd& value);
  void add(double place, double value);
};

/// The vectors at steps 1, 2, ...
[[nodiscard]] Signal overSteps(const std::vector<Eigen::VectorXd>& values);

/// Where a signal breaks a rule.
struct Breaches {
  std::optional<std::size_t> first{};
  std::size_t worst = 0;
  double most = 0;                 ///< the excess there
  Eigen::VectorXd ofComponents{};  ///< the largest excess of each
};
/// By the excess of all values, which is at most 0 where the rule holds; NaN counts as infinite. There must
/// be one at least, and all must have the same size.
[[nodiscard]] Breaches findBreaches(const std::vector<Eigen::VectorXd>& beyond);

/// Place i in words: "step 7", "time 0.35 s".
[[nodiscard]] std::string placeText(const Signal& signal, std::size_t i);

/// The signal over its axis next to the wanted one, which may be empty, and a mark at place `first`, from
/// which it is wrong. Of several components at most four: those with the largest `excess`, which has their
/// number. Leaves out what is not finite.
[[nodiscard]] Figure signalFigure(const std::string& title, const Signal& signal,
                                  const std::vector<Eigen::VectorXd>& wanted, const Eigen::VectorXd& excess,
                                  std::size_t first, std::string_view unit);

}  // namespace rex::grading
