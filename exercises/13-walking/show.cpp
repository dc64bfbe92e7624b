#include "show.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "course/walk_pictures.h"
#include "locomotion/limit_cycle.h"
#include "swing.h"

using namespace rex;

namespace {

const Color kBlue{0.0f, 0.45f, 0.7f}, kOrange{0.84f, 0.37f, 0.0f}, kGrey{0.62f, 0.66f, 0.72f},
    kBlack{0, 0, 0}, kYellow{1, 0.85f, 0.3f};

using Points = std::vector<Eigen::Vector2d>;

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

// The border of a polygon with these corners.
Series closed(const Eigen::MatrixXd& corners, const Series& look) {
  return through(corners.leftCols(1), through(corners, look));
}

// Yours is wide and yellow, and the library's lies dashed on top.
void compare(Figure& figure) {
  curve(figure, "yours", kYellow, 5);
  curve(figure, "library's", kBlack).dashed = true;
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
  if (x.isZero() && y.isZero()) return walk;
  const double rise = cart.height / cart.g;
  for (Eigen::Index k = 0; k < reference.cols(); ++k) {
    walk.center.emplace_back(x(0, k), y(0, k));
    const double px = x(0, k) - rise * x(2, k), py = y(0, k) - rise * y(2, k);
    walk.zmp.emplace_back(px, py);
    walk.largestError = std::max(walk.largestError, std::hypot(px - reference(0, k), py - reference(1, k)));
  }
  return walk;
}

// Steps of the compass walker with small time steps, and the ends of its steps.
struct Way {
  Points leg;  // angle and rate of one leg, which stands in every other step
  CompassWalk film;
  std::vector<Eigen::Vector4d> ends;
};

CompassGait libraryWalker(const Walker& w) { return {w.a, w.b, w.legMass, w.hipMass, w.slope, w.g}; }

// Heun's method, the mean of two rates, is good enough for a picture.
Eigen::Vector4d swungALittle(const Walker& walker, const Eigen::Vector4d& x, double h) {
  const Eigen::Vector4d rate = swingRate(walker, x);
  return x + h / 2 * (rate + swingRate(walker, x + h * rate));
}

Way wayFrom(const Walker& walker, Eigen::Vector4d x, int steps) {
  Way way;
  way.film.walker = libraryWalker(walker);
  way.ends.push_back(x);
  double time = 0, foot = 0;
  for (int i = 0; i < steps; ++i) {
    const std::optional<StepEnd> end = stepFrom(walker, x);
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

void showSettling(const Way& way, const Eigen::Vector4d& gait, double largestMultiplier) {
  Figure figure =
      axes("A walk that settles", "step", "distance of the states [rad, rad/s]", Legend::kTopRight);
  figure.logY = true;
  curve(figure, "distance from the gait", kBlue).style = SeriesStyle::kLinesPoints;
  curve(figure, "largest multiplier to the power of the step", kBlack).dashed = true;
  double power = (way.ends[0] - gait).norm();
  for (std::size_t i = 0; i < way.ends.size(); ++i, power *= largestMultiplier + 1e-9) {
    figure.series[0].add(static_cast<double>(i), (way.ends[i] - gait).norm() + 1e-12);
    figure.series[1].add(static_cast<double>(i), power + 1e-12);
  }
  plot("settling", figure);
}

}  // namespace

void showSupport(const Eigen::Vector2d& left, const Eigen::Vector2d& right) {
  const double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  Eigen::MatrixXd contacts(2, 8);
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector2d& middle = i < 4 ? left : right;
    contacts.col(i) = middle + Eigen::Vector2d(.125 * signs[i % 4][0], .0625 * signs[i % 4][1]);
  }
  const Eigen::MatrixXd corners = supportCorners(contacts);
  const Eigen::Index count = corners.cols();
  if (count < 3) return nothingYet("the support polygon");
  Figure figure = planeFigure({.title = "Distance from the border of the support polygon",
                               .colorLabel = "distance [m]",
                               .legend = Legend::kTopLeft});
  figure.series = {closed(contacts.leftCols(4), {.label = "soles", .color = kBlack}),
                   closed(contacts.rightCols(4), {.color = kBlack}),
                   closed(corners, {.label = "support polygon", .size = 2, .color = kOrange})};
  const auto distance = [&](double x, double y) { return borderDistance(corners, {x, y}); };
  figure.heatMap = sampledHeatMap(distance, {-.3, .55}, {-.35, .35}, 170, 140);
  plot("support", figure);

  // Trunk and legs, the trunk a bit to the front and to the left; together they weigh 60 kg.
  const std::vector<MovingMass> robot = {{.mass = 40, .p = {.17, .03, 1}}, {.mass = 20, .p = {.11, 0, .4}}};
  std::printf("static margin %.4f m, by the library %.4f m\n", staticMargin(robot, contacts),
              supportMargin(supportPolygon(contacts), {.15, .02}).margin);
}

void showTipping() {
  Figure figure = axes("How hard may a body accelerate before it tips?", "acceleration of the trunk [m/s^2]",
                       "zero moment point [m]", Legend::kTopRight);
  figure.horizontalLines = {{.125, "toe"}, {-.125, "heel"}};
  Series& series = curve(figure, "", kOrange, 2);
  for (double a = -3; a < 3.01; a += .25) {
    const std::vector<MovingMass> body = {{40, {0, 0, 1}, {a, 0, 0}}, {20, {0, 0, .4}, {a / 2, 0, 0}}};
    if (const auto point = zeroMoment(body, 0, 9.81)) series.add(a, point->x());
  }
  if (series.x.empty()) return nothingYet("the zero moment point");
  plot("tipping", figure);
}

void showCapture(const Pendulum& pendulum, const Sway& now) {
  const Eigen::Vector2d capture = capturePoint(pendulum, now);
  if (swayed(pendulum, now, capture, 1).c == now.c) return nothingYet("the pendulum");
  Figure figure = axes("Where the foot must go: the pendulum over three points", "time [s]",
                       "centre of mass [m]", Legend::kTopLeft);
  figure.horizontalLines = {{capture.x(), "capture point"}};
  const char* labels[] = {"foot 2 cm behind it", "foot on the capture point", "foot 2 cm ahead of it"};
  const Color colors[] = {kBlue, kBlack, kOrange};
  for (int place = 0; place < 3; ++place) {
    Series& series = curve(figure, labels[place], colors[place]);
    const Eigen::Vector2d foot(capture.x() + .02 * (place - 1), capture.y());
    for (int i = 0; i <= 110; ++i) series.add(.01 * i, swayed(pendulum, now, foot, .01 * i).c.x());
  }
  plot("capture", figure);
}

void showGains(const CartTable& cart, const PreviewLaw& law) {
  if (law.Gi == 0) return nothingYet("the preview gains");
  const Eigen::VectorXd library = previewGains({.height = cart.height, .step = cart.step}).Gp;
  Figure figure = axes("Gain on a jump of the reference, by the time until it", "time until the jump [s]",
                       "gain Gp [1/s^3]");
  compare(figure);
  for (Eigen::Index j = 0; j < law.Gp.size(); ++j) {
    const double time = cart.step * static_cast<double>(j + 1);
    figure.series[0].add(time, law.Gp[j]);
    figure.series[1].add(time, library[j]);
  }
  plot("gains", figure);
}

void showWalk(const CartTable& cart, const PreviewLaw& law) {
  HumanoidWalk humanoid;
  humanoid.plan = walkAround();
  humanoid.preview = {.height = cart.height, .step = cart.step};
  const Eigen::MatrixXd reference = zmpReference(humanoid.plan, cart.step);
  const Walk walk = walkOf(cart, law, reference);
  if (walk.zmp.empty()) return nothingYet("the walk");

  Figure above = footprintFigure(humanoid.plan);
  above.title = "A walk from above";
  above.legend = Legend::kTopLeft;
  above.width = 1000;
  above.height = 450;
  above.series = {through(walk.center, {.label = "centre of mass", .color = kBlue}),
                  through(walk.zmp, {.label = "zero moment point", .size = 1.5, .color = kOrange})};
  plot("zmp", above);

  const Eigen::MatrixXd library = followZmp(reference, humanoid.preview).zmp;
  Figure sideways = axes("The same walk over time", "time [s]", "y [m]", Legend::kTopLeft);
  sideways.width = 1000;
  curve(sideways, "zero moment point", kOrange, 2);
  curve(sideways, "centre of mass", kBlue, 2);
  curve(sideways, "library's zero moment point", kBlack).dashed = true;
  for (std::size_t k = 0; k < walk.zmp.size(); ++k) {
    const double time = cart.step * static_cast<double>(k);
    sideways.series[0].add(time, walk.zmp[k].y());
    sideways.series[1].add(time, walk.center[k].y());
    sideways.series[2].add(time, library(1, static_cast<Eigen::Index>(k)));
  }
  plot("zmp_time", sideways);

  // The humanoid's joints move by the library; the paths on the ground are yours.
  if (walk.largestError > .05)
    return nothingYet("the humanoid: the zero moment point is off by more than 5 cm");
  humanoid.center = walk.center;
  humanoid.zmp = walk.zmp;
  writeFilm(humanoidFilm(humanoid), "humanoid", {.view = {.35, -1, .8}, .width = 800, .height = 600});
}

void showHorizon(const CartTable& cart, const PreviewLaw& law) {
  const Eigen::MatrixXd reference = zmpReference(walkAround(), cart.step);
  Figure figure = axes("How far ahead one must look", "preview [s]",
                       "largest error of the zero moment point [m]", Legend::kNone);
  figure.logY = true;
  Series& series = curve(figure, "", kBlue);
  series.style = SeriesStyle::kLinesPoints;
  PreviewLaw shorter = law;  // the rest of the law stays as it is
  for (int n = cart.ahead; n >= 20; --n) {
    if (n % 10 == 0) {
      const Walk walk = walkOf(cart, shorter, reference);
      if (walk.zmp.empty()) return;
      series.add(cart.step * n, walk.largestError + 1e-9);
    }
    shorter.Gp[n - 1] = 0;
  }
  plot("horizon", figure);
}

void showCompass(const Walker& walker, const Eigen::Vector4d& guess) {
  const Way settles = wayFrom(walker, guess, 16);
  if (settles.leg.empty()) return nothingYet("the compass walker");
  Figure phase =
      axes("One leg of the compass walker, step after step", "angle [rad]", "rate [rad/s]", Legend::kOutside);
  phase.series = {through(settles.leg, {.label = "from a guess", .color = kGrey})};
  if (const auto gait = gaitNear(walker, guess)) {
    print("the gait, just after an impact", gait->transpose());
    const Eigen::VectorXd sizes = multiplierSizes(walker, *gait);
    print("moduli of its multipliers", sizes.transpose());
    phase.series.push_back(
        through(wayFrom(walker, *gait, 3).leg, {.label = "the gait", .size = 2, .color = kOrange}));
    showSettling(settles, *gait, sizes[0]);
  }
  plot("phase", phase);
  writeFilm(compassFilm(wayFrom(walker, guess, 6).film, 1. / 30), "walker",
            {.view = {.15, -2, .25}, .width = 900, .height = 300});
}

void showSlopes(const Eigen::Vector4d& guess) {
  Figure figure = axes("Where the symmetric gait loses its stability", "slope [degrees]",
                       "largest modulus of the multipliers", Legend::kTopLeft);
  figure.horizontalLines = {{1, "stable below"}};
  compare(figure);
  // Down from 3 degrees to find the gait of the lowest slope, then up: each gait is the guess for the next.
  std::optional<Eigen::Vector4d> x = guess;
  for (int i = 30, way = -1; x && i <= 50; i += way) {
    if (i == 15) way = 1;
    Walker walker;
    walker.slope = .1 * i * M_PI / 180;
    x = gaitNear(walker, *x);
    if (!x || way < 0) continue;
    figure.series[0].add(.1 * i, multiplierSizes(walker, *x)[0]);
    figure.series[1].add(.1 * i, std::abs(findLimitCycle(libraryWalker(walker), *x).multipliers[0]));
  }
  if (figure.series[0].x.empty()) return nothingYet("the slopes");
  plot("slopes", figure);
}
