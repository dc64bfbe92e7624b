#include <cmath>

#include "exercise.h"
#include "show.h"

using namespace rex;

// Part 1: matrix equations and vector derivatives.

Eigen::MatrixXd equationA(const Eigen::MatrixXd& A) {
  // <solution equationA>
  // X A = Id - A^T, and the A is taken off on the right.
  const Eigen::MatrixXd right = Eigen::MatrixXd::Identity(A.rows(), A.cols()) - A.transpose();
  return right * inverse(A);
  // <todo>
  //| // TODO: solve X A + A^T = Id on paper first. inverse(A) and solve(A, b) are there.
  //| return Eigen::MatrixXd::Zero(A.rows(), A.cols());
  // </solution>
}

Eigen::MatrixXd equationB(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& C) {
  // <solution equationB>
  // Transposed: C^T X = 2 A X + 2 A B.
  const Eigen::MatrixXd AB = A * B;
  return 2 * solve(C.transpose() - 2 * A, AB);
  // <todo>
  //| // TODO: X^T C = (2 A (X + B))^T. All terms with X belong on one side.
  //| return Eigen::MatrixXd::Zero(B.rows(), B.cols());
  // </solution>
}

Eigen::VectorXd equationC(const Eigen::MatrixXd& A, const Eigen::VectorXd& y) {
  // <solution equationC>
  const Eigen::MatrixXd At = A.transpose();
  return solve(At * A, At * y);
  // <todo>
  //| // TODO: (A x - y)^T A = 0, with an A that has no inverse.
  //| return Eigen::VectorXd::Zero(A.cols());
  // </solution>
}

Eigen::VectorXd equationD(const Eigen::MatrixXd& A, const Eigen::VectorXd& y, const Eigen::MatrixXd& B) {
  // <solution equationD>
  const Eigen::MatrixXd At = A.transpose();
  return solve(At * A + B, At * y);
  // <todo>
  //| // TODO: (A x - y)^T A + x^T B = 0.
  //| return Eigen::VectorXd::Zero(A.cols());
  // </solution>
}

Eigen::MatrixXd productDerivative(const Evaluation& f, const Eigen::MatrixXd& C, const Evaluation& g) {
  // <solution productDerivative>
  // The number f^T C g is also g^T C^T f: each factor in turn stands last, and is differentiated there.
  const Eigen::VectorXd before = C.transpose() * f.y, behind = C * g.y;
  return before.transpose() * g.J + behind.transpose() * f.J;
  // <todo>
  //| // TODO: the derivative of f(x)^T C g(x), a row: the product rule, with an eye on shapes and transposes.
  //| return Eigen::MatrixXd::Zero(1, f.J.cols());
  // </solution>
}

Minimum quadraticMinimum(const Eigen::MatrixXd& A, const Eigen::VectorXd& y, const Eigen::MatrixXd& C,
                         const Eigen::MatrixXd& B) {
  // <solution quadraticMinimum>
  const Eigen::MatrixXd AtC = A.transpose() * C;
  const Eigen::VectorXd x = solve(AtC * A + B, AtC * y);
  const Eigen::VectorXd e = A * x - y;
  return {x, e.dot(C * e) + x.dot(B * x)};
  // <todo>
  //| // TODO: where is the derivative of (A x - y)^T C (A x - y) + x^T B x zero, and what is its value there?
  //| return {Eigen::VectorXd::Zero(A.cols()), 0};
  // </solution>
}

// Part 2: optimisation.

// <solution backtracking>
namespace {

// The first step size with sufficient decrease of f along d, where f has the derivative `slope`.
double backtracked(const ScalarFunction& f, const Eigen::VectorXd& x, const Eigen::VectorXd& d, double slope,
                   double alpha, const SearchOptions& options) {
  const double fx = f(x);
  while (!(f(x + alpha * d) <= fx + options.decrease * alpha * slope)) alpha *= options.shrink;
  return alpha;
}

}  // namespace
// <todo>
//| // TODO: what the two methods have in common can be a function of its own, here.
// </solution>

