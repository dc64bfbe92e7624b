#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "base/require.h"
#include "base/rng.h"
#include "grading/evidence.h"
#include "grading/results.h"
#include "grading/signal.h"
#include "remote/split_rng.h"

namespace rex::remote {
class AnswerRefused;
class Caller;
}  // namespace rex::remote

namespace rex::grading {

/// What a report says about a check before it runs.
struct CheckInfo {
  std::string id{};     ///< unique in the exercise: "step-reaches-target"
  std::string part{};   ///< the part of the exercise it belongs to
  std::string title{};  ///< one line for the student
  int points = 0;
  Group group = Group::kVisible;
};

/// A value and what it is.
struct NamedValue {
  NamedValue(std::string itsName, const MatrixArg& itsValue) : name(std::move(itsName)), value(itsValue) {}
  template <class Number>
  requires std::is_arithmetic_v<Number> NamedValue(std::string itsName, Number number)
      : name(std::move(itsName)), value(Eigen::MatrixXd::Constant(1, 1, static_cast<double>(number))) {}

  std::string name;
  Eigen::MatrixXd value;
};

/// A value from which a case can be computed by hand: {"J", J}.
using InputValue = NamedValue;
/// What a mistake that students make gives in place of the wanted value, named by the question about it: {"Is
/// the sign wrong?", -wanted}.
using Mistake = NamedValue;

/// Passed to a check function, which states its requirements through it. The first requirement that does
/// not hold ends the function (or the case, inside forEachCase()). A check passes only if it stated at
/// least one requirement and all of them held. Each names its property in words a student understands:
/// "position of the hand after one step".
class Check {
 public:
  Check(CheckInfo info, std::uint64_t seed);

  /// Random numbers that depend on the seed, the check's id and the case, but not on earlier draws.
  Rng& rng() { return rng_; }
  /// A generator for a student's function, which may not get rng(). It depends on the state of rng(), which
  /// stays as it is, and on the label.
  remote::SplitRng split(std::uint64_t label) const { return {rng_, label}; }
  std::uint64_t seed() const { return seed_; }

  /// Sets the input that the student's functions get from here on. A visible check shows it when it fails.
  void input(std::string text) { input(std::move(text), {}); }
  /// The same with the values from which the case can be computed by hand: "a random task: J = [1, 2; 3, 4]".
  /// Of a matrix of more than 40 numbers only the size is shown. near() says if its `got` is one of them.
  void input(std::string text, std::initializer_list<InputValue> values);
  const std::string& input() const { return input_; }

  /// Asks another worker of the same program, which knows nothing of what was asked before: a program that
  /// remembers questions answers it like a stranger. Its failure ends the check as one of the first worker
  /// would. Throws std::logic_error if no worker can be started.
  using Conversation = std::function<void(remote::Caller&)>;
  void askFreshWorker(const Conversation& conversation);
  void startWorkersBy(std::function<void(const Conversation&)> start) { start_ = std::move(start); }

  /// What a requirement allows: the tolerance of a near...(), or the limit of an atMost...().
  struct Allowance {
    std::string property{};
    double limit = 0;
  };
  /// Calls `told` at each such requirement, to see what its allowance depends on.
  void watchAllowances(std::function<void(const Allowance&)> told) { watch_ = std::move(told); }
  /// Calls `told` after each case, with whether it holds.
  void watchCases(std::function<void(bool)> told) { watchCase_ = std::move(told); }

  /// Says which of the student's functions answered last: where a requirement fails, it is named.
  void nameFunctionsBy(std::function<std::string()> lastCalled) { lastCalled_ = std::move(lastCalled); }

  /// While the returned object is alive, a requirement that does not hold calls `make` and keeps the
  /// evidence for the picture and replay of a visible check. `make` is called before the check function
  /// ends, so it may capture local variables by reference.
  using MakeEvidence = std::function<Evidence()>;
  [[nodiscard]] auto show(MakeEvidence make) {
    struct Showing {
      Check& check;
      MakeEvidence before;
      ~Showing() { check.show_ = std::move(before); }
    };
    return Showing{*this, std::exchange(show_, std::move(make))};
  }
  /// Evidence for the requirement that decided the verdict of judge(). Empty if all requirements hold or
  /// the check is hidden.
  const std::optional<Evidence>& evidence() const { return evidence_; }
  /// The question at the end of the message of judge(); empty if there is none.
  std::string asked() const;

