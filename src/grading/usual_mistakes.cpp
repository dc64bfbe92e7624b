#include "grading/usual_mistakes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace rex::grading {
namespace {

using Eigen::Index;

constexpr double kDegree = std::numbers::pi / 180;

/// Tries what a wrong value would be without a mistake.
class Diagnosis {
 public:
  Diagnosis(const MatrixArg& got, const MatrixArg& wanted, double tolerance, std::string_view unit)
      : got_(got), wanted_(wanted), size_(wanted.cwiseAbs().maxCoeff()), unit_(unit) {
    constexpr double kRounding = 1e-9;
    limit_ = std::max(tolerance, kRounding * size_);
  }

  std::string sentence() const {
    // Where the tolerance is wide, something fits by accident.
    constexpr double kNarrow = 1e-3;
    if (!(limit_ <= kNarrow * size_)) return "";
    const bool isSameShape = got_.rows() == wanted_.rows() && got_.cols() == wanted_.cols();
    if (isSameShape && isNear()) return "";
    if (!(isSameShape && isAlmost()) && fits(got_.transpose()))
      return "Your value is the wanted one transposed.";
    if (!isSameShape) return "";
    for (auto test :
         {&Diagnosis::sign, &Diagnosis::degrees, &Diagnosis::shift, &Diagnosis::order, &Diagnosis::factor})
      if (std::string found = (this->*test)(); !found.empty()) return found;
    return "";
  }

 private:
  bool fits(const Eigen::MatrixXd& value) const { return fits(value, wanted_); }
  bool fits(const Eigen::MatrixXd& value, const Eigen::MatrixXd& wanted) const {
    return value.rows() == wanted.rows() && value.cols() == wanted.cols() &&
           (value - wanted).cwiseAbs().maxCoeff() <= limit_;
  }
  // A value just outside of the tolerance is inexact, not mistaken.
  bool isNear() const { return (got_ - wanted_).cwiseAbs().maxCoeff() <= 10 * limit_; }
  // A matrix that is hardly unsymmetric is compared with its own transpose.
  bool isAlmost() const { return (got_ - wanted_).cwiseAbs().maxCoeff() <= 1e-4 * size_; }

  std::string sign() const {
    if (!fits(-got_)) return "";
    return "Your value has the opposite sign: is a difference taken the wrong way round?";
  }

  std::string degrees() const {
    if (unit_.starts_with("rad") && fits(kDegree * got_))
      return "Your value is in degrees: wanted are radians.";
    return unit_.starts_with("deg") && fits(got_ / kDegree) ? "Your value is in radians: wanted are degrees."
                                                            : "";
  }

  std::string shift() const {
    constexpr Index kSequence = 4;  // shorter ones hardly have steps
    for (const auto& [steps, got, wanted] :
         {std::tuple{"row", got_, wanted_},
          {"column", got_.transpose().eval(), wanted_.transpose().eval()}}) {
      const Index n = got.rows() - 1;
      if (n + 1 < kSequence) continue;
      if (fits(got.topRows(n), wanted.bottomRows(n)))
        return fmt::format("Each {0} of your value is wanted one {0} later: is it one step ahead?", steps);
      if (fits(got.bottomRows(n), wanted.topRows(n)))
        return fmt::format("Each {0} of your value is wanted one {0} earlier: is it one step behind?", steps);
    }
    return "";
  }

  // Of (0, 1) everything is some exchange.
  bool isPlain() const {
    return wanted_.unaryExpr([](double x) { return x == 0 || std::abs(x) == 1; }).all();
  }

  std::string order() const {
    if (got_.cols() != 1 || got_.rows() < 2 || isPlain()) return "";
    Eigen::MatrixXd exchanged = got_;
    exchanged.row(0).swap(exchanged.row(1));
    if (fits(exchanged)) return "Your value has its first two entries exchanged.";
    return fits(got_.colwise().reverse()) ? "Your value has its entries in reverse order." : "";
  }

  // Of one number, only a factor that people forget is more than an accident.
  std::string factor() const {
    const auto counts = [&](double x) { return std::abs(x) > 1e-3 * size_; };
    const bool isOne = wanted_.unaryExpr(counts).count() < 2;
    const double factor = got_.cwiseProduct(wanted_).sum() / wanted_.squaredNorm();
    if (!(std::abs(factor) > 1e-6) || !fits(got_ / factor)) return "";
    const std::string name = nameOf(factor);
    if (isOne && (name.empty() || isCount())) return "";
    return fmt::format("Your value is {} times the wanted one{}: is a factor missing, or one too many?",
                       name.empty() ? fmt::format("{:.4g}", factor) : name, isOne ? "" : ", in every entry");
  }

  // Numbers of things are multiples of each other by accident.
  bool isCount() const {
    return wanted_.unaryExpr([](double x) { return x == std::round(x); }).all();
  }

  static std::string nameOf(double factor) {
    const double root = std::sqrt(2 * std::numbers::pi);
    for (const auto& [value, name] : {std::pair<double, const char*>{2, "2"},
                                      {0.5, "1/2"},
                                      {-2, "-2"},
                                      {-0.5, "-1/2"},
                                      {std::numbers::pi, "pi"},
                                      {2 * std::numbers::pi, "2 pi"},
                                      {0.5 / std::numbers::pi, "1/(2 pi)"},
                                      {root, "the root of 2 pi"},
                                      {1 / root, "1 over the root of 2 pi"},
                                      {1 / kDegree, "180/pi"},
                                      {kDegree, "pi/180"}})
      if (std::abs(factor - value) <= 1e-4 * std::abs(value)) return name;
    return "";
  }

  Eigen::MatrixXd got_, wanted_;
  double size_, limit_ = 0;
  std::string_view unit_;
};

}  // namespace

std::string usualMistake(const MatrixArg& got, const MatrixArg& wanted, double tolerance,
                         std::string_view unit) {
  if (got.size() == 0 || wanted.size() == 0) return "";
  return Diagnosis(got, wanted, tolerance, unit).sentence();
}

std::string strangeNumber(const MatrixArg& got) {
  constexpr double kLargest = 1e150;
  for (const double x : got.reshaped())
    if (!(std::abs(x) <= kLargest))
      return fmt::format("Numbers such as {} come from memory that was never set, or is gone.",
                         std::isnan(x) ? "nan" : fmt::format("{:.3g}", x));
  return "";
}

}  // namespace rex::grading