std::vector<Eigen::VectorXd> gradientDescent(const ScalarFunction& f, const VectorFunction& gradient,
                                             const Eigen::VectorXd& start, const SearchOptions& options) {
  std::vector<Eigen::VectorXd> path = {start};
  // <solution gradientDescent>
  double alpha = 1;
  for (int step = 0; step < options.maxSteps; ++step) {
    const Eigen::VectorXd g = gradient(path.back());
    if (g.norm() <= options.tolerance) break;
    alpha = backtracked(f, path.back(), -g, -g.squaredNorm(), alpha, options);
    path.push_back(path.back() - alpha * g);
    alpha *= options.grow;
  }
  // <todo>
  //| // TODO: at most options.maxSteps steps downhill; path.back() is the point where you are. How short
  //| // must the gradient be at the end, and how long is a step?
  // </solution>
  return path;
}

std::vector<Eigen::VectorXd> gaussNewton(const VectorFunction& phi, const MatrixFunction& J,
                                         const Eigen::VectorXd& start, const SearchOptions& options) {
  std::vector<Eigen::VectorXd> path = {start};
  // <solution gaussNewton>
  const auto f = [&](const Eigen::VectorXd& x) { return phi(x).squaredNorm(); };
  for (int step = 0; step < options.maxSteps; ++step) {
    const Eigen::VectorXd x = path.back();
    const Eigen::MatrixXd Jx = J(x), Jt = Jx.transpose();
    const Eigen::VectorXd halfGradient = Jt * phi(x);
    if (2 * halfGradient.norm() <= options.tolerance) break;
    const Eigen::VectorXd d = -solve(Jt * Jx, halfGradient);
    path.push_back(x + backtracked(f, x, d, 2 * halfGradient.dot(d), 1, options) * d);
  }
  // <todo>
  //| // TODO: as above, with another direction and another first trial. What are f and its gradient here?
  // </solution>
  return path;
}

// Part 3: the book on the table.

Eigen::Matrix3d bookPose(const Eigen::Vector2d& move, double angle) {
  // <solution bookPose>
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::Matrix3d X_WB;
  X_WB << c, -s, move.x(), s, c, move.y(), 0, 0, 1;
  return X_WB;
  // <todo>
  //| // TODO: fill in a matrix M with M << (nine numbers, row by row), and return it.
  //| return Eigen::Matrix3d::Identity();
  // </solution>
}

Eigen::Vector2d mapped(const Eigen::Matrix3d& X_AB, const Eigen::Vector2d& p_B) {
  // <solution mapped>
  return (X_AB * Eigen::Vector3d(p_B.x(), p_B.y(), 1)).head(2);
  // <todo>
  //| // TODO: p_A. Eigen::Vector3d(x, y, 1) makes a vector, and v.head(2) is v without its third entry.
  //| return p_B;
  // </solution>
}

Eigen::Matrix3d inverted(const Eigen::Matrix3d& X_AB) {
  // <solution inverted>
  // p_B = R^T (p_A - t), so the translation of the way back is -R^T t.
  const double c = X_AB(0, 0), s = X_AB(1, 0), x = X_AB(0, 2), y = X_AB(1, 2);
  Eigen::Matrix3d X_BA;
  X_BA << c, s, -c * x - s * y, -s, c, s * x - c * y, 0, 0, 1;
  return X_BA;
  // <todo>
  //| // TODO: X_BA. M(0, 2) is the entry of M in row 0 and column 2; counting starts with 0.
  //| return X_AB;
  // </solution>
}

Eigen::Matrix3d seenFrom(const Eigen::Matrix3d& X_WA, const Eigen::Matrix3d& X_WB) {
  // <solution seenFrom>
  return inverted(X_WA) * X_WB;
  // <todo>
  //| // TODO: X_AB.
  //| return X_WB;
  // </solution>
}

// Part 4: Bayes.

