#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "trajectory/motion_terms.h"
#include "trajectory/term_check.h"
#include "trajectory/trajectory_optimizer.h"

namespace rex::contact_terms_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBall = 0.05, kPost = 0.01;

ShapeSpec contactShape(const Shape& shape, const Pose& X_BS = {}) {
  return {.name = "", .X_BS = X_BS, .shape = shape, .contact = true};
}

const ShapePair kBoth[] = {{0, 1}};  // of linked bodies: asked for

// A ball that slides in the plane, and a thin post upright at (0.5, 0).
Model ballAndPost() {
  SceneSpec spec;
  spec.name = "post";
  spec.bodies.push_back(
      {.name = "ball", .X_WB = {}, .shapes = {contactShape({.type = ShapeType::kSphere, .radius = kBall})}});
  spec.joints.push_back({.name = "plane",
                         .parent = "world",
                         .child = "ball",
                         .type = JointType::kPlanarXY,
                         .X_PF = {},
                         .X_MC = {}});
  spec.worldShapes.push_back(contactShape({.type = ShapeType::kCapsule, .extent = {0, 0, 1}, .radius = kPost},
                                          translation(0.5, 0, 0)));
  return compile(spec);
}

double gapAt(const VectorXd& q) { return (q - Eigen::Vector2d(0.5, 0)).norm() - kBall - kPost; }

MatrixXd pathOf(const VectorXd& from, const MatrixXd& X) {
  MatrixXd path(X.rows(), X.cols() + 1);
  path << from, X;
  return path;
}

const ContactSampling kSampling{.margin = 0.03, .samples = 12};

TEST(ContactTerms, HaveTheirDerivatives) {
  const Model model = ballAndPost();
  const ContactModel contacts(model, kBoth);
  const MatrixXd X = (MatrixXd(2, 2) << 0.42, 0.6, 0.02, 0.06).finished();
  for (const TrajectoryTerm& term :
       {contactCostTerm(model, contacts, kSampling, 3), clearanceTerm(model, contacts, kSampling)}) {
    const FunctionValue value = valueOf(term, X, 1);
    EXPECT_GT(value.y.maxCoeff(), 0.5);
    const JacobianCheck check = checkTerm(term, X, 1);
    EXPECT_TRUE(check.ok) << term.name << ": " << check.message;
  }
}

TEST(ContactTerms, MeasureDistancesBetweenSteps) {
  const Model model = ballAndPost();
  const ContactModel contacts(model, kBoth);
  const MatrixXd X = (MatrixXd(2, 2) << 0.3, 0.6, 0.02, 0.06).finished();
  const FunctionValue cost = valueOf(contactCostTerm(model, contacts, kSampling, 3), X, 1);
  const FunctionValue clearance = valueOf(clearanceTerm(model, contacts, kSampling), X, 1);
  ASSERT_EQ(cost.y.size(), 12);
  for (int i = 0; i < 12; ++i) {
    const double share = (i + 1) / 12., gap = gapAt((1 - share) * X.col(0) + share * X.col(1));
    EXPECT_NEAR(cost.y[i], std::sqrt(3. / 12) * std::max(0., 1 - gap / 0.03), 1e-12);
    EXPECT_NEAR(clearance.y[i], std::max(-1., 1 - gap / 0.03), 1e-12);
  }
}

TEST(TrajectoryClearance, FindsTheStepThatComesNearest) {
  const Model model = ballAndPost();
  const ContactModel contacts(model, kBoth);
  const MatrixXd path = (MatrixXd(2, 4) << 0, 0.3, 0.7, 1, 0.08, 0.08, 0.08, 0.08).finished();
  const TrajectoryClearance clearance = trajectoryClearance(model, contacts, path, 1e-6);
  EXPECT_EQ(clearance.step, 1);
  EXPECT_NEAR(clearance.distance, 0.02, 1e-6);
  const TrajectoryClearance none = trajectoryClearance(model, ContactModel(model, {}), path, 1e-6);
  EXPECT_EQ(none.distance, std::numeric_limits<double>::infinity());
}

