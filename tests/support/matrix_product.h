#pragma once

#include <initializer_list>

#include <Eigen/Core>

namespace rex {

/// The product of at least one matrix. Eigen compiles each kind of product of expressions by itself, which
/// takes seconds in a test full of formulas.
inline Eigen::MatrixXd product(std::initializer_list<Eigen::MatrixXd> factors) {
  Eigen::MatrixXd all = *factors.begin();
  for (const Eigen::MatrixXd* factor = factors.begin() + 1; factor != factors.end(); ++factor)
    all = all * *factor;
  return all;
}

}  // namespace rex
