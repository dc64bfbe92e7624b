#include "course/print.h"

#include <algorithm>

#include <fmt/format.h>

namespace rex {

std::string formatMatrix(const std::string& name, const Eigen::MatrixXd& value) {
  constexpr Eigen::Index kColumns = 6;  // as many as fit into 80 characters
  // A column vector reads better as one row.
  const bool isVector = value.cols() == 1 && value.rows() > 1;
  const Eigen::MatrixXd rows = isVector ? Eigen::MatrixXd(value.transpose()) : value;
  std::string text = isVector ? fmt::format("{} ({})\n", name, value.rows())
                              : fmt::format("{} ({} x {})\n", name, value.rows(), value.cols());
  for (Eigen::Index first = 0; first < rows.cols(); first += kColumns) {
    const Eigen::Index last = std::min(first + kColumns, rows.cols()) - 1;
    if (rows.cols() > kColumns) text += fmt::format("  {} to {}:\n", first, last);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      for (Eigen::Index j = first; j <= last; ++j) text += fmt::format(" {:>11.6g}", rows(i, j));
      text += '\n';
    }
  }
  return text;
}

void print(const std::string& name, double value) { fmt::print("{} = {:.6g}\n", name, value); }

void print(const std::string& name, const Eigen::MatrixXd& value) {
  fmt::print("{}", formatMatrix(name, value));
}

}  // namespace rex
