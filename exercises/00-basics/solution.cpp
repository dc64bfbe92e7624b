#include <algorithm>
#include <cmath>

#include "exercise.h"

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

// From here on everything is given: the parts of the exercise one after another, with pictures. Change it as
// you like.

namespace {

// f at `count` equal steps from `first` to `last`.
Series curve(const std::string& label, double first, double last, int count,
             const std::function<double(double)>& f) {
  Series series{.label = label};
  for (int i = 0; i < count; ++i) {
    const double x = first + (last - first) * i / (count - 1);
    series.x.push_back(x);
    series.y.push_back(f(x));
  }
  return series;
}

Series way(const std::string& label, const std::vector<Eigen::VectorXd>& points, SeriesStyle style) {
  Series series{.label = label, .style = style};
  for (const Eigen::VectorXd& p : points) {
    series.x.push_back(p[0]);
    series.y.push_back(p[1]);
  }
  return series;
}

Series polynomial(const std::string& label, const Eigen::VectorXd& weights) {
  return curve(label, -1, 1, 200, [&](double x) {
    double y = 0;
    for (Eigen::Index k = weights.size() - 1; k >= 0; --k) y = y * x + weights[k];
    return y;
  });
}

// A curved valley, as a sum of squares: f = phi^T phi, least at (1, 1).
Eigen::VectorXd valley(const Eigen::VectorXd& x) {
  return Eigen::Vector2d(1 - x[0], 3 * (x[1] - x[0] * x[0]));
}
Eigen::MatrixXd valleyJacobian(const Eigen::VectorXd& x) {
  Eigen::Matrix2d J;
  J << -1, 0, -6 * x[0], 3;
  return J;
}
double depth(const Eigen::VectorXd& x) { return valley(x).squaredNorm(); }
Eigen::VectorXd slope(const Eigen::VectorXd& x) { return 2 * valleyJacobian(x).transpose() * valley(x); }

void showOptimisation() {
  const Eigen::VectorXd start = Eigen::Vector2d(-1.2, 1);
  const std::vector<Eigen::VectorXd> descent = gradientDescent(depth, slope, start, {});
  const std::vector<Eigen::VectorXd> newton = gaussNewton(valley, valleyJacobian, start, {});
  // A logarithmic colour or axis has no zero.
  HeatMap map = heatMapOf([](double x, double y) { return std::max(depth(Eigen::Vector2d(x, y)), 0.01); },
                          {-1.6, 1.6}, {-1, 1.8}, 320, 280);
  map.contours = 12;
  plot("paths", {.title = "Two ways down a curved valley",
                 .xLabel = "x1",
                 .yLabel = "x2",
                 .colorLabel = "f(x)",
                 .logColor = true,
                 .legend = Legend::kBottomLeft,
                 .series = {way("gradient descent", descent, SeriesStyle::kLinesPoints),
                            way("Gauss-Newton", newton, SeriesStyle::kLinesPoints)},
                 .heatMap = map});
  const auto depths = [](const std::string& label, const std::vector<Eigen::VectorXd>& points) {
    Series series{.label = label};
    for (const Eigen::VectorXd& x : points) {
      series.x.push_back(static_cast<double>(series.x.size() + 1));
      series.y.push_back(std::max(depth(x), 1e-16));
    }
    return series;
  };
  plot("convergence", {.title = "How fast f falls",
                       .xLabel = "number of points visited",
                       .yLabel = "f(x)",
                       .logX = true,
                       .logY = true,
                       .series = {depths("gradient descent", descent), depths("Gauss-Newton", newton)}});
}

void showBook() {
  const Eigen::Matrix3d X_WB = bookPose({1, 0}, M_PI / 4), X_BW = inverted(X_WB);
  const Eigen::Vector2d p_W = mapped(X_WB, {1, 1}), x_W(0, 1);
  print("X_WB", X_WB);
  print("X_BW", X_BW);
  print("dot p in the world", p_W);
  print("point x in the book's frame", mapped(X_BW, x_W));
  Series before{.label = "book before", .dashed = true}, after{.label = "book after"};
  const double width = 1.3, height = 1.7;
  for (const auto& [x, y] : {std::pair(0., 0.), {width, 0.}, {width, height}, {0., height}, {0., 0.}}) {
    const Eigen::Vector2d corner_W = mapped(X_WB, {x, y});
    before.x.push_back(x);
    before.y.push_back(y);
    after.x.push_back(corner_W.x());
    after.y.push_back(corner_W.y());
  }
  Figure figure{.title = "The book on the table",
                .xLabel = "x of the world [m]",
                .yLabel = "y of the world [m]",
                .equalAxes = true,
                .yRange = AxisRange{-0.2, 2.3},
                .legend = Legend::kOutside};
  figure.series = {before, after};
  figure.series.push_back({.label = "dot p", .x = {p_W.x()}, .y = {p_W.y()}, .style = SeriesStyle::kPoints});
  figure.series.push_back(
      {.label = "point x", .x = {x_W.x()}, .y = {x_W.y()}, .style = SeriesStyle::kPoints});
  figure.series[2].size = figure.series[3].size = 2;
  figure.regions = {{.x = after.x, .y = after.y}};
  plot("book", figure);
}

void showBayes() {
  const Fruit fruit = fruitBoxes({8, 10}, {4, 2});
  print("P(apple)", fruit.apple);
  print("P(box | apple)", fruit.boxGivenApple);
  const Doors doors = montyHall(3, 1);
  print("P(prize) for who stays", doors.stay);
  print("P(prize) for who swaps", doors.swap);
  const TableAnswers answers = jointTable((Eigen::MatrixXd(2, 2) << .06, .24, .14, .56).finished());
  print("P(X)", answers.PX);
  print("P(Y)", answers.PY);
  print("P(X | Y)", answers.XGivenY);
  print("independent", answers.independent);
}

constexpr Color kBlue{0, 0.45f, 0.7f}, kGreen{0, 0.6f, 0.45f}, kOrange{0.84f, 0.37f, 0},
    kGrey{0.6f, 0.6f, 0.6f};

Eigen::MatrixXd symmetric(double xx, double xy, double yy) {
  Eigen::Matrix2d S;
  S << xx, xy, xy, yy;
  return S;
}

CovarianceEllipse ellipse(const std::string& label, const GaussianBelief& belief, Color color) {
  return {.label = label, .mean = belief.mean, .covariance = belief.cov, .color = color};
}

void showProduct() {
  const GaussianBelief prior{Eigen::Vector2d(0, 0), symmetric(4, 1.5, 1)};
  const GaussianBelief measured{Eigen::Vector2d(2, 2), symmetric(0.5, -0.3, 2)};
  Figure figure{.title = "A prior, a measurement, and what both say together (two standard deviations)",
                .xLabel = "x1",
                .yLabel = "x2",
                .equalAxes = true,
                .legend = Legend::kTopLeft};
  figure.ellipses = {ellipse("prior", prior, kBlue), ellipse("measurement", measured, kGreen),
                     ellipse("product", product(prior, measured), kOrange)};
  plot("product", figure);
}

// Robots drive ahead and to the left without looking: what they believe, and where 200 of them really are.
void showPropagation() {
  const Eigen::VectorXd a = Eigen::Vector2d(2, 0.3);
  const Eigen::MatrixXd F = symmetric(1, 0.15, 1.1), A = symmetric(0.02, 0, 0.005);
  GaussianBelief belief{Eigen::Vector2d(0, 0), symmetric(0.03, 0, 0.03)};
  Rng rng(1);
  std::vector<Eigen::VectorXd> robots;
  for (int i = 0; i < 200; ++i) robots.push_back(std::sqrt(0.03) * rng.normalVector(2));
  Figure figure{.title = "Driving without looking: 200 robots, and the belief (two standard deviations)",
                .xLabel = "x [m]",
                .yLabel = "y [m]",
                .equalAxes = true,
                .legend = Legend::kTopLeft};
  for (int t = 0; t <= 4; ++t) {
    Series cloud = way(t == 0 ? "robots" : "", robots, SeriesStyle::kPoints);
    cloud.marker = Marker::kDot;
    cloud.size = 0.5;
    cloud.color = kGrey;
    figure.series.push_back(cloud);
    figure.ellipses.push_back(ellipse(t == 0 ? "belief" : "", belief, kOrange));
    for (Eigen::VectorXd& x : robots) {
      const Eigen::Vector2d noise(std::sqrt(0.02) * rng.normal(), std::sqrt(0.005) * rng.normal());
      x = a + F * x + noise;
    }
    belief = propagated(belief, a, F, A);
  }
  plot("propagation", figure);
}

double betaDensity(const BetaBelief& belief, double mu) {
  const double logNormaliser =
      std::lgamma(belief.a + belief.b) - std::lgamma(belief.a) - std::lgamma(belief.b);
  return std::exp(logNormaliser + (belief.a - 1) * std::log(mu) + (belief.b - 1) * std::log(1 - mu));
}

void showBeta() {
  Rng rng(4);
  Figure figure{.title = "The belief about a coin after more and more throws",
                .xLabel = "mu = P(x = 1)",
                .yLabel = "density",
                .legend = Legend::kTopLeft,
                .verticalLines = {{.at = 0.7, .label = "true"}}};
  BetaBelief belief{.a = 2, .b = 2};
  int thrown = 0;
  for (const int total : {0, 3, 10, 50, 250}) {
    std::vector<int> data;
    for (; thrown < total; ++thrown) data.push_back(rng.uniform() < 0.7 ? 1 : 0);
    belief = betaPosterior(belief, data);
    figure.series.push_back(curve(std::to_string(total) + " throws", 0.001, 0.999, 400,
                                  [&](double mu) { return betaDensity(belief, mu); }));
  }
  plot("beta", figure);
}

// Points mu with mu_1 + mu_2 + mu_3 = 1 fill a triangle, whose corners are the three outcomes.
const double kTop = std::sqrt(0.75);

Eigen::VectorXd inTriangle(const Eigen::VectorXd& mu) {
  return Eigen::Vector2d(mu[1] + 0.5 * mu[2], kTop * mu[2]);
}

void showDirichlet() {
  const Eigen::Vector3d wheel(0.5, 0.3, 0.2);
  Rng rng(4);
  Eigen::VectorXd alpha = Eigen::Vector3d(1, 1, 1);
  std::vector<Eigen::VectorXd> guesses = {inTriangle(nextOutcome(alpha))};
  for (int t = 0; t < 40; ++t) {
    const double u = rng.uniform();
    alpha = dirichletPosterior(alpha, {u < wheel[0] ? 1 : u < wheel[0] + wheel[1] ? 2 : 3});
    guesses.push_back(inTriangle(nextOutcome(alpha)));
  }
  // Divided by its maximum over the triangle, and zero outside.
  const auto density = [&](double x, double y) {
    const double mu3 = y / kTop, mu2 = x - mu3 / 2, mu1 = 1 - mu2 - mu3;
    if (mu1 <= 0 || mu2 <= 0 || mu3 <= 0) return 0.;
    return std::exp((alpha[0] - 1) * std::log(mu1) + (alpha[1] - 1) * std::log(mu2) +
                    (alpha[2] - 1) * std::log(mu3));
  };
  HeatMap map = heatMapOf(density, {-0.05, 1.05}, {-0.05, 1.05}, 330, 330);
  map.values /= map.values.maxCoeff();
  Series truth = way("true mu", {inTriangle(wheel)}, SeriesStyle::kPoints);
  truth.size = 2;
  const Series triangle{.x = {0, 1, 0.5, 0}, .y = {0, 0, kTop, 0}, .color = kGrey};
  Figure figure{.title = "The belief about a wheel of fortune after 40 turns",
                .xLabel = "from outcome 1 to outcome 2",
                .yLabel = "towards outcome 3",
                .colorLabel = "density / its maximum",
                .equalAxes = true,
                .legend = Legend::kOutside};
  figure.series = {triangle, way("mean of mu, turn by turn", guesses, SeriesStyle::kLine), truth};
  figure.heatMap = map;
  plot("dirichlet", figure);
}

}  // namespace