  /// While the returned object is alive, near() asks about the first mistake whose value is within the
  /// tolerance of `got`: "Is S never moved?" Mistakes that hardly differ from the wanted value, by at most
  /// ten tolerances, explain nothing. Others are found by usualMistake().
  [[nodiscard]] auto suspect(const std::vector<Mistake>& mistakes) {
    struct Suspecting {
      std::vector<Mistake>& suspects;
      std::size_t before;
      ~Suspecting() {
        while (suspects.size() > before) suspects.pop_back();
      }
    };
    const std::size_t before = suspects_.size();
    suspects_.insert(suspects_.end(), mistakes.begin(), mistakes.end());
    return Suspecting{suspects_, before};
  }
  template <class Value>
  [[nodiscard]] auto suspect(std::string question, const Value& value) {
    return suspect({Mistake(std::move(question), value)});
  }

  /// While the returned object is alive, a requirement that does not hold asks the question, if it
  /// `applies` and is not empty: for mistakes that no single wrong value shows. The first one alive
  /// counts.
  [[nodiscard]] auto ask(std::string question, bool applies = true) {
    struct Asking {
      std::vector<std::string>& questions;
      std::size_t before;
      ~Asking() { questions.resize(before); }
    };
    const std::size_t before = questions_.size();
    if (applies && !question.empty()) questions_.push_back(std::move(question));
    return Asking{questions_, before};
  }

  /// While the returned object is alive, a requirement that does not hold asks about the usual mistake by
  /// which `got` differs from `wanted`, if there is one: for requirements that do not compare them.
  [[nodiscard]] auto suspectUsualMistake(Eigen::MatrixXd got, Eigen::MatrixXd wanted, double tolerance) {
    struct Suspecting {
      std::optional<Comparison>& comparison;
      std::optional<Comparison> before;
      ~Suspecting() { comparison = std::move(before); }
    };
    Comparison now{std::move(got), std::move(wanted), tolerance};
    return Suspecting{comparison_, std::exchange(comparison_, std::move(now))};
  }

  /// Requires |got - wanted| <= tolerance. Fails if `got` is not finite. All three have the same unit. A
  /// tolerance, and a limit below, may depend on constants, inputs, and wanted values that do not follow
  /// from answers (tolerance.h); an answer may make it smaller, never larger. The gate `grown` proves it.
  void near(std::string_view property, double got, double wanted, double tolerance,
            std::string_view unit = "");
  /// The same for every entry, after comparing the shapes.
  void near(std::string_view property, const MatrixArg& got, const MatrixArg& wanted, double tolerance,
            std::string_view unit = "");
  /// The same; a visible check that fails asks about these mistakes, as after suspect().
  void near(std::string_view property, double got, double wanted, double tolerance,
            const std::vector<Mistake>& mistakes, std::string_view unit = "");
  void near(std::string_view property, const MatrixArg& got, const MatrixArg& wanted, double tolerance,
            const std::vector<Mistake>& mistakes, std::string_view unit = "");
  void atMost(std::string_view property, double got, double limit, std::string_view unit = "");
  void atLeast(std::string_view property, double got, double limit, std::string_view unit = "");
  /// Requires the shape rows x cols and finite entries. State this before the grader computes with a
  /// student's value.
  void shape(std::string_view property, const MatrixArg& got, Eigen::Index rows, Eigen::Index cols);
  /// The same as near() for angles in radians: only differences modulo a whole turn count, also from
  /// mistakes.
  void nearAngle(std::string_view property, double got, double wanted, double tolerance,
                 const std::vector<Mistake>& mistakes = {});

  /// The same at every place of a motion. If a value breaks the rule, the message names the first such
  /// place and the worst. The picture of a visible check plots the whole signal, before the figures of
  /// show(), and a film of show(), which has to cover the same motion, opens at the first place. Throws
  /// std::logic_error if the signal is empty or sizes do not fit.
  void nearAlong(std::string_view property, const Signal& got, const std::vector<Eigen::VectorXd>& wanted,
                 double tolerance, std::string_view unit = "");
  void atMostAlong(std::string_view property, const Signal& got, double limit, std::string_view unit = "");
  void atLeastAlong(std::string_view property, const Signal& got, double limit, std::string_view unit = "");

  /// Any other requirement; the property is a statement: "the path starts at q0".
  void that(std::string_view property, bool holds);

  /// Names a figure that may be better than points require: "length of the path". A visible check that passes
  /// keeps the last one, and `rex test` shows how it changed over a student's attempts. None is kept if the
  /// value is not finite.
  enum class Better { kLess, kMore };
  void record(std::string name, double value, std::string unit = "", Better better = Better::kLess);
  /// The same for the CPU time of the program in this check, in milliseconds, which the grader measures.
  void recordTime(std::string name);
  bool recordsTime() const { return recordsTime_; }
  /// Says what else the answers show, in a sentence: a visible check that passes keeps the last one.
  void remark(std::string text) { remark_ = std::move(text); }

