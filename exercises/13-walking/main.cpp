#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "control/riccati.h"
#include "course/walk_pictures.h"
#include "exercise.h"
#include "locomotion/limit_cycle.h"
#include "swing.h"

using namespace rex;

// Keeps the compiler quiet about what a function below does not use yet.
template <class... Unused>
void notUsedYet(const Unused&...) {}

Eigen::MatrixXd supportCorners(const Eigen::MatrixXd& contacts) {
  // TODO: begin at a contact that is a corner for certain. Which one is next, and when is it the last?
  notUsedYet(contacts);
  return Eigen::MatrixXd::Zero(2, 0);
}

double borderDistance(const Eigen::MatrixXd& corners, const Eigen::Vector2d& point) {
  // TODO: the nearest point of each edge. On which side of all edges is a point inside?
  notUsedYet(corners, point);
  return 0;
}

double staticMargin(const std::vector<MovingMass>& robot, const Eigen::MatrixXd& contacts) {
  // TODO: where is the centre of mass?
  notUsedYet(robot, contacts);
  return 0;
}

std::optional<Eigen::Vector2d> zeroMoment(const std::vector<MovingMass>& robot, double groundHeight,
                                          double g) {
  // TODO: write down both horizontal lines of the sum on 11:10, with r = p - (x, y, groundHeight).
  notUsedYet(robot, groundHeight, g);
  return {};
}

Sway swayed(const Pendulum& pendulum, const Sway& start, const Eigen::Vector2d& p, double t) {
  // TODO: c'' = omega^2 (c - p) has a solution of two exponentials, or of cosh and sinh.
  notUsedYet(pendulum, p, t);
  return start;
}

Eigen::Vector2d capturePoint(const Pendulum& pendulum, const Sway& now) {
  // TODO: for which p does the part that grows vanish?
  notUsedYet(pendulum);
  return now.c;
}

Eigen::Vector3d cartStep(const CartTable& cart, const Eigen::Vector3d& x, double jerk) {
  // TODO: c is a cubic in time while the jerk is held.
  notUsedYet(cart, jerk);
  return x;
}

PreviewLaw previewLaw(const CartTable& cart) {
  // TODO: the state of the Riccati equation is the error and the change of x. See the README.
  return {0, Eigen::RowVector3d::Zero(), Eigen::VectorXd::Zero(cart.ahead)};
}

Eigen::MatrixXd followed(const CartTable& cart, const PreviewLaw& law, const Eigen::VectorXd& reference) {
  // TODO: start at rest; in each step the law gives the change of the jerk.
  notUsedYet(cart, law);
  return Eigen::MatrixXd::Zero(3, reference.size());
}

Eigen::Vector4d impactOf(const Walker& walker, const Eigen::Vector4d& x) {
  // TODO: which two angular momenta does the impulse at the foot that lands not change?
  notUsedYet(walker);
  return x;
}

std::optional<StepEnd> stepFrom(const Walker& walker, const Eigen::Vector4d& x) {
  // TODO: small steps of Runge and Kutta, and the moment of the impact within the last of them.
  notUsedYet(walker, x);
  return {};
}

Eigen::Matrix4d stepDerivative(const Walker& walker, const Eigen::Vector4d& x) {
  // TODO: differences of stepFrom() to both sides.
  notUsedYet(walker, x);
  return Eigen::Matrix4d::Zero();
}

std::optional<Eigen::Vector4d> gaitNear(const Walker& walker, const Eigen::Vector4d& guess) {
  // TODO: Newton's method for step(x) - x = 0.
  notUsedYet(walker, guess);
  return {};
}

Eigen::VectorXd multiplierSizes(const Walker& walker, const Eigen::Vector4d& gait) {
  // TODO: eigenvalues() of which matrix? Their moduli, the greatest first.
  notUsedYet(walker, gait);
  return Eigen::VectorXd::Zero(4);
}

// What follows is given.

