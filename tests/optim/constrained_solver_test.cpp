#include "optim/constrained_solver.h"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "support/expect_error.h"

namespace rex::constrained_solver_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Problems of Hock and Schittkowski, Test Examples for Nonlinear Programming Codes, 1981.
struct KnownProblem {
  const char* name;
  ConstrainedProblem problem;
  VectorXd start;
  double optimum;
  VectorXd solution;
};

VectorXd numbers(std::initializer_list<double> list) {
  VectorXd v(static_cast<Eigen::Index>(list.size()));
  std::copy(list.begin(), list.end(), v.begin());
  return v;
}

MatrixXd row(std::initializer_list<double> list) { return numbers(list).transpose(); }

MatrixXd rows(std::initializer_list<std::initializer_list<double>> lists) {
  MatrixXd M(static_cast<Eigen::Index>(lists.size()), static_cast<Eigen::Index>(lists.begin()->size()));
  Eigen::Index i = 0;
  for (const auto& list : lists) M.row(i++) = numbers(list).transpose();
  return M;
}

KnownProblem hockSchittkowski6() {
  return {"6",
          {.residuals =
               [](const VectorArg& x) {
                 return FunctionValue{numbers({1 - x[0]}), row({-1, 0})};
               },
           .equalities =
               [](const VectorArg& x) {
                 return FunctionValue{numbers({10 * (x[1] - x[0] * x[0])}), row({-20 * x[0], 10})};
               }},
          numbers({-1.2, 1}),
          0,
          numbers({1, 1})};
}

KnownProblem hockSchittkowski7() {
  const auto cost = [](const VectorArg& x) {
    const double s = 1 + x[0] * x[0];
    return FunctionValue{numbers({std::log(s) - x[1]}), row({2 * x[0] / s, -1})};
  };
  const auto h = [](const VectorArg& x) {
    const double s = 1 + x[0] * x[0];
    return FunctionValue{numbers({s * s + x[1] * x[1] - 4}), row({4 * x[0] * s, 2 * x[1]})};
  };
  return {"7", {.cost = cost, .equalities = h}, numbers({2, 2}), -std::sqrt(3), numbers({0, std::sqrt(3)})};
}

KnownProblem hockSchittkowski35() {
  const auto cost = [](const VectorArg& x) {
    const double a = x[0], b = x[1], c = x[2];
    return FunctionValue{
        numbers({9 - 8 * a - 6 * b - 4 * c + 2 * a * a + 2 * b * b + c * c + 2 * a * b + 2 * a * c}),
        row({-8 + 4 * a + 2 * b + 2 * c, -6 + 4 * b + 2 * a, -4 + 2 * c + 2 * a})};
  };
  const auto g = [](const VectorArg& x) {
    return FunctionValue{numbers({x[0] + x[1] + 2 * x[2] - 3, -x[0], -x[1], -x[2]}),
                         rows({{1, 1, 2}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}})};
  };
  return {"35",
          {.cost = cost, .inequalities = g},
          numbers({0.5, 0.5, 0.5}),
          1. / 9,
          numbers({4. / 3, 7. / 9, 4. / 9})};
}

KnownProblem hockSchittkowski39() {
  const auto cost = [](const VectorArg& x) { return FunctionValue{numbers({-x[0]}), row({-1, 0, 0, 0})}; };
  const auto h = [](const VectorArg& x) {
    return FunctionValue{numbers({x[1] - x[0] * x[0] * x[0] - x[2] * x[2], x[0] * x[0] - x[1] - x[3] * x[3]}),
                         rows({{-3 * x[0] * x[0], 1, -2 * x[2], 0}, {2 * x[0], -1, 0, -2 * x[3]}})};
  };
  return {"39", {.cost = cost, .equalities = h}, numbers({2, 2, 2, 2}), -1, numbers({1, 1, 0, 0})};
}

KnownProblem hockSchittkowski43() {
  const auto cost = [](const VectorArg& x) {
    const double a = x[0], b = x[1], c = x[2], d = x[3];
    return FunctionValue{numbers({a * a + b * b + 2 * c * c + d * d - 5 * a - 5 * b - 21 * c + 7 * d}),
                         row({2 * a - 5, 2 * b - 5, 4 * c - 21, 2 * d + 7})};
  };
  const auto g = [](const VectorArg& x) {
    const double a = x[0], b = x[1], c = x[2], d = x[3];
    return FunctionValue{numbers({a * a + b * b + c * c + d * d + a - b + c - d - 8,
                                  a * a + 2 * b * b + c * c + 2 * d * d - a - d - 10,
                                  2 * a * a + b * b + c * c + 2 * a - b - d - 5}),
                         rows({{2 * a + 1, 2 * b - 1, 2 * c + 1, 2 * d - 1},
                               {2 * a - 1, 4 * b, 2 * c, 4 * d - 1},
                               {4 * a + 2, 2 * b - 1, 2 * c, -1}})};
  };
  return {"43", {.cost = cost, .inequalities = g}, VectorXd::Zero(4), -44, numbers({0, 1, 2, -1})};
}

