#include "grading/check.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/printable.h"
#include "grading/usual_mistakes.h"
#include "remote/bytes.h"
#include "remote/signature.h"
#include "remote/thrown.h"

namespace rex::grading {
namespace {

constexpr std::size_t kLongestText = 2000;

/// Ends a check function or a case. Not a std::exception, so that no check function catches it by accident.
struct RequirementFailed {};

// The sign of a NaN depends on the machine.
std::string number(double value) { return std::isnan(value) ? "nan" : fmt::format("{:.6g}", value); }

std::string withUnit(std::string text, std::string_view unit) {
  if (!unit.empty()) text.append(" ").append(unit);
  return text;
}

std::string atMostText(double limit, std::string_view unit) {
  return "at most " + withUnit(number(limit), unit);
}
std::string atLeastText(double limit, std::string_view unit) {
  return "at least " + withUnit(number(limit), unit);
}

std::string shapeText(Eigen::Index rows, Eigen::Index cols) { return fmt::format("{} x {}", rows, cols); }

/// A short vector in full; only the relevant entry of anything larger.
std::string valueText(const MatrixArg& value, Eigen::Index row, Eigen::Index col) {
  constexpr Eigen::Index kShort = 6;
  if (value.cols() != 1 || value.rows() > kShort)
    return fmt::format("{} at ({}, {})", number(value(row, col)), row, col);
  std::string text;
  for (Eigen::Index k = 0; k < value.rows(); ++k) text += (k > 0 ? ", " : "") + number(value(k, 0));
  return value.rows() == 1 ? text : "(" + text + ")";
}

// Relative to the limit. A limit of 0 has no scale: then the excess is plus or minus infinity.
double excessOver(double limit, double beyond) {
  if (limit != 0) return beyond / std::abs(limit);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return beyond > 0 ? kInfinity : -kInfinity;
}

void requireSound(bool sound, const CheckInfo& info, const std::string& fault) {
  if (!sound) throw std::logic_error("check '" + info.id + "' " + fault);
}

}  // namespace

void failAssertion(const char* condition) {
  throw std::logic_error(fmt::format("sizes or indices do not fit ({})", condition));
}

Check::Check(CheckInfo info, std::uint64_t seed)
    : info_(std::move(info)), seed_(seed), rng_(Rng(seed).split(remote::hashText(info_.id))) {}

bool Check::state(bool requirement) {
  ++requirements_;
  return requirement;
}

// Keeps the value that comes nearest to its limit or exceeds it most.
void Check::measure(std::string_view property, double excess, std::string value, std::string limit) {
  if (!(excess > nearestExcess_)) return;
  nearestExcess_ = excess;
  nearest_ = {.property = std::string(property),
              .value = std::move(value),
              .limit = std::move(limit),
              .caseNumber = caseNumber_ + 1};
}

// Only students who see the check's numbers are asked.
std::string Check::questionAbout(const MatrixArg& got, const MatrixArg& wanted, double tolerance,
                                 std::string_view unit) const {
  if (info_.group == Group::kHidden || !got.allFinite()) return "";
  for (const auto& [question, value] : suspects_)
    if (value.rows() == got.rows() && value.cols() == got.cols() &&
        (got - value).cwiseAbs().maxCoeff() <= tolerance)
      return question;
  return usualMistake(got, wanted, tolerance, unit);
}

// Keeps the shortfall if it is the worst so far, and returns whether it is.
bool Check::keep(Shortfall shortfall) {
  shortfall.input = input_;
  shortfall.caseNumber = caseNumber_;
  if (shortfall.function.empty() && lastCalled_ && info_.group == Group::kVisible)
    shortfall.function = lastCalled_();
  if (worst_ && !(shortfall.excess > worst_->excess)) return false;
  worst_ = std::move(shortfall);
  evidence_.reset();
  return true;
}

void Check::fail(Shortfall shortfall, std::optional<Evidence> evidence) {
  if (shortfall.question.empty() && comparison_)
    shortfall.question = questionAbout(comparison_->got, comparison_->wanted, comparison_->tolerance, "");
  if (keep(std::move(shortfall)) && info_.group == Group::kVisible) {
    evidence_ = std::move(evidence);
    try {
      if (show_) evidence_ = show_();
    } catch (const std::exception&) {
      // A picture helps but decides nothing: without it, the message has to do.
    }
  }
  throw RequirementFailed{};
}

void Check::near(std::string_view property, double got, double wanted, double tolerance,
                 std::string_view unit) {
  const Eigen::Matrix<double, 1, 1> gotEntry(got);
  const Eigen::Matrix<double, 1, 1> wantedEntry(wanted);
  near(property, gotEntry, wantedEntry, tolerance, unit);
}

void Check::near(std::string_view property, const MatrixArg& got, const MatrixArg& wanted, double tolerance,
                 std::string_view unit) {
  requireSound(wanted.allFinite() && std::isfinite(tolerance) && tolerance >= 0, info_,
               "wants a value that is not finite");
  if (got.rows() != wanted.rows() || got.cols() != wanted.cols()) {
    state(false);
    fail({.property = std::string(property),
          .what = "wrong shape",
          .got = shapeText(got.rows(), got.cols()),
          .wanted = shapeText(wanted.rows(), wanted.cols()),
          .question = questionAbout(got, wanted, tolerance, unit)});
  }
  shape(property, got, wanted.rows(), wanted.cols());
  if (got.size() == 0) return;
  Eigen::Index row = 0;
  Eigen::Index col = 0;
  const double error = (got - wanted).cwiseAbs().maxCoeff(&row, &col);
  const double excess = excessOver(tolerance, error - tolerance);
  measure(property, excess, "off by " + withUnit(number(error), unit), atMostText(tolerance, unit));
  if (state(error <= tolerance)) return;
  constexpr Eigen::Index kManyNumbers = 8;
  std::optional<Evidence> evidence;
  if (std::max(got.rows(), got.cols()) >= kManyNumbers)
    evidence = {.figures = {comparison(std::string(property), got, wanted)}};
  fail({.property = std::string(property),
        .got = withUnit(valueText(got, row, col), unit),
        .wanted = withUnit(valueText(wanted, row, col), unit),
        .tolerance = tolerance > 0 ? withUnit(number(tolerance), unit) : "",
        .question = questionAbout(got, wanted, tolerance, unit),
        .excess = excess},
       std::move(evidence));
}

void Check::atMost(std::string_view property, double got, double limit, std::string_view unit) {
  requireSound(std::isfinite(limit), info_, "wants a value that is not finite");
  shape(property, Eigen::Matrix<double, 1, 1>(got), 1, 1);
  const double excess = excessOver(limit, got - limit);
  measure(property, excess, withUnit(number(got), unit), atMostText(limit, unit));
  if (state(got <= limit)) return;
  fail({.property = std::string(property),
        .got = withUnit(number(got), unit),
        .wanted = atMostText(limit, unit),
        .excess = excess});
}

void Check::atLeast(std::string_view property, double got, double limit, std::string_view unit) {
  requireSound(std::isfinite(limit), info_, "wants a value that is not finite");
  shape(property, Eigen::Matrix<double, 1, 1>(got), 1, 1);
  const double excess = excessOver(limit, limit - got);
  measure(property, excess, withUnit(number(got), unit), atLeastText(limit, unit));
  if (state(got >= limit)) return;
  fail({.property = std::string(property),
        .got = withUnit(number(got), unit),
        .wanted = atLeastText(limit, unit),
        .excess = excess});
}

void Check::shape(std::string_view property, const MatrixArg& got, Eigen::Index rows, Eigen::Index cols) {
  if (!state(got.rows() == rows && got.cols() == cols))
    fail({.property = std::string(property),
          .what = "wrong shape",
          .got = shapeText(got.rows(), got.cols()),
          .wanted = shapeText(rows, cols)});
  if (state(got.allFinite())) return;
  Eigen::Index row = 0;
  Eigen::Index col = 0;
  got.unaryExpr([](double x) { return std::isfinite(x) ? 0.0 : 1.0; }).maxCoeff(&row, &col);
  fail({.property = std::string(property), .what = "not finite", .got = valueText(got, row, col)});
}

void Check::that(std::string_view property, bool holds) {
  if (!state(holds)) fail({.property = std::string(property)});
}

void Check::forEachCase(int count, const std::function<void(int)>& run) {
  requireSound(count > 0, info_, "has no cases");
  const Rng start = rng_;
  const std::string inputOfAll = input_;
  for (int k = 0; k < count; ++k) {
    rng_ = start.split(static_cast<std::uint64_t>(k));
    input_ = inputOfAll;
    caseNumber_ = k;
    ++cases_;
    if (runCase(k, run)) ++casesPassed_;
  }
  caseNumber_ = -1;
  input_ = inputOfAll;
  rng_ = start.split(static_cast<std::uint64_t>(count));
}

bool Check::runCase(int number, const std::function<void(int)>& run) {
  const int before = requirements_;
  try {
    run(number);
    requireSound(requirements_ > before, info_, "states no requirement in a case");
    return true;
  } catch (const RequirementFailed&) {
    return false;
  } catch (const remote::AnswerRefused& refused) {
    keepRefused(refused);
    return false;
  } catch (const remote::RemoteThrow& error) {
    // A worker that has run out of memory can report nothing useful any more.
    if (error.thrown().kind == remote::Thrown::Kind::kBadAlloc) throw;
    // The name of a type could reveal the input.
    const std::string type = info_.group == Group::kVisible ? error.thrown().type : "an exception";
    keep({.outcome = Outcome::kRuntimeError,
          .property = error.function() + " returns",
          .what = "threw " + type + " in " + error.function(),
          .got = error.thrown().text,
          .function = error.function()});
    return false;
  }
}

void Check::keepRefused(const remote::AnswerRefused& refused) {
  keep({.property = "what " + refused.function() + " returned",
        .what = info_.group == Group::kVisible ? refused.what() : "not finite, or too large",
        .function = refused.function()});
}

CheckResult Check::judge(const std::function<void(Check&)>& run) {
  bool ended = false;
  try {
    run(*this);
  } catch (const RequirementFailed&) {
    ended = true;
  } catch (const remote::AnswerRefused& refused) {
    keepRefused(refused);
    ended = true;
  }
  requireSound(requirements_ > 0 || worst_, info_, "states no requirement");
  CheckResult verdict = result();
  if (!ended && cases_ > 0) verdict.points = info_.points * casesPassed_ / cases_;
  if (!ended && !worst_) verdict.points = info_.points;
  return verdict;
}

CheckResult Check::result() const {
  CheckResult verdict{.id = info_.id,
                      .part = info_.part,
                      .title = info_.title,
                      .group = info_.group,
                      .status = Outcome::kPass,
                      .maxPoints = info_.points,
                      .cases = cases_,
                      .casesHeld = casesPassed_};
  if (info_.group == Group::kVisible) verdict.worst = nearest_;
  if (!worst_) return verdict;
  verdict.status = worst_->outcome;
  verdict.message = printable(messageOf(*worst_), kLongestText);
  verdict.property = worst_->property;
  verdict.function = worst_->function;
  if (info_.group == Group::kHidden) return verdict;
  verdict.expected = worst_->wanted;
  verdict.got = printable(worst_->got, kLongestText);
  verdict.tolerance = worst_->tolerance;
  verdict.input = printable(worst_->input, kLongestText);
  return verdict;
}

std::string Check::messageOf(const Shortfall& shortfall) const {
  std::string text;
  if (shortfall.caseNumber >= 0)
    text = fmt::format("{} of {} cases hold; case {}: ", casesPassed_, cases_, shortfall.caseNumber + 1);
  const bool threw = shortfall.outcome == Outcome::kRuntimeError;
  const bool numbers = info_.group == Group::kVisible && !shortfall.got.empty();
  if (!threw) text += shortfall.property + ": ";
  if (!shortfall.what.empty()) text += shortfall.what + (numbers ? ": " : "");
  if (!numbers && shortfall.what.empty()) text += "does not hold";
  if (info_.group == Group::kHidden) return text;
  if (numbers) text += (threw ? "" : "got ") + shortfall.got;
  if (!shortfall.wanted.empty()) text += ", wanted " + shortfall.wanted;
  if (!shortfall.tolerance.empty()) text += ", tolerance " + shortfall.tolerance;
  if (!shortfall.input.empty()) text += "; input: " + shortfall.input;
  text += fmt::format(" (seed {})", seed_);
  return shortfall.question.empty() ? text : text + ". " + shortfall.question;
}

}  // namespace rex::grading
