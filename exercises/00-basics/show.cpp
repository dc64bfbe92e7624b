#include "show.h"

#include <algorithm>
#include <cmath>

using namespace rex;

namespace {

// f at `count` evenly spaced points from `first` to `last`.
Series curve(const std::string& label, double first, double last, int count,
             const std::function<double(double)>& f) {
  Series series{.label = label};
  for (int i = 0; i < count; ++i) {
    const double x = first + (last - first) * i / (count - 1);
    series.add(x, f(x));
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

// A curved valley, as a sum of squares: f = phi^T phi, with its minimum at (1, 1).
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

double betaDensity(const BetaBelief& belief, double mu) {
  const double logNormaliser =
      std::lgamma(belief.a + belief.b) - std::lgamma(belief.a) - std::lgamma(belief.b);
  return std::exp(logNormaliser + (belief.a - 1) * std::log(mu) + (belief.b - 1) * std::log(1 - mu));
}

// Points mu with mu_1 + mu_2 + mu_3 = 1 fill a triangle, whose corners are the three outcomes.
const double kTop = std::sqrt(0.75);

Eigen::VectorXd inTriangle(const Eigen::VectorXd& mu) {
  return Eigen::Vector2d(mu[1] + 0.5 * mu[2], kTop * mu[2]);
}

}  // namespace

void showFit() {
  Rng rng(1);
  Eigen::MatrixXd A(12, 10);
  Eigen::VectorXd y(12);
  Series data{.label = "data", .style = SeriesStyle::kPoints};
  for (int i = 0; i < 12; ++i) {
    const double x = -1 + i / 5.5;
    for (int k = 0; k < 10; ++k) A(i, k) = std::pow(x, k);
    y[i] = std::sin(3 * x) + 0.2 * rng.normal();
    data.add(x, y[i]);
  }
  Series library = polynomial("c: library", leastSquares(A, y));
  library.dashed = true;
  const Eigen::VectorXd calm = equationD(A, y, 0.01 * Eigen::MatrixXd::Identity(10, 10));
  plot("fit", {.title = "A polynomial of degree 9 through twelve points",
               .xLabel = "x",
               .yLabel = "y",
               .yRange = AxisRange{-2, 2},
               .legend = Legend::kBottomRight,
               .series = {data, polynomial("c: least squares", equationC(A, y)), library,
                          polynomial("d: with B = 0.01 Id", calm)}});
}

void showDescents(const Eigen::Vector2d& start) {
  const std::vector<Eigen::VectorXd> descent = gradientDescent(depth, slope, start, {});
  const std::vector<Eigen::VectorXd> newton = gaussNewton(valley, valleyJacobian, start, {});
  // Zero has no place on a logarithmic axis or colour scale.
  HeatMap map =
      sampledHeatMap([](double x, double y) { return std::max(depth(Eigen::Vector2d(x, y)), 0.01); },
                     {-1.6, 1.6}, {-1, 1.8}, 320, 280);
  map.contours = 12;
  plot("paths",
       {.title = "Two ways down a curved valley",
        .xLabel = "x1",
        .yLabel = "x2",
        .colorLabel = "f(x)",
        .logColor = true,
        .legend = Legend::kBottomLeft,
        .series = {through(descent, {.label = "gradient descent", .style = SeriesStyle::kLinesPoints}),
                   through(newton, {.label = "Gauss-Newton", .style = SeriesStyle::kLinesPoints})},
        .heatMap = map});
  const auto depths = [](const std::string& label, const std::vector<Eigen::VectorXd>& points) {
    Series series{.label = label};
    for (const Eigen::VectorXd& x : points)
      series.add(static_cast<double>(series.x.size() + 1), std::max(depth(x), 1e-16));
    return series;
  };
  plot("convergence", {.title = "How fast f falls",
                       .xLabel = "number of points visited",
                       .yLabel = "f(x)",
                       .logX = true,
                       .logY = true,
                       .series = {depths("gradient descent", descent), depths("Gauss-Newton", newton)}});
}

void showBook(const Eigen::Matrix3d& X_WB, const Eigen::Vector2d& dot_B, const Eigen::Vector2d& point_W) {
  const Eigen::Vector2d dot_W = mapped(X_WB, dot_B);
  Series before{.label = "book before", .dashed = true}, after{.label = "book after"};
  const double width = 1.3, height = 1.7;
  for (const auto& [x, y] : {std::pair(0., 0.), {width, 0.}, {width, height}, {0., height}, {0., 0.}}) {
    const Eigen::Vector2d corner_W = mapped(X_WB, {x, y});
    before.add(x, y);
    after.x.push_back(corner_W.x());
    after.y.push_back(corner_W.y());
  }
  Figure figure{.title = "The book on the table",
                .xLabel = "x of the world [m]",
                .yLabel = "y of the world [m]",
                .equalAxes = true,
                .yRange = AxisRange{-0.2, 2.3},
                .legend = Legend::kOutside};
  figure.series = {before, after,
                   through(dot_W, {.label = "dot p", .style = SeriesStyle::kPoints, .size = 2}),
                   through(point_W, {.label = "point x", .style = SeriesStyle::kPoints, .size = 2})};
  figure.regions = {{.x = after.x, .y = after.y}};
  plot("book", figure);
}

void showProduct() {
  const GaussianBelief prior{Eigen::Vector2d(0, 0), symmetric(4, 1.5, 1)};
  const GaussianBelief measured{Eigen::Vector2d(2, 2), symmetric(0.5, -0.3, 2)};
  Figure figure{.title = "A prior, a measurement, and their product (two standard deviations)",
                .xLabel = "x1",
                .yLabel = "x2",
                .equalAxes = true,
                .legend = Legend::kTopLeft};
  figure.ellipses = {ellipse("prior", prior, kBlue), ellipse("measurement", measured, kGreen),
                     ellipse("product", product(prior, measured), kOrange)};
  plot("product", figure);
}

void showPropagation() {
  const Eigen::VectorXd a = Eigen::Vector2d(2, 0.3);
  const Eigen::MatrixXd F = symmetric(1, 0.15, 1.1), A = symmetric(0.02, 0, 0.005);
  GaussianBelief belief{Eigen::Vector2d(0, 0), symmetric(0.03, 0, 0.03)};
  Rng rng(1);
  std::vector<Eigen::VectorXd> robots;
  for (int i = 0; i < 200; ++i) robots.push_back(std::sqrt(0.03) * rng.normalVector(2));
  Figure figure =
      planeFigure({.title = "Driving blindly: 200 robots, and the belief (two standard deviations)",
                   .legend = Legend::kTopLeft});
  for (int t = 0; t <= 4; ++t) {
    figure.series.push_back(dots(robots, {.label = t == 0 ? "robots" : "", .size = 0.5, .color = kGrey}));
    figure.ellipses.push_back(ellipse(t == 0 ? "belief" : "", belief, kOrange));
    for (Eigen::VectorXd& x : robots) {
      const Eigen::Vector2d noise(std::sqrt(0.02) * rng.normal(), std::sqrt(0.005) * rng.normal());
      x = a + F * x + noise;
    }
    belief = propagated(belief, a, F, A);
  }
  plot("propagation", figure);
}

void showCoin(const BetaBelief& prior, double truth) {
  Rng rng(4);
  Figure figure{.title = "The belief about a coin as the number of throws grows",
                .xLabel = "mu = P(x = 1)",
                .yLabel = "density",
                .legend = Legend::kTopLeft,
                .verticalLines = {{.at = truth, .label = "true"}}};
  BetaBelief belief = prior;
  int thrown = 0;
  for (const int total : {0, 3, 10, 50, 250}) {
    std::vector<int> data;
    for (; thrown < total; ++thrown) data.push_back(rng.uniform() < truth ? 1 : 0);
    belief = betaPosterior(belief, data);
    figure.series.push_back(curve(std::to_string(total) + " throws", 0.001, 0.999, 400,
                                  [&](double mu) { return betaDensity(belief, mu); }));
  }
  plot("beta", figure);
}

void showWheel(const Eigen::Vector3d& truth) {
  Rng rng(4);
  Eigen::VectorXd alpha = Eigen::Vector3d(1, 1, 1);
  std::vector<Eigen::VectorXd> guesses = {inTriangle(nextOutcome(alpha))};
  for (int t = 0; t < 40; ++t) {
    const double u = rng.uniform();
    alpha = dirichletPosterior(alpha, {u < truth[0] ? 1 : u < truth[0] + truth[1] ? 2 : 3});
    guesses.push_back(inTriangle(nextOutcome(alpha)));
  }
  // Divided by its maximum over the triangle, and zero outside.
  const auto density = [&](double x, double y) {
    const double mu3 = y / kTop, mu2 = x - mu3 / 2, mu1 = 1 - mu2 - mu3;
    if (mu1 <= 0 || mu2 <= 0 || mu3 <= 0) return 0.;
    return std::exp((alpha[0] - 1) * std::log(mu1) + (alpha[1] - 1) * std::log(mu2) +
                    (alpha[2] - 1) * std::log(mu3));
  };
  HeatMap map = sampledHeatMap(density, {-0.05, 1.05}, {-0.05, 1.05}, 330, 330);
  map.values /= map.values.maxCoeff();
  const Series triangle{.x = {0, 1, 0.5, 0}, .y = {0, 0, kTop, 0}, .color = kGrey};
  Figure figure{.title = "The belief about a wheel of fortune after 40 turns",
                .xLabel = "from outcome 1 to outcome 2",
                .yLabel = "towards outcome 3",
                .colorLabel = "density / its maximum",
                .equalAxes = true,
                .legend = Legend::kOutside};
  figure.series = {
      triangle, through(guesses, {.label = "mean of mu, turn by turn"}),
      through(inTriangle(truth), {.label = "true mu", .style = SeriesStyle::kPoints, .size = 2})};
  figure.heatMap = map;
  plot("dirichlet", figure);
}
