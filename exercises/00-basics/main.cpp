#include <cmath>

#include "exercise.h"
#include "show.h"

using namespace rex;

// Part 1: matrix equations and vector derivatives.

Eigen::MatrixXd equationA(const Eigen::MatrixXd& A) {
  // TODO: solve X A + A^T = Id on paper first. inverse(A) and solve(A, b) are there.
  return Eigen::MatrixXd::Zero(A.rows(), A.cols());
}

Eigen::MatrixXd equationB(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& C) {
  // TODO: X^T C = (2 A (X + B))^T. All terms with X belong on one side.
  return Eigen::MatrixXd::Zero(B.rows(), B.cols());
}

Eigen::VectorXd equationC(const Eigen::MatrixXd& A, const Eigen::VectorXd& y) {
  // TODO: (A x - y)^T A = 0, with an A that has no inverse.
  return Eigen::VectorXd::Zero(A.cols());
}

Eigen::VectorXd equationD(const Eigen::MatrixXd& A, const Eigen::VectorXd& y, const Eigen::MatrixXd& B) {
  // TODO: (A x - y)^T A + x^T B = 0.
  return Eigen::VectorXd::Zero(A.cols());
}

Eigen::MatrixXd productDerivative(const Evaluation& f, const Eigen::MatrixXd& C, const Evaluation& g) {
  // TODO: the derivative of f(x)^T C g(x), a row: the product rule, with an eye on shapes and transposes.
  return Eigen::MatrixXd::Zero(1, f.J.cols());
}

Minimum quadraticMinimum(const Eigen::MatrixXd& A, const Eigen::VectorXd& y, const Eigen::MatrixXd& C,
                         const Eigen::MatrixXd& B) {
  // TODO: where is the derivative of (A x - y)^T C (A x - y) + x^T B x zero, and what is its value there?
  return {Eigen::VectorXd::Zero(A.cols()), 0};
}

// Part 2: optimisation.

// TODO: what the two methods have in common can be a function of its own, here.

std::vector<Eigen::VectorXd> gradientDescent(const ScalarFunction& f, const VectorFunction& gradient,
                                             const Eigen::VectorXd& start, const SearchOptions& options) {
  std::vector<Eigen::VectorXd> path = {start};
  // TODO: at most options.maxSteps steps downhill; path.back() is the point where you are. How short
  // must the gradient be at the end, and how long is a step?
  return path;
}

std::vector<Eigen::VectorXd> gaussNewton(const VectorFunction& phi, const MatrixFunction& J,
                                         const Eigen::VectorXd& start, const SearchOptions& options) {
  std::vector<Eigen::VectorXd> path = {start};
  // TODO: as above, with another direction and another first trial. What are f and its gradient here?
  return path;
}

// Part 3: the book on the table.

Eigen::Matrix3d bookPose(const Eigen::Vector2d& move, double angle) {
  // TODO: fill in a matrix M with M << (nine numbers, row by row), and return it.
  return Eigen::Matrix3d::Identity();
}

Eigen::Vector2d mapped(const Eigen::Matrix3d& X_AB, const Eigen::Vector2d& p_B) {
  // TODO: p_A. Eigen::Vector3d(x, y, 1) makes a vector, and v.head(2) is v without its third entry.
  return p_B;
}

Eigen::Matrix3d inverted(const Eigen::Matrix3d& X_AB) {
  // TODO: X_BA. M(0, 2) is the entry of M in row 0 and column 2; counting starts with 0.
  return X_AB;
}

Eigen::Matrix3d seenFrom(const Eigen::Matrix3d& X_WA, const Eigen::Matrix3d& X_WB) {
  // TODO: X_AB.
  return X_WB;
}

// Part 4: Bayes.

Fruit fruitBoxes(const std::vector<int>& apples, const std::vector<int>& oranges) {
  const Eigen::Index boxes = static_cast<Eigen::Index>(apples.size());
  Fruit fruit{.apple = 0, .boxGivenApple = Eigen::VectorXd::Zero(boxes)};
  // TODO: fill in both. Mind that 8 / 12 is 0 for integers, and 8. / 12 is not.
  return fruit;
}

