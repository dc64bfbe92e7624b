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

}  // namespace rex::grading