int main() {
  // Part 1: a polynomial of degree 9 through noisy samples of a sine, with and without a price on its
  // weights.
  Rng rng(1);
  Eigen::MatrixXd A(12, 10);
  Eigen::VectorXd y(12);
  Series data{.label = "data", .style = SeriesStyle::kPoints};
  for (int i = 0; i < 12; ++i) {
    const double x = -1 + i / 5.5;
    for (int k = 0; k < 10; ++k) A(i, k) = std::pow(x, k);
    y[i] = std::sin(3 * x) + 0.2 * rng.normal();
    data.x.push_back(x);
    data.y.push_back(y[i]);
  }
  Series library = polynomial("c, by the library", leastSquares(A, y));
  library.dashed = true;
  Figure fit{.title = "A polynomial of degree 9 through twelve points",
             .xLabel = "x",
             .yLabel = "y",
             .yRange = AxisRange{-2, 2},
             .legend = Legend::kBottomRight};
  fit.series = {data, polynomial("c: least squares", equationC(A, y)), library,
                polynomial("d: with B = 0.01 Id", equationD(A, y, 0.01 * Eigen::MatrixXd::Identity(10, 10)))};
  plot("fit", fit);
  showOptimisation();
  showBook();
  showBayes();
  showProduct();
  showPropagation();
  showBeta();
  showDirichlet();
}