namespace {

const Color kBlue{0.0f, 0.45f, 0.7f}, kOrange{0.84f, 0.37f, 0.0f}, kGrey{0.62f, 0.66f, 0.72f},
    kBlack{0, 0, 0}, kYellow{1, 0.85f, 0.3f};

using Points = std::vector<Eigen::Vector2d>;

void nothingYet(const char* what) { std::printf("Nothing to see yet of the %s.\n", what); }

Figure axes(const char* title, const char* xLabel, const char* yLabel, Legend legend = Legend::kAuto) {
  Figure figure;
  figure.title = title;
  figure.xLabel = xLabel;
  figure.yLabel = yLabel;
  figure.legend = legend;
  return figure;
}

// A new curve of a figure, to be filled.
Series& curve(Figure& figure, const char* label, const Color& color, double size = 1) {
  Series& series = figure.series.emplace_back();
  series.label = label;
  series.color = color;
  series.size = size;
  return series;
}

void add(Series& series, double x, double y) {
  series.x.push_back(x);
  series.y.push_back(y);
}

void addAll(Series& series, const Points& points) {
  for (const Eigen::Vector2d& p : points) add(series, p.x(), p.y());
}

// Yours is wide and yellow, and the library's lies dashed upon it.
void compare(Figure& figure) {
  curve(figure, "yours", kYellow, 5);
  curve(figure, "library's", kBlack).dashed = true;
}

// Two soles, one ahead of the other, and how far from the border one is above them.
void showSupport() {
  const double middles[2][2] = {{0, .125}, {.25, -.125}}, signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  Eigen::MatrixXd contacts(2, 8);
  for (int i = 0; i < 8; ++i) {
    contacts(0, i) = middles[i / 4][0] + .125 * signs[i % 4][0];
    contacts(1, i) = middles[i / 4][1] + .0625 * signs[i % 4][1];
  }
  const Eigen::MatrixXd corners = supportCorners(contacts);
  const Eigen::Index k = corners.cols();
  if (k < 3) return nothingYet("support polygon");
  Figure figure = axes("Distance from the border of the support polygon", "x [m]", "y [m]", Legend::kTopLeft);
  figure.colorLabel = "distance [m]";
  figure.equalAxes = true;
  for (const int foot : {0, 4}) {
    Series& sole = curve(figure, foot == 0 ? "soles" : "", kBlack);
    for (int i = 0; i < 5; ++i) add(sole, contacts(0, foot + i % 4), contacts(1, foot + i % 4));
  }
  Series& border = curve(figure, "support polygon", kOrange, 2);
  for (Eigen::Index i = 0; i <= k; ++i) add(border, corners(0, i % k), corners(1, i % k));
  const auto distance = [&](double x, double y) { return borderDistance(corners, {x, y}); };
  figure.heatMap = heatMapOf(distance, {-.3, .55}, {-.35, .35}, 170, 140);
  plot("support", figure);
}

void showCapture() {
  const Pendulum pendulum;
  const Sway now{{0, 0}, {.6, 0}};
  const Eigen::Vector2d capture = capturePoint(pendulum, now);
  Figure figure = axes("Where the foot must go: the pendulum over three places", "time [s]",
                       "centre of mass [m]", Legend::kTopLeft);
  figure.horizontalLines = {{capture.x(), "capture point"}};
  const char* labels[] = {"foot 2 cm behind it", "foot on the capture point", "foot 2 cm ahead of it"};
  const Color colors[] = {kBlue, kBlack, kOrange};
  for (int place = 0; place < 3; ++place) {
    Series& series = curve(figure, labels[place], colors[place]);
    const Eigen::Vector2d foot(capture.x() + .02 * (place - 1), capture.y());
    for (int i = 0; i <= 110; ++i) add(series, .01 * i, swayed(pendulum, now, foot, .01 * i).c.x());
  }
  plot("capture", figure);
}

// A few steps ahead, then around a bend.
WalkPlan walkAround() {
  WalkPlan plan;
  double x = 0, y = 0, yaw = 0;
  for (int i = 0; i < 10; ++i) {
    if (i > 4 && i < 9) yaw += .15;
    if (i > 1 && i < 9) {
      x += .2 * std::cos(yaw);
      y += .2 * std::sin(yaw);
    }
    Footstep& foot = plan.footsteps.emplace_back();
    foot.side = i % 2 == 0 ? Side::kLeft : Side::kRight;
    foot.yaw = yaw;
    const double left = i % 2 == 0 ? .095 : -.095;
    foot.p = {x - left * std::sin(yaw), y + left * std::cos(yaw)};
  }
  return plan;
}

// A walk of the cart in both axes, from above.
struct Walk {
  Points center, zmp;
  double largestError = 0;
};

Walk walkOf(const CartTable& cart, const PreviewLaw& law, const Eigen::MatrixXd& reference) {
  Walk walk;
  const Eigen::MatrixXd x = followed(cart, law, reference.row(0)), y = followed(cart, law, reference.row(1));
  const double rise = cart.height / cart.g;
  for (Eigen::Index k = 0; k < reference.cols(); ++k) {
    walk.center.emplace_back(x(0, k), y(0, k));
    const double px = x(0, k) - rise * x(2, k), py = y(0, k) - rise * y(2, k);
    walk.zmp.emplace_back(px, py);
    walk.largestError = std::max(walk.largestError, std::hypot(px - reference(0, k), py - reference(1, k)));
  }
  return walk;
}

void showGains(const CartTable& cart, const PreviewLaw& law, const Eigen::VectorXd& library) {
  Figure figure = axes("What a step of the zero moment point is worth in advance", "time until the step [s]",
                       "gain Gp [1/s^3]");
  compare(figure);
  for (Eigen::Index j = 0; j < law.Gp.size(); ++j) {
    const double time = cart.step * static_cast<double>(j + 1);
    add(figure.series[0], time, law.Gp[j]);
    add(figure.series[1], time, library[j]);
  }
  plot("gains", figure);
}

void showWalk(const CartTable& cart, const WalkPlan& plan, const Walk& walk, const Eigen::MatrixXd& library) {
  Figure above = footprintFigure(plan);
  above.title = "A walk from above";
  above.legend = Legend::kTopLeft;
  above.width = 1000;
  above.height = 450;
  addAll(curve(above, "centre of mass", kBlue), walk.center);
  addAll(curve(above, "zero moment point", kOrange, 1.5), walk.zmp);
  plot("zmp", above);

  Figure sideways = axes("The same walk over time", "time [s]", "y [m]", Legend::kTopLeft);
  sideways.width = 1000;
  for (const char* label : {"zero moment point", "centre of mass", "library's zero moment point"})
    curve(sideways, label, kBlack);
  sideways.series[0].color = kOrange;
  sideways.series[1].color = kBlue;
  sideways.series[0].size = sideways.series[1].size = 2;
  sideways.series[2].dashed = true;
  for (std::size_t k = 0; k < walk.zmp.size(); ++k) {
    const double time = cart.step * static_cast<double>(k);
    add(sideways.series[0], time, walk.zmp[k].y());
    add(sideways.series[1], time, walk.center[k].y());
    add(sideways.series[2], time, library(1, static_cast<Eigen::Index>(k)));
  }
  plot("zmp_time", sideways);
}

// With less of the preview, the rest of the law as it is.
void showHorizon(const CartTable& cart, const PreviewLaw& law, const Eigen::MatrixXd& reference) {
  Figure figure = axes("How far ahead one must look", "preview [s]",
                       "largest error of the zero moment point [m]", Legend::kNone);
  figure.logY = true;
  Series& series = curve(figure, "", kBlue);
  series.style = SeriesStyle::kLinesPoints;
  PreviewLaw shorter = law;
  for (int n = cart.ahead; n >= 20; --n) {
    if (n % 10 == 0) add(series, cart.step * n, walkOf(cart, shorter, reference).largestError + 1e-9);
    shorter.Gp[n - 1] = 0;
  }
  plot("horizon", figure);
}

// A walk with small steps in time, and the ends of its steps.
struct Way {
  Points leg;  // angle and rate of one leg, which stands in every other step
  CompassWalk film;
  std::vector<Eigen::Vector4d> ends;
};

// The middle of two slopes by Heun is good enough for a picture.
Eigen::Vector4d swungALittle(const Walker& walker, const Eigen::Vector4d& x, double h) {
  const Eigen::Vector4d rate = swingRate(walker, x);
  return x + h / 2 * (rate + swingRate(walker, x + h * rate));
}

Way wayFrom(const Walker& walker, Eigen::Vector4d x, int steps) {
  Way way;
  way.film.walker = {walker.a, walker.b, walker.legMass, walker.hipMass, walker.slope, walker.g};
  way.ends.push_back(x);
  double time = 0, foot = 0;
  for (int i = 0; i < steps; ++i) {
    const auto end = stepFrom(walker, x);
    if (!end) break;
    const int first = i % 2, parts = 200;
    for (int j = 0; j <= parts; ++j) {
      way.leg.emplace_back(x[first], x[first + 2]);
      if (j == parts) break;
      const double h = end->time / parts;
      if (time + h * j >= static_cast<double>(way.film.views.size()) / 30)
        way.film.views.push_back({x, foot, first == 0});
      x = swungALittle(walker, x, h);
    }
    foot += 2 * (walker.a + walker.b) * std::sin((x[1] - x[0]) / 2);
    time += end->time;
    x = end->x;
    way.ends.push_back(x);
  }
  return way;
}

void showGait(const Walker& walker, const Eigen::Vector4d& guess, const Eigen::Vector4d& gait) {
  print("the gait, just after an impact", gait.transpose());
  const Eigen::VectorXd sizes = multiplierSizes(walker, gait);
  print("moduli of its multipliers", sizes.transpose());
  const Way settles = wayFrom(walker, guess, 16), repeats = wayFrom(walker, gait, 3);
  Figure phase =
      axes("One leg of the compass walker, step after step", "angle [rad]", "rate [rad/s]", Legend::kOutside);
  addAll(curve(phase, "from a guess", kGrey), settles.leg);
  addAll(curve(phase, "the gait", kOrange, 2), repeats.leg);
  plot("phase", phase);
  Figure settling =
      axes("A walk that settles", "step", "distance of the states [rad, rad/s]", Legend::kTopRight);
  settling.logY = true;
  curve(settling, "distance from the gait", kBlue).style = SeriesStyle::kLinesPoints;
  curve(settling, "largest multiplier to the power of the steps", kBlack).dashed = true;
  double law = (guess - gait).norm();
  for (std::size_t i = 0; i < settles.ends.size(); ++i, law *= sizes[0] + 1e-9) {
    add(settling.series[0], static_cast<double>(i), (settles.ends[i] - gait).norm() + 1e-12);
    add(settling.series[1], static_cast<double>(i), law + 1e-12);
  }
  plot("settling", settling);
  writeFilm(wayFrom(walker, guess, 6).film, "walker",
            {.view = {.15, -2, .25}, .width = 900, .height = 300, .step = 1. / 30});
}

// The largest multiplier on one slope after the other, each gait being the guess for the next.
using LargestMultiplier = double (*)(const Walker&, const Eigen::Vector4d&);

void showSlopes(const Eigen::Vector4d& gait, LargestMultiplier byLibrary) {
  Figure figure = axes("Where the even gait loses its stability", "slope [degrees]",
                       "largest modulus of the multipliers", Legend::kTopLeft);
  figure.horizontalLines = {{1, "stable below"}};
  compare(figure);
  // Down from 3 degrees to find the gait of the lowest slope, then up.
  std::optional<Eigen::Vector4d> x = gait;
  for (int i = 30, way = -1; x && i <= 50; i += way) {
    if (i == 15) way = 1;
    Walker walker;
    walker.slope = .1 * i * M_PI / 180;
    x = gaitNear(walker, *x);
    if (x && way > 0) {
      add(figure.series[0], .1 * i, multiplierSizes(walker, *x)[0]);
      add(figure.series[1], .1 * i, byLibrary(walker, *x));
    }
  }
  if (!figure.series[0].x.empty()) plot("slopes", figure);
}

}  // namespace