KnownProblem hockSchittkowski71() {
  const auto cost = [](const VectorArg& x) {
    const double s = x[0] + x[1] + x[2];
    return FunctionValue{numbers({x[0] * x[3] * s + x[2]}),
                         row({x[3] * (s + x[0]), x[0] * x[3], x[0] * x[3] + 1, x[0] * s})};
  };
  const auto g = [](const VectorArg& x) {
    FunctionValue value{VectorXd(9), MatrixXd::Zero(9, 4)};
    value.y[0] = 25 - x[0] * x[1] * x[2] * x[3];
    value.J.row(0) << -x[1] * x[2] * x[3], -x[0] * x[2] * x[3], -x[0] * x[1] * x[3], -x[0] * x[1] * x[2];
    value.y.segment<4>(1) = 1 - x.array();
    value.y.segment<4>(5) = x.array() - 5;
    value.J.middleRows<4>(1) = -MatrixXd::Identity(4, 4);
    value.J.middleRows<4>(5) = MatrixXd::Identity(4, 4);
    return value;
  };
  const auto h = [](const VectorArg& x) {
    return FunctionValue{numbers({x.squaredNorm() - 40}), 2 * x.transpose()};
  };
  return {"71",
          {.cost = cost, .inequalities = g, .equalities = h},
          numbers({1, 5, 5, 1}),
          17.0140173,
          numbers({1, 4.7429994, 3.8211503, 1.3794082})};
}

std::vector<KnownProblem> knownProblems() {
  return {hockSchittkowski6(),  hockSchittkowski7(),  hockSchittkowski35(),
          hockSchittkowski39(), hockSchittkowski43(), hockSchittkowski71()};
}

class EachMethod : public testing::TestWithParam<ConstraintMethod> {};

TEST_P(EachMethod, FindsTheOptimaOfHockAndSchittkowski) {
  for (const KnownProblem& known : knownProblems()) {
    SCOPED_TRACE(known.name);
    const ConstrainedResult result = solveConstrained(known.problem, known.start, {.method = GetParam()});
    EXPECT_EQ(result.status, ConstrainedStatus::kSolved) << result.message;
    EXPECT_NEAR(result.cost, known.optimum, 1e-6) << result.message;
    EXPECT_LT((result.x - known.solution).cwiseAbs().maxCoeff(), 1e-4) << result.x.transpose();
    EXPECT_LE(result.violation, 1e-8);
  }
}

