#include <cmath>

#include "course/clearances.h"
#include "exercise.h"
#include "show.h"

using namespace rex;

TermValue differenceTerm(const Eigen::MatrixXd& window, double tau) {
  // TODO: the columns of the window, weighted; which power of tau belongs to order k?
  return {Eigen::VectorXd::Zero(window.rows()), Eigen::MatrixXd::Zero(window.rows(), window.size())};
}

double motionCost(const Eigen::MatrixXd& prefix, const Eigen::MatrixXd& X, int k, double tau) {
  // TODO: one window for each t; the first ones reach into the prefix.
  return 0;
}

TermValue taskDifference(const std::vector<TermValue>& phi, double tau) {
  // TODO: the same weights as above. On which configuration does each phi depend?
  const auto k = static_cast<Eigen::Index>(phi.size()) - 1;
  const Eigen::Index d = phi[0].J.rows(), n = phi[0].J.cols();
  return {Eigen::VectorXd::Zero(d), Eigen::MatrixXd::Zero(d, (k + 1) * n)};
}

BandSystem assembled(const std::vector<Term>& terms, int n, int steps) {
  // TODO: each term adds to some columns of the band. What becomes of the columns of J that belong to the
  // prefix?
  return {Eigen::MatrixXd::Zero(n, n * steps), Eigen::VectorXd::Zero(n * steps)};
}

Eigen::MatrixXd bandCholesky(const Eigen::MatrixXd& band) {
  // TODO: column by column. Which later columns does a column change?
  return {};
}

Eigen::VectorXd bandSolve(const Eigen::MatrixXd& L, const Eigen::VectorXd& b) {
  // TODO: first L y = b from above, then L^T x = y from below.
  return Eigen::VectorXd::Zero(b.size());
}

std::vector<Eigen::MatrixXd> descended(const Terms& terms, const Eigen::MatrixXd& start, double tolerance) {
  // TODO: assemble, factor, solve, and go as far as the cost falls.
  return {start};
}

Term asCost(const Term& term, const Eigen::VectorXd& multipliers, double mu) {
  // TODO: complete the square. When does an inequality still count?
  return term;
}

Eigen::VectorXd nextMultipliers(const Term& term, const Eigen::VectorXd& multipliers, double mu) {
  // TODO: differentiate mu y^T y + m^T y. What multiplies dy/dx?
  return multipliers;
}

Minimum minimised(const Terms& terms, const Eigen::MatrixXd& start, double mu, const Accuracy& accuracy) {
  // TODO: minimise with asCost() in place of the terms, then new multipliers, and again. What if the
  // violation hardly falls?
  return {start, std::vector<Eigen::VectorXd>(terms(start).size()), {0}, {0}};
}

Eigen::MatrixXd throughPoints(const Eigen::VectorXd& start, const Eigen::MatrixXd& points,
                              const std::vector<int>& when, double tau) {
  // TODO: which terms are costs, and which are equalities?
  return start.replicate(1, when.back() + 1);
}

TermValue keptApart(Simulator& S, const Eigen::MatrixXd& window, double margin, int samples) {
  // TODO: move S along the way; how does the posture at s depend on both ends?
  const Eigen::Index rows = samples * clearances(S).y.size();
  return {Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(rows, window.size())};
}

Eigen::MatrixXd aroundObstacle(Simulator& S, const Errand& errand) {
  // TODO: start through the detour; then costs, ends, and keptApart() at each step.
  return S.getJointAngles().replicate(1, errand.steps);
}

// What follows is given, and never graded: change it as you like. show.h says what each line draws.

int main() {
  // Part 1: a motion from 0 to 1 in a second, cut into more and more steps.
  showCosts();

  // Parts 2 and 3: a point goes past a disc, whose inside has a price at first, and then is forbidden.
  showDescent();
  showDisc();

  // Part 4: from (0, 0) through four points, one after each second.
  Eigen::MatrixXd points(2, 4);
  points << 1, 2, 3, 4, 1, -1, .5, 0;
  showReach();
  showVia(points, {19, 39, 59, 79}, .05);

  // Part 5: an arm and a ball.
  showArm();
}
