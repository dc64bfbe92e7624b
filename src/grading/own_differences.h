#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "grading/check.h"

namespace rex::grading {

// Differences of a student's function beside a Jacobian that it returned, for functions whose values the
// grader does not know. A program that knew which questions serve differences, or what it was asked
// first, could answer them by any slope. So a fresh worker is asked in random order, and some questions come
// twice. If the values are known, compare them and take differences of the known ones.

/// What numericJacobian() asks at x: x itself, then the points around it.
[[nodiscard]] std::vector<Eigen::VectorXd> placesOfDifferences(const Eigen::VectorXd& x);

/// The Jacobian at x by the values at placesOfDifferences(x), in this order.
[[nodiscard]] Eigen::MatrixXd finiteDifferences(std::span<const Eigen::VectorXd> values,
                                                const Eigen::VectorXd& x);

/// Asks a fresh worker for the value of the student's function at a place, and requires its size.
using ValueAt = std::function<Eigen::VectorXd(remote::Caller&, const Eigen::VectorXd& place)>;

/// The values at the places, by a fresh worker, in a random order with repetitions. Requires that `property`,
/// say "y of lookAt", is the same whenever it is asked for, and that of the first place is `first`, which
/// another worker returned.
[[nodiscard]] std::vector<Eigen::VectorXd> valuesInAnyOrder(Check& check, const std::string& property,
                                                            std::span<const Eigen::VectorXd> places,
                                                            const Eigen::VectorXd& first,
                                                            const ValueAt& valueAt);

/// What the student's function returned at a place: a value, and its derivative there.
struct ValueAndDerivative {
  Eigen::VectorXd value{};
  Eigen::MatrixXd derivative{};  ///< a row for each entry of the value
};
using DerivativeAt = std::function<ValueAndDerivative(remote::Caller&, const Eigen::VectorXd& place)>;

/// Requires that the value changes along the straight line between two places by the integral of its
/// derivative, up to a tenth of its range there. So it neither jumps on the way from where the grader knows
/// it to where the derivative is tested, nor is the derivative invented. A fresh worker is asked as in
/// valuesInAnyOrder(); `start` is what another one returned at `from`.
void requireIntegral(Check& check, const std::string& property, const Eigen::VectorXd& from,
                     const Eigen::VectorXd& to, const ValueAndDerivative& start,
                     const DerivativeAt& derivativeAt);

}  // namespace rex::grading
