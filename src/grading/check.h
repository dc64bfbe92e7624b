#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "base/rng.h"
#include "base/vector_arg.h"
#include "grading/evidence.h"
#include "grading/results.h"

namespace rex::remote {
class AnswerRefused;
}

namespace rex::grading {

/// What a report says about a check before it runs.
struct CheckInfo {
  std::string id{};     ///< unique in the exercise: "step-reaches-target"
  std::string part{};   ///< the part of the exercise it belongs to
  std::string title{};  ///< one line for the student
  int points = 0;
  Group group = Group::kVisible;
};

/// Handed to a check function, which states its requirements through it. The first requirement that does not
/// hold ends the function (or the case, inside forEachCase()). A check passes only if it stated one and all
/// held. Every requirement names its property as a student would read it: "position of the hand after one
/// step".
class Check {
 public:
  Check(CheckInfo info, std::uint64_t seed);

  /// Random numbers that depend on the seed, the check's id and the case, not on what was drawn before.
  Rng& rng() { return rng_; }
  std::uint64_t seed() const { return seed_; }

  /// Describes what the student's functions are given now; shown if a requirement of a visible check fails.
  void input(std::string text) { input_ = std::move(text); }
  const std::string& input() const { return input_; }

  /// While the return value lives, a requirement that does not hold keeps what `make` makes, for the picture
  /// and the replay beside a visible check. `make` runs then, before the function ends, and may refer to what
  /// is around it.
  using MakeEvidence = std::function<Evidence()>;
  [[nodiscard]] auto show(MakeEvidence make) {
    struct Showing {
      Check& check;
      MakeEvidence before;
      ~Showing() { check.show_ = std::move(before); }
    };
    return Showing{*this, std::exchange(show_, std::move(make))};
  }
  /// Evidence for the requirement that decided the verdict of judge(); empty if all hold, or the check is
  /// hidden.
  const std::optional<Evidence>& evidence() const { return evidence_; }

  /// |got - wanted| <= tolerance; false for what is not finite. Same unit for all three.
  void near(std::string_view property, double got, double wanted, double tolerance,
            std::string_view unit = "");
  /// The same for every entry, after the shape was compared.
  void near(std::string_view property, const MatrixArg& got, const MatrixArg& wanted, double tolerance,
            std::string_view unit = "");
  void atMost(std::string_view property, double got, double limit, std::string_view unit = "");
  void atLeast(std::string_view property, double got, double limit, std::string_view unit = "");
  /// The shape is rows x cols and every entry is finite. State it before the grader computes with a student's
  /// value.
  void shape(std::string_view property, const MatrixArg& got, Eigen::Index rows, Eigen::Index cols);
  /// Anything else; the property is a statement: "the path starts at q0".
  void that(std::string_view property, bool holds);

  /// Runs a requirement-stating function for cases 0 to count - 1. The points are given in proportion to the
  /// cases that hold, rounded down; the report names the one that is furthest beyond its limit, relative to
  /// the limit, and the first of equals. A case also fails if the student's function throws; a crash ends the
  /// check.
  void forEachCase(int count, const std::function<void(int)>& run);

  /// Runs a whole check function and gives its result, without times. Passes on all exceptions, except that
  /// one of a student's function fails the case it happens in. Throws std::logic_error for a faulty check:
  /// one that states no requirement, has no cases, or wants a value that is not finite.
  CheckResult judge(const std::function<void(Check&)>& run);

 private:
  /// A requirement that does not hold. Texts carry their units.
  struct Shortfall {
    Outcome outcome = Outcome::kFail;
    std::string property{};
    std::string what{};  ///< also reported by hidden checks: "not finite"
    std::string got{};
    std::string wanted{};
    std::string tolerance{};
    std::string input{};
    std::string function{};  ///< of the student, that threw
    double excess = kBeyondMeasure;
    int caseNumber = -1;
  };
  /// How far a value is beyond its limit, relative to the limit; negative within it.
  static constexpr double kBeyondMeasure = std::numeric_limits<double>::infinity();

  bool state(bool requirement);
  void measure(std::string_view property, double excess, double value, double limit, std::string_view unit);
  bool keep(Shortfall shortfall);
  void keepRefused(const remote::AnswerRefused& refused);
  [[noreturn]] void fail(Shortfall shortfall, std::optional<Evidence> evidence = {});
  bool runCase(int number, const std::function<void(int)>& run);
  CheckResult result() const;
  std::string messageOf(const Shortfall& shortfall) const;

  CheckInfo info_;
  std::uint64_t seed_;
  Rng rng_;
  std::string input_;
  MakeEvidence show_;
  std::optional<Evidence> evidence_;
  std::optional<Shortfall> worst_;  ///< of the requirements that do not hold
  WorstValue nearest_;              ///< of all that were measured
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
