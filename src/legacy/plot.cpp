#include "legacy/plot.h"

#include <fmt/format.h>

#include "base/error.h"
#include "course/print.h"

namespace rex::legacy {
namespace {

std::vector<double> column(const arr& x, uint j) {
  const Eigen::VectorXd numbers = x.matrix().col(j);
  return {numbers.begin(), numbers.end()};
}

std::vector<double> countUp(uint n) {
  std::vector<double> numbers(n);
  for (uint i = 0; i < n; ++i) numbers[i] = i;
  return numbers;
}

std::string nextName() {
  static int drawn = 0;
  ++drawn;
  return drawn == 1 ? "gnuplot.png" : fmt::format("gnuplot-{}.png", drawn);
}

}  // namespace

void gnuplot(const arr& x) {
  Figure figure{.xLabel = "index", .yLabel = "value"};
  if (x.nd == 2 && x.d1 == 2) {
    figure.xLabel = "column 0";
    figure.yLabel = "column 1";
    figure.series.push_back({.x = column(x, 0), .y = column(x, 1)});
  } else {
    for (uint j = 0; j < (x.nd == 2 ? x.d1 : x.nd); ++j)
      figure.series.push_back(
          {.label = x.nd == 2 ? fmt::format("column {}", j) : "", .x = countUp(x.d0), .y = column(x, j)});
  }
  writeFigure(figure, nextName());
}

}  // namespace rex::legacy