Fruit fruitBoxes(const std::vector<int>& apples, const std::vector<int>& oranges) {
  const Eigen::Index boxes = static_cast<Eigen::Index>(apples.size());
  Fruit fruit{.apple = 0, .boxGivenApple = Eigen::VectorXd::Zero(boxes)};
  // <solution fruitBoxes>
  Eigen::VectorXd& joint = fruit.boxGivenApple;  // first P(box, apple), then divided by P(apple)
  for (std::size_t i = 0; i < apples.size(); ++i) {
    const double appleGivenBox = static_cast<double>(apples[i]) / (apples[i] + oranges[i]);
    joint[static_cast<Eigen::Index>(i)] = appleGivenBox / static_cast<double>(boxes);
  }
  fruit.apple = joint.sum();
  joint /= fruit.apple;
  // <todo>
  //| // TODO: fill in both. Mind that 8 / 12 is 0 for integers, and 8. / 12 is not.
  // </solution>
  return fruit;
}

Doors montyHall(int boxes, int opened) {
  // <solution montyHall>
  // The host can always open empty boxes, so what he does says nothing about yours. All the rest of the
  // probability lies, in equal shares, on the other boxes that are closed.
  const double stay = 1. / boxes;
  return {stay, (1 - stay) / (boxes - 1 - opened)};
  // <todo>
  //| // TODO: return {P(prize) if you stay, P(prize) if you swap}.
  //| return {};
  // </solution>
}

TableAnswers jointTable(const Eigen::MatrixXd& P_XY) {
  TableAnswers answers{.PX = Eigen::VectorXd::Zero(P_XY.rows()),
                       .PY = Eigen::VectorXd::Zero(P_XY.cols()),
                       .XGivenY = Eigen::MatrixXd::Zero(P_XY.rows(), P_XY.cols()),
                       .independent = false};
  // <solution jointTable>
  answers.PX = P_XY.rowwise().sum();
  answers.PY = P_XY.colwise().sum();
  answers.independent = true;
  for (Eigen::Index y = 0; y < P_XY.cols(); ++y) {
    answers.XGivenY.col(y) = P_XY.col(y) / answers.PY[y];
    for (Eigen::Index x = 0; x < P_XY.rows(); ++x) {
      if (std::abs(P_XY(x, y) - answers.PX[x] * answers.PY[y]) > 1e-9) answers.independent = false;
    }
  }
  // <todo>
  //| // TODO: fill in all four. P_XY(x, y) is one entry, P_XY.row(x) and P_XY.col(y) are a row and a column.
  // </solution>
  return answers;
}

// Part 5: beliefs.

GaussianBelief product(const GaussianBelief& p, const GaussianBelief& q) {
  // <solution product>
  const Eigen::MatrixXd precisionP = inverse(p.cov), precisionQ = inverse(q.cov);
  const Eigen::MatrixXd cov = inverse(precisionP + precisionQ);
  return {cov * (precisionP * p.mean + precisionQ * q.mean), cov};
  // <todo>
  //| // TODO: equation (5) of exercise 12.8.2.
  //| return p;
  // </solution>
}

GaussianBelief propagated(const GaussianBelief& y, const Eigen::VectorXd& a, const Eigen::MatrixXd& F,
                          const Eigen::MatrixXd& A) {
  // <solution propagated>
  const Eigen::MatrixXd FB = F * y.cov;
  return {a + F * y.mean, A + FB * F.transpose()};
  // <todo>
  //| // TODO: equation (6) of exercise 12.8.2.
  //| return {a, A};
  // </solution>
}

BetaBelief betaPosterior(const BetaBelief& prior, const std::vector<int>& data) {
  BetaBelief belief = prior;
  // <solution betaPosterior>
  for (const int x : data) (x == 1 ? belief.a : belief.b) += 1;
  // <todo>
  //| // TODO: what do the outcomes change?
  // </solution>
  return belief;
}

Eigen::VectorXd dirichletPosterior(const Eigen::VectorXd& alpha, const std::vector<int>& data) {
  Eigen::VectorXd posterior = alpha;
  // <solution dirichletPosterior>
  for (const int x : data) posterior[x - 1] += 1;
  // <todo>
  //| // TODO: what do the outcomes 1, ..., K change in entries 0, ..., K - 1?
  // </solution>
  return posterior;
}

Eigen::VectorXd nextOutcome(const Eigen::VectorXd& alpha) {
  // <solution nextOutcome>
  return alpha / alpha.sum();
  // <todo>
  //| // TODO: one probability for each outcome.
  //| return Eigen::VectorXd::Zero(alpha.size());
  // </solution>
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