Doors montyHall(int boxes, int opened) {
  // TODO: return {P(prize) if you stay, P(prize) if you swap}.
  return {};
}

TableAnswers jointTable(const Eigen::MatrixXd& P_XY) {
  TableAnswers answers{.PX = Eigen::VectorXd::Zero(P_XY.rows()),
                       .PY = Eigen::VectorXd::Zero(P_XY.cols()),
                       .XGivenY = Eigen::MatrixXd::Zero(P_XY.rows(), P_XY.cols()),
                       .independent = false};
  // TODO: fill in all four. P_XY(x, y) is one entry, P_XY.row(x) and P_XY.col(y) are a row and a column.
  return answers;
}

// Part 5: beliefs.

GaussianBelief product(const GaussianBelief& p, const GaussianBelief& q) {
  // TODO: equation (5) of exercise 12.8.2.
  return p;
}

GaussianBelief propagated(const GaussianBelief& y, const Eigen::VectorXd& a, const Eigen::MatrixXd& F,
                          const Eigen::MatrixXd& A) {
  // TODO: equation (6) of exercise 12.8.2.
  return {a, A};
}

BetaBelief betaPosterior(const BetaBelief& prior, const std::vector<int>& data) {
  BetaBelief belief = prior;
  // TODO: what do the outcomes change?
  return belief;
}

Eigen::VectorXd dirichletPosterior(const Eigen::VectorXd& alpha, const std::vector<int>& data) {
  Eigen::VectorXd posterior = alpha;
  // TODO: what do the outcomes 1, ..., K change in entries 0, ..., K - 1?
  return posterior;
}

Eigen::VectorXd nextOutcome(const Eigen::VectorXd& alpha) {
  // TODO: one probability for each outcome.
  return Eigen::VectorXd::Zero(alpha.size());
}

// What follows is given: the parts of the exercise one after another. show.cpp draws the pictures.
int main() {
  // Part 1: equation a for one A. Then a polynomial of degree 9 through twelve noisy samples of a sine: by
  // equation c, and by equation d, where large weights have a price.
  const Eigen::MatrixXd A = (Eigen::MatrixXd(2, 2) << 2, 1, 0, 4).finished();
  print("a: X A + A^T, which should be the identity", equationA(A) * A + A.transpose());
  showFit();

  // Part 2: down a curved valley, whose deepest point is at (1, 1).
  showDescents({-1.2, 1});

  // Part 3: a book is moved by one to the right, then turned by 45 degrees about its own origin.
  const Eigen::Matrix3d X_WB = bookPose({1, 0}, M_PI / 4), X_BW = inverted(X_WB);
  const Eigen::Vector2d dot_B(1, 1), point_W(0, 1);
  print("X_WB", X_WB);
  print("X_BW", X_BW);
  print("dot p in the world", mapped(X_WB, dot_B));
  print("point x in the book's frame", mapped(X_BW, point_W));
  showBook(X_WB, dot_B, point_W);

  // Part 4: two boxes with 8 and 10 apples, 4 and 2 oranges; three doors, one of them opened; and a table.
  const Fruit fruit = fruitBoxes({8, 10}, {4, 2});
  print("P(apple)", fruit.apple);
  print("P(box | apple)", fruit.boxGivenApple);
  const Doors doors = montyHall(3, 1);
  print("P(prize) if you stay", doors.stay);
  print("P(prize) if you swap", doors.swap);
  const TableAnswers answers = jointTable((Eigen::MatrixXd(2, 2) << .06, .24, .14, .56).finished());
  print("P(X)", answers.PX);
  print("P(Y)", answers.PY);
  print("P(X | Y)", answers.XGivenY);
  print("independent", answers.independent);

  // Part 5: two sources about one x, robots that drive without looking, a coin and a wheel of fortune.
  showProduct();
  showPropagation();
  showCoin({.a = 2, .b = 2}, 0.7);
  showWheel({0.5, 0.3, 0.2});
}
