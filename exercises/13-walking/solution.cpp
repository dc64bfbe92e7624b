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
  // <solution supportCorners>
  // Like a string around the points: from corner to corner, always turning as little as possible.
  const Eigen::Index n = contacts.cols();
  Eigen::Index first = 0;
  for (Eigen::Index i = 1; i < n; ++i)
    if (contacts(0, i) < contacts(0, first) ||
        (contacts(0, i) == contacts(0, first) && contacts(1, i) < contacts(1, first)))
      first = i;
  std::vector<Eigen::Index> chosen;
  for (Eigen::Index at = first, next = first; n > 0 && (chosen.empty() || next != first); at = next) {
    chosen.push_back(at);
    next = first;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double wayX = contacts(0, next) - contacts(0, at), wayY = contacts(1, next) - contacts(1, at);
      const double toX = contacts(0, i) - contacts(0, at), toY = contacts(1, i) - contacts(1, at);
      const double turn = wayX * toY - wayY * toX;
      // Of several in one direction the farthest, so that none between two others is a corner.
      if (turn < 0 || (turn == 0 && std::hypot(toX, toY) > std::hypot(wayX, wayY))) next = i;
    }
  }
  Eigen::MatrixXd result(2, chosen.size());
  for (Eigen::Index i = 0; i < result.cols(); ++i)
    result.col(i) = contacts.col(chosen[static_cast<std::size_t>(i)]);
  return result;
  // <todo>
  //| // TODO: begin at a contact that is a corner for certain. Which one is next, and when is it the last?
  //| notUsedYet(contacts);
  //| return Eigen::MatrixXd::Zero(2, 0);
  // </solution>
}

double borderDistance(const Eigen::MatrixXd& corners, const Eigen::Vector2d& point) {
  // <solution borderDistance>
  const Eigen::Index k = corners.cols();
  bool isInside = k > 2;
  double least = INFINITY;
  for (Eigen::Index i = 0; i < k; ++i) {
    const Eigen::Index next = (i + 1) % k;
    const double edgeX = corners(0, next) - corners(0, i), edgeY = corners(1, next) - corners(1, i);
    const double toX = point.x() - corners(0, i), toY = point.y() - corners(1, i);
    // The nearest point lies so far along the edge, 0 to 1.
    const double length2 = edgeX * edgeX + edgeY * edgeY;
    const double share = k > 1 ? std::clamp((toX * edgeX + toY * edgeY) / length2, 0., 1.) : 0;
    least = std::min(least, std::hypot(toX - share * edgeX, toY - share * edgeY));
    isInside = isInside && edgeX * toY - edgeY * toX > 0;
  }
  return isInside ? least : -least;
  // <todo>
  //| // TODO: the nearest point of each edge. On which side of all edges is a point inside?
  //| notUsedYet(corners, point);
  //| return 0;
  // </solution>
}

double staticMargin(const std::vector<MovingMass>& robot, const Eigen::MatrixXd& contacts) {
  // <solution staticMargin>
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  double mass = 0;
  for (const MovingMass& part : robot) {
    moment += part.mass * part.p.head<2>();
    mass += part.mass;
  }
  return borderDistance(supportCorners(contacts), moment / mass);
  // <todo>
  //| // TODO: where is the centre of mass?
  //| notUsedYet(robot, contacts);
  //| return 0;
  // </solution>
}

std::optional<Eigen::Vector2d> zeroMoment(const std::vector<MovingMass>& robot, double groundHeight,
                                          double g) {
  // <solution zeroMoment>
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double push = 0;
  for (const MovingMass& part : robot) {
    const Eigen::Vector3d force = part.mass * (part.a + Eigen::Vector3d(0, 0, g));
    push += force.z();
    sum += force.z() * part.p.head<2>() - (part.p.z() - groundHeight) * force.head<2>();
  }
  if (push <= 0) return std::nullopt;
  return Eigen::Vector2d(sum / push);
  // <todo>
  //| // TODO: write down both horizontal lines of the sum on 11:10, with r = p - (x, y, groundHeight).
  //| notUsedYet(robot, groundHeight, g);
  //| return {};
  // </solution>
}

Sway swayed(const Pendulum& pendulum, const Sway& start, const Eigen::Vector2d& p, double t) {
  // <solution swayed>
  const double omega = std::sqrt(pendulum.g / pendulum.height);
  Sway later;
  for (int i = 0; i < 2; ++i) {
    // What grows and what decays, by themselves: a difference of cosh and sinh would lose the latter.
    const double grows = (start.c[i] - p[i] + start.v[i] / omega) / 2 * std::exp(omega * t);
    const double decays = (start.c[i] - p[i] - start.v[i] / omega) / 2 * std::exp(-omega * t);
    later.c[i] = p[i] + grows + decays;
    later.v[i] = omega * (grows - decays);
  }
  return later;
  // <todo>
  //| // TODO: c'' = omega^2 (c - p) has a solution of two exponentials, or of cosh and sinh.
  //| notUsedYet(pendulum, p, t);
  //| return start;
  // </solution>
}