// Steps are 0.2 m, the ball and the post 0.12 m across: the straight way has no step in contact.
struct Crossing {
  Model model = ballAndPost();
  ContactModel contacts{model, kBoth};
  VectorXd from = Eigen::Vector2d(0, 0.004), to = Eigen::Vector2d(1, 0.004);
  static constexpr int kSteps = 5;

  [[nodiscard]] TrajectoryResult solve(const std::vector<TrajectoryTerm>& terms,
                                       const ConstrainedOptions& options = {}) const {
    std::vector<TrajectoryTerm> all = terms;
    all.push_back(velocityTerm());
    all.push_back(as(TermKind::kEquality, at(postureTerm(to), kSteps - 1)));
    const TrajectoryProblem problem(all, from, kSteps, 1. / kSteps);
    return optimizeTrajectory(problem, straightTrajectory(from, to, kSteps), options);
  }
  [[nodiscard]] double clearanceOf(const MatrixXd& X) const {
    return trajectoryClearance(model, contacts, pathOf(from, X), 1e-6).distance;
  }
};

TEST(ContactTerms, WithOneSampleMissAPostBetweenSteps) {
  const Crossing crossing;
  const TrajectoryResult result =
      crossing.solve({clearanceTerm(crossing.model, crossing.contacts, {.margin = 0.03, .samples = 1})});
  EXPECT_EQ(result.solution.status, ConstrainedStatus::kSolved);
  for (const auto& q : result.X.colwise()) EXPECT_GT(gapAt(q), 0.03 - 1e-7);
  EXPECT_LT(crossing.clearanceOf(result.X), -0.05);  // it went through, and the proof says so
}

TEST(ContactTerms, DoNotTunnel) {
  const Crossing crossing;
  const TrajectoryResult result =
      crossing.solve({clearanceTerm(crossing.model, crossing.contacts, kSampling)});
  EXPECT_EQ(result.solution.status, ConstrainedStatus::kSolved) << result.solution.message;
  EXPECT_GT(crossing.clearanceOf(result.X), 0.025);
  EXPECT_GT(result.solution.cost, 1.001);  // longer than straight
}

TEST(ContactTerms, MayOnlyCost) {
  const Crossing crossing;
  const TrajectoryResult result =
      crossing.solve({contactCostTerm(crossing.model, crossing.contacts, kSampling, 100)});
  EXPECT_EQ(result.solution.status, ConstrainedStatus::kSolved) << result.solution.message;
  const double clearance = crossing.clearanceOf(result.X);
  EXPECT_GT(clearance, 0.01);
  EXPECT_LT(clearance, 0.03);  // it leans on the margin
}

TEST(ContactTerms, NameTheStepWhereTheGoalIsInThePost) {
  Crossing crossing;
  crossing.to = Eigen::Vector2d(0.5, 0.004);
  const TrajectoryResult result =
      crossing.solve({clearanceTerm(crossing.model, crossing.contacts, kSampling)});
  EXPECT_EQ(result.solution.status, ConstrainedStatus::kInfeasible) << result.solution.message;
  EXPECT_THAT(result.solution.mostViolated, testing::HasSubstr("at step 4, row"));
  EXPECT_GT(result.solution.violation, 0.05);
}

TEST(ContactTerms, SayWhatIsWrong) {
  const Model model = ballAndPost();
  const ContactModel contacts(model, kBoth);
  EXPECT_REX_ERROR(clearanceTerm(model, contacts, {.margin = 0}),
                   "margin of a contact term: found 0 m, wanted a positive, finite number of metres");
  EXPECT_REX_ERROR(contactCostTerm(model, contacts, {.samples = 0}),
                   "samples of a contact term: found 0, wanted at least 1");
  EXPECT_REX_ERROR(contactCostTerm(model, contacts, {}, -1),
                   "precision of a contact term: found -1, wanted a positive, finite number");
  EXPECT_REX_ERROR(trajectoryClearance(model, contacts, VectorXd::Zero(2), 1e-3),
                   "configurations of a path: found 1, wanted at least 2");
}

}  // namespace rex::contact_terms_test
