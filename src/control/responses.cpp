#include "control/responses.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <fmt/format.h>

#include "base/error.h"
#include "control/require_internal.h"
#include "control/stability_internal.h"

namespace rex {
namespace {

using Complex = std::complex<double>;

void requireIndex(const char* what, int index, Eigen::Index count) {
  if (index < 0 || index >= count)
    throw Error(
        {.what = what, .found = fmt::format("{}", index), .wanted = fmt::format("0 to {}", count - 1)});
}

void requireCount(const char* what, int count) {
  if (count < 2 || count > 1000000)
    throw Error({.what = what, .found = fmt::format("{}", count), .wanted = "2 to 1000000"});
}

// The inverse sizes of the columns: scaled by these, fast modes are not mistaken for poles.
Eigen::VectorXd inverseSizes(const Eigen::MatrixXcd& M) {
  const Eigen::VectorXd sizes = M.cwiseAbs().colwise().maxCoeff();
  return sizes.unaryExpr([](double size) { return size > 0 ? 1 / size : 1; });
}

}  // namespace

TimeResponse stepResponse(const LinearSystem& given, int input, double T, int count) {
  LinearSystem system = completed(given);
  requireIndex("input of a step response", input, system.B.cols());
  requirePositive("time T of a step response", T);
  if (system.step) {
    if (T < *system.step || T > 1e6 * *system.step)
      throw Error({.what = "time T of a step response",
                   .found = fmt::format("{:g}", T),
                   .wanted = fmt::format("1 to 1000000 steps of {:g} s", *system.step)});
    count = 1 + static_cast<int>(std::floor(T / *system.step + 1e-9));
  } else {
    requireCount("times of a step response", count);
    system = discretized(system, T / (count - 1));
  }
  TimeResponse response{.y = Eigen::MatrixXd(system.C.rows(), count)};
  Eigen::VectorXd x = Eigen::VectorXd::Zero(system.A.rows());
  for (int i = 0; i < count; ++i) {
    response.times.push_back(i * *system.step);
    response.y.col(i) = system.C * x + system.D.col(input);
    x = (system.A * x + system.B.col(input)).eval();
  }
  return response;
}

FrequencyResponse frequencyResponse(const LinearSystem& given, int input, int output,
                                    const std::vector<double>& frequencies) {
  const LinearSystem system = completed(given);
  requireIndex("input of a frequency response", input, system.B.cols());
  requireIndex("output of a frequency response", output, system.C.rows());
  const Eigen::Index n = system.A.rows();
  FrequencyResponse response{.frequencies = frequencies};
  double before = 0;
  for (const double w : frequencies) {
    if (!(w > before) || !std::isfinite(w))
      throw Error({.what = "frequency",
                   .found = fmt::format("{:g} after {:g}", w, before),
                   .wanted = "a larger one"});
    if (system.step && w * *system.step > std::numbers::pi * (1 + 1e-12))
      throw Error({.what = "frequency",
                   .found = fmt::format("{:g} rad/s", w),
                   .wanted = fmt::format("at most pi / step, {:g} rad/s", std::numbers::pi / *system.step)});
    before = w;
    const Complex s = system.step ? std::polar(1., w * *system.step) : Complex(0, w);
    const Eigen::MatrixXcd pencil = s * Eigen::MatrixXcd::Identity(n, n) - system.A.cast<Complex>();
    const Eigen::VectorXd rows = inverseSizes(pencil.transpose()),
                          columns = inverseSizes(rows.asDiagonal() * pencil);
    // In real form, because the decomposition of complex matrices would take seconds to compile.
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(
        internal::realForm(rows.asDiagonal() * pencil * columns.asDiagonal()));
    if (!(lu.rcond() > 1e-15))
      throw Error({.what = "frequency response",
                   .found = fmt::format("a pole at the frequency {:g} rad/s", w),
                   .wanted = "frequencies next to it"});
    Eigen::VectorXd source = Eigen::VectorXd::Zero(2 * n);
    source.head(n) = rows.cwiseProduct(system.B.col(input));
    const Eigen::VectorXd x = lu.solve(source),
                          measured = columns.cwiseProduct(system.C.row(output).transpose());
    const Complex value(measured.dot(x.head(n)) + system.D(output, input), measured.dot(x.tail(n)));
    response.values.push_back(value);
    response.magnitudes.push_back(20 * std::log10(std::max(std::abs(value), 1e-300)));
    const double phase = std::arg(value) * 180 / std::numbers::pi;
    const double last = response.phases.empty() ? phase : response.phases.back();
    response.phases.push_back(phase + 360 * std::round((last - phase) / 360));
  }
  return response;
}

std::vector<double> frequenciesBetween(double low, double high, int count) {
  requirePositive("lowest frequency", low);
  if (!(high > low) || !std::isfinite(high))
    throw Error({.what = "highest frequency",
                 .found = fmt::format("{:g}", high),
                 .wanted = fmt::format("more than {:g}", low)});
  requireCount("frequencies", count);
  std::vector<double> frequencies;
  for (int i = 0; i < count; ++i) frequencies.push_back(low * std::pow(high / low, i / (count - 1.)));
  return frequencies;
}

}  // namespace rex
