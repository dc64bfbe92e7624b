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
  // <solution supportCorners>
  std::vector<Eigen::Vector2d> points;
  for (Eigen::Index i = 0; i < contacts.cols(); ++i) points.emplace_back(contacts.col(i));
  const auto before = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  // From the left to the right along the lower border, and back along the upper one.
  std::vector<Eigen::Vector2d> corners;
  for (int pass = 0; pass < 2 && points.size() > 1; ++pass) {
    const std::size_t first = corners.size();
    for (const Eigen::Vector2d& p : points) {
      while (corners.size() >= first + 2) {
        const Eigen::Vector2d along = corners.back() - corners[corners.size() - 2], on = p - corners.back();
        if (along.x() * on.y() - along.y() * on.x() > 0) break;
        corners.pop_back();
      }
      corners.push_back(p);
    }
    corners.pop_back();
    std::reverse(points.begin(), points.end());
  }
  if (points.size() == 1) corners = points;
  Eigen::MatrixXd result(2, corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = corners[i];
  return result;
  // <todo>
  //| // TODO: sort the points by x, then walk along the lower border, and back along the upper one.
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
    const Eigen::Vector2d start = corners.col(i), edge = corners.col((i + 1) % k) - start, to = point - start;
    const double share = k > 1 ? std::clamp(to.dot(edge) / edge.squaredNorm(), 0., 1.) : 0;
    least = std::min(least, (to - share * edge).norm());
    isInside = isInside && edge.x() * to.y() - edge.y() * to.x() > 0;
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
  // What grows and what decays, by themselves: a difference of cosh and sinh would lose the latter.
  const Eigen::Vector2d grows = (start.c - p + start.v / omega) / 2 * std::exp(omega * t);
  const Eigen::Vector2d decays = (start.c - p - start.v / omega) / 2 * std::exp(-omega * t);
  return {p + grows + decays, omega * (grows - decays)};
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
  const Eigen::RowVector3d C(1, 0, -cart.height / cart.g);
  Eigen::Matrix3d A;
  for (int i = 0; i < 3; ++i) A.col(i) = cartStep(cart, Eigen::Vector3d::Unit(i), 0);
  const Eigen::Vector3d B = cartStep(cart, Eigen::Vector3d::Zero(), 1);
  Eigen::Matrix4d F = Eigen::Matrix4d::Zero(), Q = Eigen::Matrix4d::Zero();
  F(0, 0) = 1;
  F.topRightCorner<1, 3>() = C * A;
  F.bottomRightCorner<3, 3>() = A;
  const Eigen::Vector4d G = (Eigen::Vector4d() << C * B, B).finished();
  Q(0, 0) = cart.Qe;
  const RiccatiResult riccati = solveDare(F, G, Q, Eigen::MatrixXd::Constant(1, 1, cart.R));
  const Eigen::Matrix4d X = riccati.X, loop = F - G * riccati.K;
  PreviewLaw law{riccati.K(0, 0), riccati.K.rightCols<3>(), Eigen::VectorXd(cart.ahead)};
  // A change of the reference in j steps is a change of the error then; what it costs, carried back to now.
  Eigen::Vector4d cost = X.col(0);
  for (double& gain : law.Gp) {
    gain = G.dot(cost) / (cart.R + G.dot(X * G));
    cost = (loop.transpose() * cost).eval();
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
  // Angular momenta of all about the foot that lands, and of the leg behind about the hip: for the rates of
  // the stance and the swing leg before, and of the new stance and swing leg after.
  Eigen::Matrix2d before, after;
  before << (walker.hipMass * l * l + 2 * m * a * l) * c - m * a * b, -m * a * b, -m * a * b, 0;
  after << (walker.hipMass + m) * l * l + m * a * a - m * l * b * c, m * b * (b - l * c), -m * l * b * c,
      m * b * b;
  const Eigen::Vector2d rates = solve(after, Eigen::Vector2d(before * x.tail<2>()));
  return {x[1], x[0], rates[0], rates[1]};
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
