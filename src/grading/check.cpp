#include "grading/check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/escape.h"
#include "base/text.h"
#include "grading/usual_mistakes.h"
#include "remote/channel.h"
#include "remote/layout.h"
#include "remote/wire.h"

namespace rex::grading {
namespace {

constexpr std::size_t kLongestText = 2000;
constexpr double kTurn = 2 * std::numbers::pi, kNoPeriod = std::numeric_limits<double>::infinity();

/// Ends a check function or a case. Not a std::exception, so that no check function catches it by accident.
struct RequirementFailed {};

constexpr int kDigits = 6;

// The sign of a NaN depends on the machine.
std::string number(double value, int digits = kDigits) {
  if (std::isnan(value)) return "nan";
  return fmt::format("{:.{}g}", value == 0 ? 0.0 : value, digits);  // not -0
}

// How many digits tell a value from what was wanted: "got 0.5, wanted 0.5" would explain nothing.
int digitsToTell(double got, double wanted) {
  if (got == wanted) return kDigits;
  for (const int digits : {kDigits, 9, 12, 15})
    if (number(got, digits) != number(wanted, digits)) return digits;
  return std::numeric_limits<double>::max_digits10;
}

std::string withUnit(std::string text, std::string_view unit) {
  if (!unit.empty()) text.append(" ").append(unit);
  return text;
}

std::string atMostText(double limit, std::string_view unit, int digits = kDigits) {
  return "at most " + withUnit(number(limit, digits), unit);
}
std::string atLeastText(double limit, std::string_view unit, int digits = kDigits) {
  return "at least " + withUnit(number(limit, digits), unit);
}

std::string shapeText(Eigen::Index rows, Eigen::Index cols) { return fmt::format("{} x {}", rows, cols); }

std::vector<std::string> numbers(const Eigen::VectorXd& values, int digits = kDigits) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(number(value, digits));
  return texts;
}

Eigen::Index largestEntry(const Eigen::VectorXd& values) {
  Eigen::Index row = 0;
  values.maxCoeff<Eigen::PropagateNaN>(&row);
  return row;
}

// For the first value along a motion that breaks a limit.
int digitsToTell(const Signal& got, const std::vector<Eigen::VectorXd>& beyond, double limit) {
  const std::optional<std::size_t> first = findBreaches(beyond).first;
  return first ? digitsToTell(got.values[*first][largestEntry(beyond[*first])], limit) : kDigits;
}

/// A short vector in full; only the relevant entry of anything larger.
std::string valueText(const MatrixArg& value, Eigen::Index row, Eigen::Index col, int digits = kDigits) {
  constexpr Eigen::Index kShort = 6;
  if (value.cols() != 1 || value.rows() > kShort)
    return fmt::format("{} at ({}, {})", number(value(row, col), digits), row, col);
  return value.rows() == 1 ? number(value(0, 0), digits)
                           : fmt::format("({})", join(numbers(value, digits), ", "));
}

// The rows of a matrix as "[1, 2; 3, 4]"; its size if that would be long.
std::string inputText(const Eigen::MatrixXd& value) {
  constexpr Eigen::Index kMostNumbers = 40;
  if (value.size() > kMostNumbers) return shapeText(value.rows(), value.cols()) + " numbers";
  if (value.size() == 1) return number(value(0, 0));
  if (value.cols() == 1) return "(" + join(numbers(value), ", ") + ")";
  std::vector<std::string> rows;
  for (Eigen::Index i = 0; i < value.rows(); ++i)
    rows.push_back(join(numbers(value.row(i).transpose()), ", "));
  return fmt::format("[{}]", join(rows, "; "));
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

// Only differences modulo `period` count. False for other shapes, empty ones, and numbers that are not
// finite.
bool isWithin(double tolerance, const MatrixArg& a, const MatrixArg& b, double period = kNoPeriod) {
  if (a.rows() != b.rows() || a.cols() != b.cols() || a.size() == 0) return false;
  const auto reduced = [period](double x) { return std::abs(std::remainder(x, period)); };
  return (a - b).unaryExpr(reduced).maxCoeff() <= tolerance;
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

void Check::tellAllowance(std::string_view property, double limit) const {
  if (watch_) watch_({.property = std::string(property), .limit = limit});
}

void Check::askFreshWorker(const Conversation& conversation) {
  requireSound(start_ != nullptr, info_, "asks for a worker where none can be started");
  start_(conversation);
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
                                 std::string_view unit, double period) const {
  if (info_.group == Group::kHidden) return "";
  for (const Mistake& mistake : suspects_)
    if (isWithin(tolerance, got, mistake.value, period) &&
        !isWithin(10 * tolerance, wanted, mistake.value, period))
      return mistake.name;
  for (const InputValue& one : inputs_)
    if (one.value.size() > 1 && !one.value.isZero(tolerance) && isWithin(tolerance, got, one.value))
      return fmt::format("Your value is the input {}, unchanged.", one.name);
  const std::string strange = strangeNumber(got);
  return strange.empty() ? usualMistake(got, wanted, tolerance, unit) : strange;
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

// A picture helps but decides nothing: without it, the message has to do.
void Check::keepEvidence(const std::optional<Plot>& plot) {
  try {
    if (show_) evidence_ = show_();
  } catch (const std::exception&) {
    evidence_.reset();
  }
  if (!plot || (evidence_ && !plot->share)) return;
  if (!evidence_) evidence_ = Evidence{};
  evidence_->figures.insert(evidence_->figures.begin(), plot->figure);
  if (plot->share && !evidence_->film.empty()) {
    const double begin = evidence_->film.front().time, end = evidence_->film.back().time;
    evidence_->moment = begin + *plot->share * (end - begin);
  }
}

void Check::fail(Shortfall shortfall, const std::optional<Plot>& plot) {
  if (shortfall.question.empty() && !questions_.empty() && info_.group == Group::kVisible)
    shortfall.question = questions_.front();
  if (shortfall.question.empty() && comparison_)
    shortfall.question =
        questionAbout(comparison_->got, comparison_->wanted, comparison_->tolerance, "", kNoPeriod);
  if (keep(std::move(shortfall)) && info_.group == Group::kVisible) keepEvidence(plot);
  throw RequirementFailed{};
}

void Check::near(std::string_view property, double got, double wanted, double tolerance,
                 const std::vector<Mistake>& mistakes, std::string_view unit) {
  near(property, Eigen::Matrix<double, 1, 1>(got), Eigen::Matrix<double, 1, 1>(wanted), tolerance, mistakes,
       unit);
}

void Check::near(std::string_view property, const MatrixArg& got, const MatrixArg& wanted, double tolerance,
                 const std::vector<Mistake>& mistakes, std::string_view unit) {
  const auto suspicion = suspect(mistakes);
  near(property, got, wanted, tolerance, unit);
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
  tellAllowance(property, tolerance);
  if (got.rows() != wanted.rows() || got.cols() != wanted.cols()) {
    state(false);
    fail({.property = std::string(property),
          .what = "wrong shape",
          .got = shapeText(got.rows(), got.cols()),
          .wanted = shapeText(wanted.rows(), wanted.cols()),
          .question = questionAbout(got, wanted, tolerance, unit, kNoPeriod)});
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
  std::optional<Plot> plot;
  if (std::max(got.rows(), got.cols()) >= kManyNumbers)
    plot = Plot{.figure = comparison(std::string(property), got, wanted)};
  const int digits = digitsToTell(got(row, col), wanted(row, col));
  fail({.property = std::string(property),
        .got = withUnit(valueText(got, row, col, digits), unit),
        .wanted = withUnit(valueText(wanted, row, col, digits), unit),
        .tolerance = tolerance > 0 ? withUnit(number(tolerance), unit) : "",
        .deviation = "off by " + withUnit(number(error), unit),
        .question = questionAbout(got, wanted, tolerance, unit, kNoPeriod),
        .excess = excess},
       plot);
}

void Check::atMost(std::string_view property, double got, double limit, std::string_view unit) {
  requireSound(std::isfinite(limit), info_, "wants a value that is not finite");
  tellAllowance(property, limit);
  shape(property, Eigen::Matrix<double, 1, 1>(got), 1, 1);
  const double excess = excessOver(limit, got - limit);
  measure(property, excess, withUnit(number(got), unit), atMostText(limit, unit));
  if (state(got <= limit)) return;
  const int digits = digitsToTell(got, limit);
  fail({.property = std::string(property),
        .got = withUnit(number(got, digits), unit),
        .wanted = atMostText(limit, unit, digits),
        .excess = excess});
}

void Check::atLeast(std::string_view property, double got, double limit, std::string_view unit) {
  requireSound(std::isfinite(limit), info_, "wants a value that is not finite");
  shape(property, Eigen::Matrix<double, 1, 1>(got), 1, 1);
  const double excess = excessOver(limit, limit - got);
  measure(property, excess, withUnit(number(got), unit), atLeastText(limit, unit));
  if (state(got >= limit)) return;
  const int digits = digitsToTell(got, limit);
  fail({.property = std::string(property),
        .got = withUnit(number(got, digits), unit),
        .wanted = atLeastText(limit, unit, digits),
        .excess = excess});
}

void Check::nearAngle(std::string_view property, double got, double wanted, double tolerance,
                      const std::vector<Mistake>& mistakes) {
  requireSound(std::isfinite(wanted), info_, "wants a value that is not finite");
  tellAllowance(property, tolerance);
  shape(property, Eigen::Matrix<double, 1, 1>(got), 1, 1);
  const Eigen::Matrix<double, 1, 1> gotEntry(got), wantedEntry(wanted);
  const auto suspicion = suspect(mistakes);
  const double error = std::abs(std::remainder(got - wanted, kTurn));
  const double excess = excessOver(tolerance, error - tolerance);
  measure(property, excess, "off by " + withUnit(number(error), "rad"), atMostText(tolerance, "rad"));
  if (state(error <= tolerance)) return;
  const int digits = digitsToTell(got, wanted);
  fail({.property = std::string(property),
        .got = withUnit(number(got, digits), "rad"),
        .wanted = withUnit(number(wanted, digits), "rad"),
        .tolerance = withUnit(number(tolerance), "rad"),
        .deviation = "off by " + withUnit(number(error), "rad"),
        .question = questionAbout(gotEntry, wantedEntry, tolerance, "rad", kTurn),
        .excess = excess});
}

void Check::along(std::string_view property, const Signal& got, const Rule& rule, std::string_view unit) {
  constexpr double kLeast = 1e-9;  // the length of a motion that is one moment
  const Breaches breaches = findBreaches(rule.beyond);
  const auto place = [&](std::size_t i) { return " at " + placeText(got, i); };
  const auto text = [&](const Eigen::VectorXd& value, std::size_t i) {
    const Eigen::Index entry = largestEntry(rule.beyond[i]);
    const double wanted = rule.wanted.empty() ? rule.limits.front().at : rule.wanted[i][entry];
    return withUnit(valueText(value, entry, 0, digitsToTell(got.values[i][entry], wanted)), unit);
  };
  const auto value = [&](std::size_t i) { return text(got.values[i], i); };
  const auto off = [&](std::size_t i) {
    const double beyond = rule.beyond[i].maxCoeff();
    return rule.wanted.empty() ? value(i) : withUnit(number(beyond + rule.scale), unit);
  };
  const double excess = excessOver(rule.scale, breaches.most);
  const std::string worst = off(breaches.worst) + place(breaches.worst);
  measure(property, excess, (rule.wanted.empty() ? "" : "off by ") + worst, rule.limit);
  if (state(!breaches.first)) return;
  const std::size_t first = *breaches.first;
  Shortfall shortfall{
      .property = std::string(property), .got = value(first) + place(first), .excess = excess};
  if (!got.values[first].allFinite()) {
    shortfall.what = "not finite";
  } else if (rule.wanted.empty()) {
    shortfall.wanted = rule.limit;
  } else {
    shortfall.wanted = text(rule.wanted[first], first);
    shortfall.tolerance = withUnit(number(rule.scale), unit);
    shortfall.deviation = "off by " + off(first);
  }
  if (shortfall.what.empty() && breaches.worst != first) shortfall.worst = worst;
  // A signal may begin later than its motion, whose first step is 1.
  const double begin = std::min(got.axis == "step" ? 1.0 : 0.0, got.at.front());
  Plot plot{
      .figure = signalFigure(std::string(property), got, rule.wanted, breaches.ofComponents, first, unit),
      .share = (got.at[first] - begin) / std::max(got.at.back() - begin, kLeast)};
  plot.figure.horizontalLines = rule.limits;
  fail(std::move(shortfall), plot);
}

// Throws std::logic_error unless the signal can be judged.
void Check::requireSignal(const Signal& got) const {
  requireSound(!got.at.empty() && got.at.size() == got.values.size(), info_, "measures an empty motion");
  for (const Eigen::VectorXd& value : got.values)
    requireSound(value.size() > 0 && value.size() == got.values.front().size(), info_,
                 "measures values of different sizes");
}

void Check::nearAlong(std::string_view property, const Signal& got,
                      const std::vector<Eigen::VectorXd>& wanted, double tolerance, std::string_view unit) {
  requireSignal(got);
  requireSound(std::isfinite(tolerance) && tolerance >= 0, info_, "wants a value that is not finite");
  requireSound(wanted.size() == got.values.size(), info_, "wants another number of values");
  tellAllowance(property, tolerance);
  Rule rule{.limit = atMostText(tolerance, unit), .scale = tolerance, .wanted = wanted};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    requireSound(wanted[i].size() == got.values[i].size() && wanted[i].allFinite(), info_,
                 "wants a value that is not finite, or of another size");
    rule.beyond.emplace_back((got.values[i] - wanted[i]).array().abs() - tolerance);
  }
  along(property, got, rule, unit);
}

void Check::atMostAlong(std::string_view property, const Signal& got, double limit, std::string_view unit) {
  requireSignal(got);
  requireSound(std::isfinite(limit), info_, "wants a value that is not finite");
  tellAllowance(property, limit);
  Rule rule{.scale = limit, .limits = {{.at = limit, .label = "wanted: at most"}}};
  for (const Eigen::VectorXd& value : got.values) rule.beyond.emplace_back(value.array() - limit);
  rule.limit = atMostText(limit, unit, digitsToTell(got, rule.beyond, limit));
  along(property, got, rule, unit);
}

void Check::atLeastAlong(std::string_view property, const Signal& got, double limit, std::string_view unit) {
  requireSignal(got);
  requireSound(std::isfinite(limit), info_, "wants a value that is not finite");
  Rule rule{.scale = limit, .limits = {{.at = limit, .label = "wanted: at least"}}};
  for (const Eigen::VectorXd& value : got.values) rule.beyond.emplace_back(limit - value.array());
  rule.limit = atLeastText(limit, unit, digitsToTell(got, rule.beyond, limit));
  along(property, got, rule, unit);
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

void Check::input(std::string text, std::initializer_list<InputValue> values) {
  input_ = std::move(text);
  inputs_ = values;
  const char* separator = ": ";
  for (const auto& [name, value] : values)
    input_ += fmt::format("{}{} = {}", std::exchange(separator, ", "), name, inputText(value));
}

void Check::forEachCase(int count, const std::function<void(int)>& run) {
  requireSound(count > 0, info_, "has no cases");
  const Rng start = rng_;
  const std::string inputOfAll = input_;
  const std::vector<InputValue> valuesOfAll = inputs_;
  for (int k = 0; k < count; ++k) {
    rng_ = start.split(static_cast<std::uint64_t>(k));
    input_ = inputOfAll;
    inputs_ = valuesOfAll;
    caseNumber_ = k;
    ++cases_;
    const bool holds = runCase(k, run);
    if (holds) ++casesPassed_;
    if (watchCase_) watchCase_(holds);
  }
  caseNumber_ = -1;
  input_ = inputOfAll;
  inputs_ = valuesOfAll;
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
  Shortfall shortfall{.property = "what " + refused.function() + " returned",
                      .what = "not finite, or too large",
                      .function = refused.function()};
  if (info_.group == Group::kVisible) {
    shortfall.what = refused.what();
    const bool isFilled = shortfall.what.find("e+30") != std::string::npos;  // as student builds fill memory
    if (isFilled || shortfall.what.find(" is nan") != std::string::npos)
      shortfall.question = isFilled ? "Is every number set before it is used?"
                                    : "Is every number set before it is used, and nothing divided by zero?";
  }
  keep(std::move(shortfall));
}

std::string Check::asked() const { return worst_ && info_.group == Group::kVisible ? worst_->question : ""; }

void Check::record(std::string name, double value, std::string unit, Better better) {
  record_.reset();
  recordsTime_ = false;
  if (std::isfinite(value))
    record_ = {.name = std::move(name),
               .value = value,
               .unit = std::move(unit),
               .isMoreBetter = better == Better::kMore};
}

void Check::recordTime(std::string name) {
  record(std::move(name), 0, "ms");
  recordsTime_ = true;
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
  if (!worst_) {
    if (info_.group == Group::kHidden) return verdict;
    verdict.record = record_;
    verdict.remark = printable(remark_, kLongestText);
    return verdict;
  }
  verdict.status = worst_->outcome;
  verdict.message = printable(shortfallText(*worst_), kLongestText);
  verdict.property = worst_->property;
  verdict.function = worst_->function;
  if (info_.group == Group::kHidden) return verdict;
  verdict.expected = worst_->wanted;
  verdict.got = printable(worst_->got, kLongestText);
  verdict.tolerance = worst_->tolerance;
  verdict.input = printable(worst_->input, kLongestText);
  return verdict;
}

std::string Check::shortfallText(const Shortfall& shortfall) const {
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
  if (!shortfall.deviation.empty()) text += ", " + shortfall.deviation;
  if (!shortfall.tolerance.empty()) text += fmt::format(" (tolerance {})", shortfall.tolerance);
  if (!shortfall.worst.empty()) text += ", at worst " + shortfall.worst;
  text += fmt::format(" (seed {})", seed_);
  return shortfall.question.empty() ? text : text + ". " + shortfall.question;
}

}  // namespace rex::grading