// The gradient of the Lagrangian by differences of values alone, with the multipliers of the result.
TEST_P(EachMethod, EndsWhereTheConditionsOfKarushKuhnAndTuckerHold) {
  for (const KnownProblem& known : knownProblems()) {
    SCOPED_TRACE(known.name);
    const ConstrainedResult result = solveConstrained(known.problem, known.start, {.method = GetParam()});
    const ConstrainedProblem& p = known.problem;
    const auto lagrangian = [&](const VectorXd& x) -> VectorXd {
      double sum = 0;
      if (p.residuals) sum += p.residuals(x).y.squaredNorm();
      if (p.cost) sum += p.cost(x).y[0];
      if (p.inequalities) sum += result.inequalityMultipliers.dot(p.inequalities(x).y);
      if (p.equalities) sum += result.equalityMultipliers.dot(p.equalities(x).y);
      return VectorXd::Constant(1, sum);
    };
    // Penalties and barriers take multipliers from values near 1e-8, whose rounding they magnify.
    const double tolerance = GetParam() == ConstraintMethod::kAugmentedLagrangian ? 1e-7 : 1e-4;
    EXPECT_LT(numericJacobian(lagrangian, result.x).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_LT(result.stationarity, tolerance);
    if (!p.inequalities) continue;
    EXPECT_GE(result.inequalityMultipliers.minCoeff(), 0);
    const VectorXd products = result.inequalityMultipliers.cwiseProduct(p.inequalities(result.x).y);
    EXPECT_LT(products.cwiseAbs().maxCoeff(), 1e-7);
  }
}

TEST_P(EachMethod, NamesTheConstraintThatCannotBeMet) {
  const ConstrainedProblem problem{
      .residuals =
          [](const VectorArg& x) {
            return FunctionValue{x, MatrixXd::Identity(1, 1)};
          },
      .inequalities =
          [](const VectorArg& x) {
            return FunctionValue{numbers({x[0] - 7, 1.5 - x[0], x[0] - 1}), rows({{1}, {-1}, {1}})};
          },
      .inequalityNames = {"below seven", "above one and a half", "below one"}};
  const ConstrainedResult result = solveConstrained(problem, VectorXd::Zero(1), {.method = GetParam()});
  EXPECT_EQ(result.status, ConstrainedStatus::kInfeasible) << result.message;
  EXPECT_NEAR(result.violation, 0.25, 0.06);
  EXPECT_NE(result.mostViolated, "below seven");
  EXPECT_THAT(result.message, testing::HasSubstr("most violated is " + result.mostViolated));
}

TEST_P(EachMethod, NamesTheEqualityThatCannotBeMet) {
  const ConstrainedProblem problem{
      .residuals =
          [](const VectorArg& x) {
            return FunctionValue{x, MatrixXd::Identity(2, 2)};
          },
      .equalities =
          [](const VectorArg& x) {
            return FunctionValue{numbers({x[1] - 2, x[0] * x[0] + 0.5}), rows({{0, 1}, {2 * x[0], 0}})};
          }};
  const ConstrainedResult result = solveConstrained(problem, numbers({1, 1}), {.method = GetParam()});
  EXPECT_EQ(result.status, ConstrainedStatus::kInfeasible) << result.message;
  EXPECT_EQ(result.mostViolated, "equality 1");
  EXPECT_NEAR(result.violation, 0.5, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Constrained, EachMethod,
                         testing::Values(ConstraintMethod::kSquaredPenalty, ConstraintMethod::kLogBarrier,
                                         ConstraintMethod::kAugmentedLagrangian),
                         [](const auto& method) {
                           std::string name = toString(method.param);
                           std::erase(name, ' ');
                           return name;
                         });

TEST(ConstrainedSolver, TestProblemsHaveTheirDerivatives) {
  for (const KnownProblem& known : knownProblems()) {
    for (const SmoothFunction& f : {known.problem.residuals, known.problem.cost, known.problem.inequalities,
                                    known.problem.equalities}) {
      if (!f) continue;
      const JacobianCheck check =
          checkJacobian([&](const VectorXd& x) { return f(x).y; }, f(known.start).J, known.start);
      EXPECT_TRUE(check.ok) << known.name << ": " << check.message;
    }
  }
}

TEST(ConstrainedSolver, SolvesLeastSquaresWithoutConstraintsInOneStep) {
  const MatrixXd J = rows({{1, 2}, {3, -1}, {0.5, 1}});
  const VectorXd b = numbers({1, 2, 3});
  const ConstrainedResult result = solveConstrained({.residuals =
                                                         [&](const VectorArg& x) {
                                                           return FunctionValue{J * x - b, J};
                                                         }},
                                                    VectorXd::Zero(2));
  EXPECT_EQ(result.status, ConstrainedStatus::kSolved);
  EXPECT_EQ(result.iterations, 1);
  const VectorXd wanted = (J.transpose() * J).inverse() * J.transpose() * b;
  EXPECT_LT((result.x - wanted).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(result.mostViolated, "");
}

TEST(ConstrainedSolver, StartsFromMultipliersOfAnEarlierResult) {
  const KnownProblem known = hockSchittkowski43();
  const ConstrainedResult cold = solveConstrained(known.problem, known.start);
  const ConstrainedResult warm = solveConstrained(
      known.problem, cold.x, {.penalty = cold.penalty, .inequalityMultipliers = cold.inequalityMultipliers});
  EXPECT_EQ(warm.status, ConstrainedStatus::kSolved);
  EXPECT_LT(warm.iterations, cold.iterations / 3);
  EXPECT_NEAR(warm.cost, -44, 1e-7);
}

TEST(ConstrainedSolver, LogsEachStep) {
  const KnownProblem known = hockSchittkowski71();
  const ConstrainedResult result = solveConstrained(known.problem, known.start);
  ASSERT_EQ(static_cast<int>(result.log.size()), result.iterations);
  EXPECT_EQ(result.log.back().cost, result.cost);
  EXPECT_EQ(result.log.back().violation, result.violation);
  EXPECT_GE(result.evaluations, result.iterations);
}

TEST(ConstrainedSolver, EndsWithoutSolutionWhereThereIsNone) {
  const SmoothFunction down = [](const VectorArg& x) { return FunctionValue{-x, row({-1})}; };
  EXPECT_EQ(solveConstrained({.cost = down}, VectorXd::Zero(1)).status, ConstrainedStatus::kUnbounded);
  const SmoothFunction nan = [](const VectorArg&) { return FunctionValue{row({std::nan("")}), row({1})}; };
  EXPECT_EQ(solveConstrained({.cost = nan}, VectorXd::Zero(1)).status, ConstrainedStatus::kNotFinite);
  const KnownProblem known = hockSchittkowski71();
  const ConstrainedResult few = solveConstrained(known.problem, known.start, {.maxIterations = 2});
  EXPECT_EQ(few.status, ConstrainedStatus::kBudgetSpent);
  EXPECT_GE(few.iterations, 2);
  EXPECT_LE(few.iterations, 4);  // the others to see whether it is infeasible
  // A gradient that points the wrong way: nothing is gained along it.
  const SmoothFunction wrong = [](const VectorArg& x) { return FunctionValue{x, row({-1})}; };
  const ConstrainedResult stuck = solveConstrained({.cost = wrong}, VectorXd::Zero(1));
  EXPECT_EQ(stuck.status, ConstrainedStatus::kNoProgress) << stuck.message;
}

SmoothFunction scalar(const std::function<double(double)>& f, const std::function<double(double)>& slope) {
  return [=](const VectorArg& x) { return FunctionValue{numbers({f(x[0])}), row({slope(x[0])})}; };
}

TEST(ConstrainedSolver, TakesNoNumberThatIsNoneForASolution) {
  // |x| - 1 has no slope at 0.
  const SmoothFunction kink =
      scalar([](double x) { return std::abs(x) - 1; }, [](double x) { return x / std::abs(x); });
  EXPECT_EQ(solveConstrained({.residuals = kink}, VectorXd::Zero(1)).status, ConstrainedStatus::kNotFinite);
  // 1 <= sqrt(x) ends at 0, and the cost has its minimum beyond.
  const SmoothFunction root =
      scalar([](double x) { return 1 - std::sqrt(x); }, [](double x) { return -.5 / std::sqrt(x); });
  const SmoothFunction beyond = scalar([](double x) { return x + 1; }, [](double) { return 1; });
  for (const ConstraintMethod method :
       {ConstraintMethod::kSquaredPenalty, ConstraintMethod::kAugmentedLagrangian}) {
    const ConstrainedResult result =
        solveConstrained({.residuals = beyond, .inequalities = root}, numbers({4}), {.method = method});
    EXPECT_TRUE(result.status != ConstrainedStatus::kSolved || std::abs(result.x[0] - 1) < 1e-5)
        << result.message;
    EXPECT_EQ(result.status == ConstrainedStatus::kSolved, result.violation <= 1e-8) << result.message;
  }
}

TEST(ConstrainedSolver, KeepsToTheDomainOfACost) {
  // x - a log x: differences of its slope reach below 0.
  const SmoothFunction cost =
      scalar([](double x) { return x - 1e-5 * std::log(x); }, [](double x) { return 1 - 1e-5 / x; });
  EXPECT_NO_THROW((void)solveConstrained({.cost = cost}, numbers({5e-5})));
}

TEST(ConstrainedSolver, HoldsConcaveCostsByTheirConstraints) {
  const SmoothFunction concave = scalar([](double x) { return -x * x; }, [](double x) { return -2 * x; });
  const SmoothFunction box = [](const VectorArg& x) {
    return FunctionValue{Eigen::Vector2d(x[0] - 1, -x[0] - 1), Eigen::Vector2d(1, -1)};
  };
  for (const ConstraintMethod method :
       {ConstraintMethod::kSquaredPenalty, ConstraintMethod::kAugmentedLagrangian}) {
    const ConstrainedResult result =
        solveConstrained({.cost = concave, .inequalities = box}, numbers({.1}), {.method = method});
    EXPECT_EQ(result.status, ConstrainedStatus::kSolved) << result.message;
    EXPECT_NEAR(result.x[0], 1, 1e-6);
  }
}

TEST(ConstrainedSolver, CallsNothingInfeasibleForItsScale) {
  const SmoothFunction square = scalar([](double x) { return x; }, [](double) { return 1; });
  const SmoothFunction faint = scalar([](double x) { return 1e-4 * (x - 100); }, [](double) { return 1e-4; });
  const SmoothFunction steep = scalar([](double x) { return 1000 * x; }, [](double) { return 1000; });
  const SmoothFunction one = scalar([](double x) { return x - 1; }, [](double) { return 1; });
  for (const ConstraintMethod method : {ConstraintMethod::kSquaredPenalty, ConstraintMethod::kLogBarrier,
                                        ConstraintMethod::kAugmentedLagrangian}) {
    EXPECT_NE(solveConstrained({.residuals = square, .equalities = faint}, numbers({.1}), {.method = method})
                  .status,
              ConstrainedStatus::kInfeasible);
    EXPECT_NE(
        solveConstrained({.residuals = steep, .equalities = one}, numbers({0}), {.method = method}).status,
        ConstrainedStatus::kInfeasible);
  }
}

TEST(ConstrainedSolver, NamesWhatCannotBeMet) {
  const SmoothFunction square = scalar([](double x) { return x; }, [](double) { return 1; });
  const SmoothFunction point = [](const VectorArg& x) {
    return FunctionValue{Eigen::Vector2d(x[0] - 1, 1 - x[0]), Eigen::Vector2d(1, -1)};
  };
  const ConstrainedResult result =
      solveConstrained({.residuals = square, .inequalities = point, .inequalityNames = {"above", "below"}},
                       numbers({0}), {.method = ConstraintMethod::kLogBarrier});
  EXPECT_EQ(result.status, ConstrainedStatus::kInfeasible);
  EXPECT_THAT(result.message, testing::HasSubstr("most violated is above"));
}

TEST(ConstrainedSolver, KeepsNoRoomForStepsThatAreNeverTaken) {
  const SmoothFunction square = scalar([](double x) { return x; }, [](double) { return 1; });
  const ConstrainedResult result =
      solveConstrained({.residuals = square}, numbers({1}), {.maxIterations = 2'000'000'000});
  EXPECT_EQ(result.status, ConstrainedStatus::kSolved);
}

TEST(ConstrainedSolver, SaysWhatIsWrong) {
  const SmoothFunction square = [](const VectorArg& x) {
    return FunctionValue{x, MatrixXd::Identity(x.size(), x.size())};
  };
  const auto expect = [&](const ConstrainedOptions& options, const char* text) {
    EXPECT_REX_ERROR(solveConstrained({.residuals = square}, VectorXd::Ones(1), options), text);
  };
  expect({.tolerance = 0}, "constrained solver: tolerance: found 0, wanted a positive, finite number");
  expect({.stationarity = -1},
         "constrained solver: stationarity: found -1, wanted a positive, finite number");
  expect({.stepTolerance = 0}, "constrained solver: step tolerance: found 0");
  expect({.penalty = 0}, "constrained solver: penalty: found 0");
  expect({.penalty = 2, .largestPenalty = 1},
         "constrained solver: largest penalty: found 1, wanted no less than the penalty at the start");
  expect({.barrier = std::nan("")}, "constrained solver: barrier: found nan");
  expect({.factor = 1}, "constrained solver: factor: found 1, wanted a finite number above 1");
  expect({.damping = -1}, "constrained solver: damping: found -1, wanted a finite number, 0 or more");
  expect({.maxIterations = 0}, "constrained solver: budget of iterations: found 0, wanted at least 1");
  expect({.inequalityMultipliers = VectorXd::Ones(2)},
         "multipliers of inequalities: found a vector of size 2, wanted size 0");
  expect({.equalityMultipliers = VectorXd::Ones(1)},
         "multipliers of equalities: found a vector of size 1, wanted size 0");
  EXPECT_REX_ERROR(solveConstrained({.residuals = square, .equalities = square}, VectorXd::Ones(1),
                                    {.equalityMultipliers = numbers({std::nan("")})}),
                   "multipliers of equalities: number 0: found nan");
  EXPECT_REX_ERROR(solveConstrained({.residuals = square}, VectorXd(0)),
                   "constrained solver: coordinates of the start: found 0, wanted at least 1");
  EXPECT_REX_ERROR(solveConstrained({.residuals = square}, numbers({std::nan("")})),
                   "constrained solver: start: number 0: found nan, wanted a finite number");
  EXPECT_REX_ERROR(solveConstrained(ConstrainedProblem{}, VectorXd::Ones(1)),
                   "problem with constraints: found neither residuals nor a cost");
  EXPECT_REX_ERROR(solveConstrained({.cost = square}, VectorXd::Ones(2)),
                   "cost: found a vector of size 2, wanted size 1");
  const SmoothFunction flat = [](const VectorArg& x) { return FunctionValue{x, MatrixXd::Ones(1, 3)}; };
  EXPECT_REX_ERROR(solveConstrained({.residuals = square, .inequalities = flat}, VectorXd::Ones(2)),
                   "inequalities: Jacobian: found 1 x 3, wanted 2 x 2");
}

}  // namespace rex::constrained_solver_test
