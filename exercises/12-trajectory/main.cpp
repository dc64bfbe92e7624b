#include <cmath>

#include "course/clearances.h"
#include "exercise.h"
#include "pictures.h"
#include "trajectory/motion_terms.h"
#include "trajectory/trajectory_optimizer.h"

using namespace rex;

// Keeps the compiler quiet about what a function below does not use yet.
template <class... Unused>
void notUsedYet(const Unused&...) {}

TermValue differenceTerm(const Eigen::MatrixXd& window, double tau) {
  // TODO: the columns of the window, weighted; which power of tau belongs to order k?
  notUsedYet(tau);
  return {Eigen::VectorXd::Zero(window.rows()), Eigen::MatrixXd::Zero(window.rows(), window.size())};
}

double motionCost(const Eigen::MatrixXd& prefix, const Eigen::MatrixXd& X, int k, double tau) {
  // TODO: one window for each t; the first ones reach into the prefix.
  notUsedYet(prefix, X, k, tau);
  return 0;
}

TermValue taskDifference(const std::vector<TermValue>& phi, double tau) {
  // TODO: the same weights as above. On which configuration does each phi depend?
  notUsedYet(tau);
  const auto k = static_cast<Eigen::Index>(phi.size()) - 1;
  const Eigen::Index d = phi[0].J.rows(), n = phi[0].J.cols();
  return {Eigen::VectorXd::Zero(d), Eigen::MatrixXd::Zero(d, (k + 1) * n)};
}

BandSystem assembled(const std::vector<Term>& terms, int n, int steps) {
  // TODO: each term adds to some columns of the band. What becomes of the columns of J that belong to the
  // prefix?
  notUsedYet(terms);
  return {Eigen::MatrixXd::Zero(n, n * steps), Eigen::VectorXd::Zero(n * steps)};
}

Eigen::MatrixXd bandCholesky(const Eigen::MatrixXd& band) {
  // TODO: column by column. Which later columns does a column change?
  notUsedYet(band);
  return {};
}

Eigen::VectorXd bandSolve(const Eigen::MatrixXd& L, const Eigen::VectorXd& b) {
  // TODO: first L y = b from above, then L^T x = y from below.
  notUsedYet(L);
  return Eigen::VectorXd::Zero(b.size());
}

std::vector<Eigen::MatrixXd> descended(const Terms& terms, const Eigen::MatrixXd& start, double tolerance) {
  // TODO: assemble, factor, solve, and go as far as the cost falls.
  notUsedYet(terms, tolerance);
  return {start};
}

Term asCost(const Term& term, const Eigen::VectorXd& multipliers, double mu) {
  // TODO: complete the square. When does an inequality still count?
  notUsedYet(multipliers, mu);
  return term;
}

Eigen::VectorXd nextMultipliers(const Term& term, const Eigen::VectorXd& multipliers, double mu) {
  // TODO: differentiate mu y^T y + m^T y. What multiplies dy/dx?
  notUsedYet(term, mu);
  return multipliers;
}

Minimum minimised(const Terms& terms, const Eigen::MatrixXd& start, double mu, const Accuracy& accuracy) {
  // TODO: minimise with asCost() in place of the terms, then new multipliers, and again. What if the
  // violation hardly falls?
  notUsedYet(mu, accuracy);
  return {start, std::vector<Eigen::VectorXd>(terms(start).size()), {0}, {0}};
}

Eigen::MatrixXd throughPoints(const Eigen::VectorXd& start, const Eigen::MatrixXd& points,
                              const std::vector<int>& when, double tau) {
  // TODO: which terms are costs, and which are equalities?
  notUsedYet(points, tau);
  return start.replicate(1, when.back() + 1);
}

TermValue keptApart(Simulator& S, const Eigen::MatrixXd& window, double margin, int samples) {
  // TODO: move S along the way; how does the posture at s depend on both ends?
  notUsedYet(margin);
  const Eigen::Index rows = samples * clearances(S).y.size();
  return {Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(rows, window.size())};
}

Eigen::MatrixXd aroundObstacle(Simulator& S, const Errand& errand) {
  // TODO: start through the detour; then costs, ends, and keptApart() at each step.
  return S.getJointAngles().replicate(1, errand.steps);
}

// What follows is given.

