#pragma once

#include <string>

#include <Eigen/Core>

namespace rex {

/// Prints a number, vector or matrix to standard output under its name: "J (3 x 7)", then its rows with six
/// digits, six columns at a time.
void print(const std::string& name, double value);
void print(const std::string& name, const Eigen::MatrixXd& value);

/// The text that print() writes.
[[nodiscard]] std::string formatMatrix(const std::string& name, const Eigen::MatrixXd& value);

}  // namespace rex