Eigen::Vector2d capturePoint(const Pendulum& pendulum, const Sway& now) {
  // <solution capturePoint>
  return now.c + now.v * std::sqrt(pendulum.height / pendulum.g);
  // <todo>
  //| // TODO: for which p does the part that grows vanish?
  //| notUsedYet(pendulum);
  //| return now.c;
  // </solution>
}

Eigen::Vector3d cartStep(const CartTable& cart, const Eigen::Vector3d& x, double jerk) {
  // <solution cartStep>
  const double h = cart.step;
  return {x[0] + h * x[1] + h * h / 2 * x[2] + h * h * h / 6 * jerk, x[1] + h * x[2] + h * h / 2 * jerk,
          x[2] + h * jerk};
  // <todo>
  //| // TODO: c is a cubic in time while the jerk is held.
  //| notUsedYet(cart, jerk);
  //| return x;
  // </solution>
}

PreviewLaw previewLaw(const CartTable& cart) {
  // <solution previewLaw>
  // The state is the error p - r and the change of x in the last step, driven by the change of the jerk.
  const auto column = [&](const Eigen::Vector3d& x, double jerk) {
    const Eigen::Vector3d next = cartStep(cart, x, jerk);
    return Eigen::Vector4d(next[0] - cart.height / cart.g * next[2], next[0], next[1], next[2]);
  };
  Eigen::Matrix4d F = Eigen::Matrix4d::Zero(), Q = F;
  F(0, 0) = 1;
  for (int i = 0; i < 3; ++i) F.col(i + 1) = column(Eigen::Vector3d::Unit(i), 0);
  const Eigen::Vector4d G = column(Eigen::Vector3d::Zero(), 1);
  Q(0, 0) = cart.Qe;
  const RiccatiResult riccati = solveDare(F, G, Q, Eigen::MatrixXd::Constant(1, 1, cart.R));
  PreviewLaw law{riccati.K(0, 0), {riccati.K(0, 1), riccati.K(0, 2), riccati.K(0, 3)}, {}};
  law.Gp.resize(cart.ahead);
  double price = cart.R;  // of a change of the jerk, now and in all steps to come
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) price += G[i] * riccati.X(i, j) * G[j];
  // A change of the reference in j steps is a change of the error then; what it costs, carried back to now.
  Eigen::Vector4d cost = riccati.X.col(0);
  for (double& gain : law.Gp) {
    const double push = G.dot(cost);
    gain = push / price;
    Eigen::Vector4d before;
    for (int i = 0; i < 4; ++i) before[i] = F.col(i).dot(cost) - riccati.K(0, i) * push;
    cost = before;
  }
  return law;
  // <todo>
  //| // TODO: the state of the Riccati equation is the error and the change of x. See the README.
  //| return {0, Eigen::RowVector3d::Zero(), Eigen::VectorXd::Zero(cart.ahead)};
  // </solution>
}

Eigen::MatrixXd followed(const CartTable& cart, const PreviewLaw& law, const Eigen::VectorXd& reference) {
  // <solution followed>
  const Eigen::Index n = reference.size();
  Eigen::MatrixXd states(3, n);
  Eigen::Vector3d x(reference[0], 0, 0), change = Eigen::Vector3d::Zero();
  double jerk = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    states.col(k) = x;
    const double p = x[0] - cart.height / cart.g * x[2];
    jerk -= law.Gi * (p - reference[k]) + law.Gx.dot(change);
    for (Eigen::Index j = 1; j <= law.Gp.size() && k + j < n; ++j)
      jerk += law.Gp[j - 1] * (reference[k + j] - reference[k + j - 1]);
    change = cartStep(cart, x, jerk) - x;
    x += change;
  }
  return states;
  // <todo>
  //| // TODO: start at rest; in each step the law gives the change of the jerk.
  //| notUsedYet(cart, law);
  //| return Eigen::MatrixXd::Zero(3, reference.size());
  // </solution>
}