// A point in the plane on its way past a disc, and what the rounds do to it.
void showDisc(const DiscPath& disc, const Eigen::MatrixXd& byLibrary) {
  const Terms terms = [&](const Eigen::MatrixXd& X) { return disc.termsAt(X, &differenceTerm); };
  const Minimum found = minimised(terms, disc.guess(), 100, {1e-6, 1e-4});
  plot("disc", discFigure(disc, found.X, byLibrary));
  plot("rounds", roundsFigure(found));
  print("path past the disc, cost", found.cost.back());
}

// The least cost from 0 to 1 in a second, beside what it should be.
void showReach() {
  Eigen::MatrixXd table(3, 3);
  for (int i = 0; i < 3; ++i) {
    const int T = i == 0 ? 5 : i == 1 ? 20 : 100;
    const Eigen::MatrixXd X =
        throughPoints(Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Ones(1, 1), {T - 1}, 1. / T);
    table(i, 0) = T;
    table(i, 1) = motionCost(Eigen::MatrixXd::Zero(1, 2), X, 2, 1. / T);
    table(i, 2) = 12. * T * T / (T * T - 1.);
  }
  print("T, least cost from 0 to 1, 12 T^2 / (T^2 - 1)", table);
}

void showVia() {
  Eigen::MatrixXd points(2, 4);
  points << 1, 2, 3, 4, 1, -1, 0.5, 0;
  plot("via", viaFigure(points, throughPoints(Eigen::VectorXd::Zero(2), points, {19, 39, 59, 79}, 0.05)));
}

// In real time.
void filmMotion(const Eigen::MatrixXd& X, const std::vector<Eigen::Vector3d>& hand) {
  Simulator S(armAmong(kBall, kArmStart));
  S.clearRecording();
  const Eigen::MatrixXd fine = finely(kArmStart, X, 4);
  for (Eigen::Index i = 0; i < fine.cols(); ++i) S.setJointAngles(fine.col(i));
  PictureOptions look;
  look.caption = "Around the ball";
  look.paths = {hand};
  look.view = {2, -0.6, 0.5};
  writeVideo(S, "around", look, 60);
  writeContactSheet(S, "around_sheet", look, 6, 60);
  writeReplay(S, "around", look, {});
}

void showArm() {
  Simulator S(armAmong(kBall, kArmStart));
  Eigen::MatrixXd points(3, 2);
  points << kErrand.detour, kErrand.goal;
  const int last = kErrand.steps - 1;
  const Eigen::MatrixXd direct = throughPoints(kArmStart, kErrand.goal, {last}, kErrand.tau),
                        detour = throughPoints(kArmStart, points, {last / 2, last}, kErrand.tau),
                        X = aroundObstacle(S, kErrand);
  const Swing a = swingOf(S, direct), b = swingOf(S, detour), c = swingOf(S, X);
  plot("arm", armFigure(S,
                        {{"hand, direct", a.hand, kBlue, Pen::dashes},
                         {"hand, detour", b.hand, kGrey, Pen::dashes},
                         {"hand, optimised", c.hand, kOrange, Pen::line, 2.5}},
                        X));
  plot("clearance", clearanceFigure({{"direct", a.nearest, kBlue, Pen::dashes},
                                     {"detour", b.nearest, kGrey, Pen::dashes},
                                     {"optimised", c.nearest, kOrange}}));
  const Eigen::MatrixXd prefix = Eigen::VectorXd(kArmStart).replicate(1, 2);
  print("cost of the detour", motionCost(prefix, detour, 2, kErrand.tau));
  print("cost of the optimised motion", motionCost(prefix, X, 2, kErrand.tau));
  filmMotion(X, c.way);
}

int main() {
  showReach();
  showVia();
  // Once your own optimiser works, its points lie on the library's line.
  const DiscPath disc;
  TrajectoryTerm outside;
  outside.name = "outside of the disc";
  outside.kind = TermKind::kInequality;
  outside.function = [&](const TrajectoryWindow& window, FunctionValue& value) {
    disc.outside(window.X(0, 0), window.X(1, 0), value.y, value.J);
  };
  std::vector<TrajectoryTerm> terms = restAt(disc.to, disc.steps);
  terms.push_back(accelerationTerm());
  terms.push_back(outside);
  const TrajectoryProblem problem(terms, Eigen::VectorXd(disc.from).replicate(1, 2), disc.steps, disc.tau);
  const TrajectoryResult library = optimizeTrajectory(problem, disc.guess(), {.penalty = 100});
  showDisc(disc, library.X);
  print("of the library", library.solution.cost);
  showArm();
}
