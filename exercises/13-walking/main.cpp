#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

#include "control/riccati.h"
#include "exercise.h"
#include "locomotion/limit_cycle.h"
#include "locomotion/preview_control.h"
#include "locomotion/walking_pattern.h"
#include "swing.h"
#include "walk_pictures.h"

using namespace rex;

// Keeps the compiler quiet about what a function below does not use yet.
template <class... Unused>
void notUsedYet(const Unused&...) {}

Eigen::MatrixXd supportCorners(const Eigen::MatrixXd& contacts) {
  // TODO: sort the points by x, then walk along the lower border, and back along the upper one.
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

void nothingYet(const char* what) { std::printf("Nothing to see yet of the %s.\n", what); }

// Two soles, one ahead of the other, and how far from the border one is above them.
void showSupport() {
  const Sole sole{.25, .125};
  const Points left = soleOf({Side::kLeft, {0, .125}, 0}, sole),
               right = soleOf({Side::kRight, {.25, -.125}, 0}, sole);
  Eigen::MatrixXd contacts(2, 8);
  for (int i = 0; i < 8; ++i) contacts.col(i) = i < 4 ? left[i] : right[i - 4];
  const Eigen::MatrixXd corners = supportCorners(contacts);
  if (corners.cols() < 3) return nothingYet("support polygon");
  Points border;
  for (Eigen::Index i = 0; i < corners.cols(); ++i) border.emplace_back(corners.col(i));
  const auto distance = [&](double x, double y) { return borderDistance(corners, {x, y}); };
  Figure figure{.title = "Distance from the border of the support polygon",
                .xLabel = "x [m]",
                .yLabel = "y [m]",
                .colorLabel = "distance [m]",
                .equalAxes = true,
                .legend = Legend::kTopLeft,
                .series = {outlineOf("soles", left, kBlack), outlineOf("", right, kBlack),
                           outlineOf("support polygon", border, kOrange, 2)}};
  figure.heatMap = heatMapOf(distance, {-.3, .55}, {-.35, .35}, 170, 140);
  plot("support", figure);
}

void showCapture() {
  const Pendulum pendulum;
  const Sway now{{0, 0}, {.6, 0}};
  const Eigen::Vector2d capture = capturePoint(pendulum, now);
  Figure figure{.title = "Where the foot must go: the pendulum over three places",
                .xLabel = "time [s]",
                .yLabel = "centre of mass [m]",
                .legend = Legend::kTopLeft,
                .horizontalLines = {{capture.x(), "capture point"}}};
  const std::pair<double, const char*> places[] = {
      {-.02, "foot 2 cm behind it"}, {0, "foot on the capture point"}, {.02, "foot 2 cm ahead of it"}};
  for (const auto& [offset, label] : places) {
    Series series{.label = label};
    for (int i = 0; i <= 110; ++i) {
      series.x.push_back(.01 * i);
      series.y.push_back(swayed(pendulum, now, capture + Eigen::Vector2d(offset, 0), .01 * i).c.x());
    }
    figure.series.push_back(series);
  }
  plot("capture", figure);
}

// A walk of the cart in both axes, from above, beside what was wanted.
struct Walk {
  Points center, zmp, wanted;
  double largestError = 0;
};

Walk walkOf(const CartTable& cart, const PreviewLaw& law, const Eigen::MatrixXd& reference) {
  Walk walk;
  const Eigen::VectorXd rx = reference.row(0), ry = reference.row(1);
  const Eigen::MatrixXd x = followed(cart, law, rx), y = followed(cart, law, ry);
  for (Eigen::Index k = 0; k < rx.size(); ++k) {
    const double rise = cart.height / cart.g;
    walk.center.emplace_back(x(0, k), y(0, k));
    walk.zmp.emplace_back(x(0, k) - rise * x(2, k), y(0, k) - rise * y(2, k));
    walk.wanted.emplace_back(rx[k], ry[k]);
    walk.largestError = std::max(walk.largestError, (walk.zmp.back() - walk.wanted.back()).norm());
  }
  return walk;
}

void showGains(const CartTable& cart, const PreviewLaw& law, const Eigen::VectorXd& library) {
  Figure figure{.title = "What a step of the zero moment point is worth in advance",
                .xLabel = "time until the step [s]",
                .yLabel = "gain Gp"};
  Series yours{.label = "yours", .size = 5, .color = Color{1, .85f, .3f}},
      theirs{.label = "library's", .y = {library.begin(), library.end()}, .dashed = true, .color = kBlack};
  for (Eigen::Index j = 0; j < law.Gp.size(); ++j) {
    yours.x.push_back(cart.step * static_cast<double>(j + 1));
    yours.y.push_back(law.Gp[j]);
  }
  theirs.x = yours.x;
  figure.series = {yours, theirs};
  plot("gains", figure);
}

// y of some points over time.
Series sideways(const std::string& label, const Points& points, double step, const Color& color,
                double size = 1) {
  Series series = wayOf(label, points, color, size);
  for (std::size_t k = 0; k < points.size(); ++k) series.x[k] = step * static_cast<double>(k);
  return series;
}

void showWalk(const CartTable& cart, const WalkPlan& plan, const Walk& walk, const Points& library) {
  Figure above = footprints("A walk from above", plan);
  above.series = {wayOf("centre of mass", walk.center, kBlue),
                  wayOf("zero moment point", walk.zmp, kOrange, 1.5)};
  plot("zmp", above);
  Series theirs = sideways("library's zero moment point", library, cart.step, kBlack);
  theirs.dashed = true;
  plot("zmp_time", {.title = "The same walk, y over time",
                    .xLabel = "time [s]",
                    .yLabel = "y [m]",
                    .legend = Legend::kTopLeft,
                    .series = {sideways("wanted zero moment point", walk.wanted, cart.step, kSoft, 5),
                               sideways("zero moment point", walk.zmp, cart.step, kOrange, 2),
                               sideways("centre of mass", walk.center, cart.step, kBlue, 2), theirs},
                    .width = 1000});
}

// With less of the preview, the rest of the law as it is.
void showHorizon(const CartTable& cart, const PreviewLaw& law, const Eigen::MatrixXd& reference) {
  Series series{.label = "", .style = SeriesStyle::kLinesPoints};
  for (int n = 20; n <= cart.ahead; n += 10) {
    PreviewLaw shorter = law;
    shorter.Gp = law.Gp.head(n);
    series.x.push_back(cart.step * n);
    series.y.push_back(walkOf(cart, shorter, reference).largestError + 1e-9);
  }
  plot("horizon", {.title = "How far ahead one must look",
                   .xLabel = "preview [s]",
                   .yLabel = "largest error of the zero moment point [m]",
                   .logY = true,
                   .legend = Legend::kNone,
                   .series = {series}});
}

// The states of a walk with small steps in time, and the ends of its steps.
struct Way {
  Points leg;  // angle and rate of one leg, which stands in every other step
  WalkerMotion motion;
  std::vector<Eigen::Vector4d> ends;
};

Way wayFrom(const Walker& walker, Eigen::Vector4d x, int steps) {
  Way way{{}, {}, {x}};
  double time = 0, foot = 0;
  for (int i = 0; i < steps; ++i) {
    const auto end = stepFrom(walker, x);
    if (!end) break;
    const auto drawn = [&] {
      way.leg.push_back(i % 2 == 0 ? Eigen::Vector2d(x[0], x[2]) : Eigen::Vector2d(x[1], x[3]));
    };
    const int parts = 200;
    for (int j = 0; j < parts; ++j) {
      const double h = end->time / parts;
      drawn();
      if (time + h * j >= static_cast<double>(way.motion.states.size()) / 30) {
        way.motion.states.push_back(x);
        way.motion.feet.push_back(foot);
        way.motion.leftStands.push_back(i % 2 == 0);
      }
      // Heun's method is good enough for a picture.
      const Eigen::Vector4d rate = swingRate(walker, x);
      x += h / 2 * (rate + swingRate(walker, x + h * rate));
    }
    drawn();
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
  plot("phase",
       {.title = "One leg of the compass walker, step after step",
        .xLabel = "angle [rad]",
        .yLabel = "rate [rad/s]",
        .legend = Legend::kOutside,
        .series = {wayOf("from a guess", settles.leg, kSoft), wayOf("the gait", repeats.leg, kOrange, 2)}});
  Series distance{.label = "distance from the gait", .style = SeriesStyle::kLinesPoints, .color = kBlue},
      law{.label = "largest multiplier to the power of the steps", .dashed = true, .color = kBlack};
  for (std::size_t i = 0; i < settles.ends.size(); ++i) {
    distance.y.push_back((settles.ends[i] - gait).norm() + 1e-12);
    law.y.push_back(distance.y[0] * std::pow(sizes[0] + 1e-9, i));
  }
  plot("settling", {.title = "A walk that settles",
                    .xLabel = "steps",
                    .yLabel = "distance of the states",
                    .logY = true,
                    .legend = Legend::kTopRight,
                    .series = {distance, law}});
  filmWalker(walker, wayFrom(walker, guess, 6).motion, "walker");
}

// The largest multiplier on one slope after the other, each gait being the guess for the next.
template <class Library>
void showSlopes(const Eigen::Vector4d& gait, const Library& byLibrary) {
  Series yours{.label = "yours", .size = 5, .color = Color{1, .85f, .3f}},
      theirs{.label = "library's", .dashed = true, .color = kBlack};
  for (const double way : {-1., 1.}) {
    std::optional<Eigen::Vector4d> x = gait;
    for (double degrees = way < 0 ? 3 : 3.1; x && degrees > 1.45 && degrees < 5.05; degrees += .1 * way) {
      Walker walker;
      walker.slope = degrees * M_PI / 180;
      x = gaitNear(walker, *x);
      if (!x) break;
      const bool first = way < 0;
      for (Series* series : {&yours, &theirs}) {
        const double size = series == &yours ? multiplierSizes(walker, *x)[0] : byLibrary(walker, *x);
        series->x.insert(first ? series->x.begin() : series->x.end(), degrees);
        series->y.insert(first ? series->y.begin() : series->y.end(), size);
      }
    }
  }
  if (yours.x.empty()) return;
  plot("slopes", {.title = "Where the even gait loses its stability",
                  .xLabel = "slope [degrees]",
                  .yLabel = "largest modulus of the multipliers",
                  .legend = Legend::kTopLeft,
                  .series = {yours, theirs},
                  .horizontalLines = {{1, "stable below"}}});
}

}  // namespace

int main() {
  showSupport();
  showCapture();

  // The humanoid's centre of mass is 0.8 m high.
  const CartTable cart{.height = .8, .step = .01, .ahead = 160};
  const PreviewOptions same{.height = cart.height, .step = cart.step};
  const PreviewLaw law = previewLaw(cart);
  const WalkPlan plan = walkAround();
  const Eigen::MatrixXd reference = zmpReference(plan, cart.step);
  const Walk walk = walkOf(cart, law, reference);
  showGains(cart, law, previewGains(same).Gp);
  const PreviewMotion motion = followZmp(reference, same);
  Points library;
  for (Eigen::Index k = 0; k < motion.zmp.cols(); ++k) library.emplace_back(motion.zmp.col(k));
  showWalk(cart, plan, walk, library);
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

  // The humanoid walks by the library; the ways on the ground are yours.
  if (walk.largestError > .05) {
    nothingYet("walk of the humanoid");
    return 0;
  }
  const WalkingHumanoid humanoid;
  const Legs legs{humanoid.model.body("left_foot"),
                  humanoid.model.body("right_foot"),
                  humanoid.model.body("pelvis"),
                  {.03, 0, -.075}};
  const WalkingPattern pattern =
      walkingPattern(humanoid.model, legs, plan, humanoid.start, {.preview = same});
  filmHumanoid(humanoid, pattern.Q, cart.step, plan, walk.center, walk.zmp, "humanoid");
}