int main() {
  showSupport();
  showCapture();

  // The humanoid's centre of mass is 0.8 m high.
  const CartTable cart{.height = .8, .step = .01, .ahead = 160};
  HumanoidWalk humanoid;
  humanoid.plan = walkAround();
  humanoid.preview = {.height = cart.height, .step = cart.step};
  const PreviewLaw law = previewLaw(cart);
  const Eigen::MatrixXd reference = zmpReference(humanoid.plan, cart.step);
  const Walk walk = walkOf(cart, law, reference);
  showGains(cart, law, previewGains(humanoid.preview).Gp);
  showWalk(cart, humanoid.plan, walk, followZmp(reference, humanoid.preview).zmp);
  showHorizon(cart, law, reference);

  const Walker walker;
  const Eigen::Vector4d guess(.2, -.3, -1, -.3);
  if (const auto gait = gaitNear(walker, guess)) {
    showGait(walker, guess, *gait);
    showSlopes(*gait, [](const Walker& w, const Eigen::Vector4d& x) {
      return std::abs(findLimitCycle({w.a, w.b, w.legMass, w.hipMass, w.slope, w.g}, x).multipliers[0]);
    });
  } else {
    nothingYet("gait of the compass walker");
  }

  // The humanoid's joints move by the library; the ways on the ground are yours.
  humanoid.center = walk.center;
  humanoid.zmp = walk.zmp;
  if (walk.largestError < .05)
    writeFilm(humanoid, "humanoid", {.view = {.35, -1, .8}, .width = 800, .height = 600});
  else
    nothingYet("walk of the humanoid");
}
