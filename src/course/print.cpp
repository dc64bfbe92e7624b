#include "course/print.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "base/error.h"

namespace rex {

namespace {

constexpr int kColumnWidth = 12, kUsualWidth = 80;

int terminalWidth() {
  winsize size{};
  const bool isKnown = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return isKnown ? size.ws_col : kUsualWidth;
}

// At once, so that a pipe has it, too, if the program is stopped later.
void write(const std::string& text) {
  fmt::print("{}", text);
  std::fflush(stdout);
}

}  // namespace

std::string formatMatrix(const std::string& name, const Eigen::MatrixXd& value, int width) {
  const Eigen::Index columns = std::max(1, width / kColumnWidth);
  // A column vector reads better as one row.
  const bool isVector = value.cols() == 1 && value.rows() > 1;
  const Eigen::MatrixXd rows = isVector ? Eigen::MatrixXd(value.transpose()) : value;
  std::string text = isVector ? fmt::format("{} ({})\n", name, value.rows())
                              : fmt::format("{} ({} x {})\n", name, value.rows(), value.cols());
  for (Eigen::Index first = 0; first < rows.cols(); first += columns) {
    const Eigen::Index last = std::min(first + columns, rows.cols()) - 1;
    if (rows.cols() > columns) text += fmt::format("  {} to {}:\n", first, last);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      for (Eigen::Index j = first; j <= last; ++j)
        text += fmt::format(" {:>{}.6g}", rows(i, j), kColumnWidth - 1);
      text += '\n';
    }
  }
  return text;
}

void print(const std::string& name, double value) { write(fmt::format("{} = {:.6g}\n", name, value)); }

void print(const std::string& name, const std::string& text) { write(fmt::format("{} = {}\n", name, text)); }

void print(const std::string& name, const Eigen::MatrixXd& value) {
  write(formatMatrix(name, value, terminalWidth()));
}

void print(const std::string& name, const std::vector<double>& values) {
  print(name, Eigen::MatrixXd(Eigen::Map<const Eigen::VectorXd>(values.data(),
                                                                static_cast<Eigen::Index>(values.size()))));
}

void print(const std::string& name, const std::vector<int>& values) {
  print(name, std::vector<double>(values.begin(), values.end()));
}

void print(const std::string& name, const std::vector<Eigen::VectorXd>& values) {
  const auto hasSize = [&](const Eigen::VectorXd& value) { return value.size() == values.front().size(); };
  if (std::all_of(values.begin(), values.end(), hasSize)) {
    Eigen::MatrixXd rows(values.size(), values.empty() ? 0 : values.front().size());
    for (std::size_t i = 0; i < values.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = values[i];
    return print(name, rows);
  }
  for (std::size_t i = 0; i < values.size(); ++i) print(fmt::format("{}[{}]", name, i), values[i]);
}

void nothingYet(const std::string& what) { fmt::print("Nothing to show yet for {}.\n", what); }

void plot(const std::string& name, const Figure& figure) {
  try {
    writeFigure(figure, name + ".png");
    writeFigure(figure, name + ".svg");
  } catch (const Error& error) {
    // Wrong numbers of one function must not hide what the others draw.
    if (!error.parts().what.starts_with("figure ")) throw;  // not of its numbers
    fmt::print(stderr, "{} is not drawn: {}\n", name, error.what());
  }
}

}  // namespace rex
