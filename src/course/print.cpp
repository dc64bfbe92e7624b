#include "course/print.h"

#include <fmt/format.h>

namespace rex {

std::string formatMatrix(const std::string& name, const Eigen::MatrixXd& value) {
  // A column vector reads better as one row.
  const bool isVector = value.cols() == 1 && value.rows() > 1;
  const Eigen::MatrixXd rows = isVector ? Eigen::MatrixXd(value.transpose()) : value;
  std::string text = isVector ? fmt::format("{} ({})\n", name, value.rows())
                              : fmt::format("{} ({} x {})\n", name, value.rows(), value.cols());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    for (Eigen::Index j = 0; j < rows.cols(); ++j) text += fmt::format(" {:>11.6g}", rows(i, j));
    text += '\n';
  }
  return text;
}

void print(const std::string& name, double value) { fmt::print("{} = {:.6g}\n", name, value); }

void print(const std::string& name, const Eigen::MatrixXd& value) {
  fmt::print("{}", formatMatrix(name, value));
}

}  // namespace rex