Eigen::Vector4d impactOf(const Walker& walker, const Eigen::Vector4d& x) {
  // <solution impactOf>
  const double l = walker.a + walker.b, m = walker.legMass, c = std::cos(x[0] - x[1]);
  const double a = walker.a, b = walker.b;
  // Angular momenta before the impact: of all about the foot that lands, of the leg behind about the hip.
  const double all = ((walker.hipMass * l * l + 2 * m * a * l) * c - m * a * b) * x[2] - m * a * b * x[3];
  const double behind = -m * a * b * x[2];
  // What multiplies the rates of the new stance and swing leg in both after it.
  const double all1 = (walker.hipMass + m) * l * l + m * a * a - m * l * b * c, all2 = m * b * (b - l * c);
  const double behind1 = -m * l * b * c, behind2 = m * b * b;
  const double determinant = all1 * behind2 - all2 * behind1;
  return {x[1], x[0], (behind2 * all - all2 * behind) / determinant,
          (all1 * behind - behind1 * all) / determinant};
  // <todo>
  //| // TODO: which two angular momenta does the impulse at the foot that lands not change?
  //| notUsedYet(walker);
  //| return x;
  // </solution>
}

// <solution swings>
// One step of Runge and Kutta.
Eigen::Vector4d swung(const Walker& walker, const Eigen::Vector4d& x, double h) {
  const Eigen::Vector4d k1 = swingRate(walker, x), k2 = swingRate(walker, x + h / 2 * k1);
  const Eigen::Vector4d k3 = swingRate(walker, x + h / 2 * k2), k4 = swingRate(walker, x + h * k3);
  return x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}
// <todo>
// </solution>

std::optional<StepEnd> stepFrom(const Walker& walker, const Eigen::Vector4d& x) {
  // <solution stepFrom>
  const auto lands = [&](const Eigen::Vector4d& at) { return at[0] + at[1] + 2 * walker.slope <= 0; };
  constexpr double h = 1e-3;
  Eigen::Vector4d now = x;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector4d next = swung(walker, now, h);
    if (!lands(now) && lands(next) && next[1] > next[0]) {
      double low = 0, high = h;
      for (int j = 0; j < 60; ++j)
        (lands(swung(walker, now, (low + high) / 2)) ? high : low) = (low + high) / 2;
      return StepEnd{impactOf(walker, swung(walker, now, high)), i * h + high};
    }
    if (std::abs(next[0] + walker.slope) >= M_PI / 2) return std::nullopt;
    now = next;
  }
  return std::nullopt;
  // <todo>
  //| // TODO: small steps of Runge and Kutta, and the moment of the impact within the last of them.
  //| notUsedYet(walker, x);
  //| return {};
  // </solution>
}

Eigen::Matrix4d stepDerivative(const Walker& walker, const Eigen::Vector4d& x) {
  // <solution stepDerivative>
  constexpr double d = 1e-5;
  Eigen::Matrix4d J;
  for (int i = 0; i < 4; ++i) {
    const auto high = stepFrom(walker, x + d * Eigen::Vector4d::Unit(i));
    const auto low = stepFrom(walker, x - d * Eigen::Vector4d::Unit(i));
    if (!high || !low) return Eigen::Matrix4d::Constant(NAN);
    J.col(i) = (high->x - low->x) / (2 * d);
  }
  return J;
  // <todo>
  //| // TODO: differences of stepFrom() to both sides.
  //| notUsedYet(walker, x);
  //| return Eigen::Matrix4d::Zero();
  // </solution>
}

std::optional<Eigen::Vector4d> gaitNear(const Walker& walker, const Eigen::Vector4d& guess) {
  // <solution gaitNear>
  Eigen::Vector4d x = guess;
  for (int i = 0; i < 20; ++i) {
    const auto end = stepFrom(walker, x);
    if (!end) return std::nullopt;
    if ((end->x - x).norm() < 1e-9) break;
    const Eigen::Matrix4d J = stepDerivative(walker, x);
    if (!J.allFinite()) return std::nullopt;
    x += solve(Eigen::Matrix4d::Identity() - J, Eigen::Vector4d(end->x - x));
  }
  return x;
  // <todo>
  //| // TODO: Newton's method for step(x) - x = 0.
  //| notUsedYet(walker, guess);
  //| return {};
  // </solution>
}

Eigen::VectorXd multiplierSizes(const Walker& walker, const Eigen::Vector4d& gait) {
  // <solution multiplierSizes>
  Eigen::VectorXd sizes = eigenvalues(stepDerivative(walker, gait)).cwiseAbs();
  std::sort(sizes.begin(), sizes.end(), std::greater<>());
  return sizes;
  // <todo>
  //| // TODO: eigenvalues() of which matrix? Their moduli, the greatest first.
  //| notUsedYet(walker, gait);
  //| return Eigen::VectorXd::Zero(4);
  // </solution>
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