  /// Runs a function that states requirements for cases 0 to count - 1. Points are given in proportion to
  /// the cases that pass, rounded down. The report names the case that exceeds its limit most, relative to
  /// the limit; the first one if several are equal. A case also fails if the student's function throws; a
  /// crash ends the check.
  void forEachCase(int count, const std::function<void(int)>& run);

  /// Runs a whole check function and returns its result, without times. An exception from a student's
  /// function fails the case it occurs in; all others are passed on. Throws std::logic_error for a faulty
  /// check: one that states no requirement, has no cases, or wants a value that is not finite.
  CheckResult judge(const std::function<void(Check&)>& run);

 private:
  /// A requirement along a motion.
  struct Rule {
    std::string limit{};  ///< "at most 1 m"; empty: there are wanted values
    double scale = 0;     ///< of the excess: the limit or the tolerance
    std::vector<Eigen::VectorXd>
        beyond{};  ///< by how much each value breaks the rule; at most 0 if it does not
    std::vector<Eigen::VectorXd> wanted{};
    std::vector<Guide> limits{};
  };
  /// A picture of what was measured.
  struct Plot {
    Figure figure{};
    std::optional<double> share{};  ///< where it went wrong along a motion, from 0 to 1
  };
  /// A requirement that does not hold. Texts carry their units.
  struct Shortfall {
    Outcome outcome = Outcome::kFail;
    std::string property{};
    std::string what{};  ///< also reported by hidden checks: "not finite"
    std::string got{};
    std::string wanted{};
    std::string tolerance{};
    std::string deviation{};  ///< of `got` from `wanted`
    std::string worst{};      ///< the worst value along a motion, if `got` is only the first
    std::string input{};
    std::string question{};          ///< about the mistake that would explain it
    std::string function{};          ///< the student's function that threw, or answered last
    double excess = kBeyondMeasure;  ///< how far beyond its limit, relative to it; negative within
    int caseNumber = -1;
  };
  struct Comparison {
    Eigen::MatrixXd got, wanted;
    double tolerance = 0;
  };
  /// The excess of a value that cannot be measured.
  static constexpr double kBeyondMeasure = std::numeric_limits<double>::infinity();

  bool state(bool requirement);
  void tellAllowance(std::string_view property, double limit) const;
  void measure(std::string_view property, double excess, std::string value, std::string limit);
  void along(std::string_view property, const Signal& got, const Rule& rule, std::string_view unit);
  void requireSignal(const Signal& got) const;
  std::string questionAbout(const MatrixArg& got, const MatrixArg& wanted, double tolerance,
                            std::string_view unit, double period) const;
  bool keep(Shortfall shortfall);
  void keepRefused(const remote::AnswerRefused& refused);
  [[noreturn]] void fail(Shortfall shortfall, const std::optional<Plot>& plot = {});
  void keepEvidence(const std::optional<Plot>& plot);
  bool runCase(int number, const std::function<void(int)>& run);
  CheckResult result() const;
  std::string shortfallText(const Shortfall& shortfall) const;

  CheckInfo info_;
  std::uint64_t seed_;
  Rng rng_;
  std::string input_;
  std::vector<InputValue> inputs_;
  MakeEvidence show_;
  std::function<void(const Conversation&)> start_;
  std::function<void(const Allowance&)> watch_;
  std::function<void(bool)> watchCase_;
  std::optional<Comparison> comparison_;
  std::function<std::string()> lastCalled_;
  std::vector<Mistake> suspects_;
  std::vector<std::string> questions_;
  std::optional<Evidence> evidence_;
  std::optional<Shortfall> worst_;  ///< the worst requirement that does not hold
  std::optional<Record> record_;
  bool recordsTime_ = false;
  std::string remark_;
  WorstValue nearest_;  ///< the one nearest to its limit, of all that were measured
  double nearestExcess_ = -kBeyondMeasure;
  int requirements_ = 0;
  int cases_ = 0;
  int casesPassed_ = 0;
  int caseNumber_ = -1;
};

/// One line of an exercise's list of checks. Student is the proxy of the generated interface.h.
template <class Student>
struct CheckEntry {
  std::string id;
  std::string part;
  std::string title;
  int points;
  Group group;
  std::function<void(Check&, Student&)> run;
};

template <class Student>
using Checks = std::vector<CheckEntry<Student>>;

}  // namespace rex::grading
