#include <algorithm>
#include <cmath>
#include <functional>

#include "control/riccati.h"
#include "exercise.h"
#include "show.h"
#include "swing.h"
// <solution headers>
// What a mistake in wrong.cpp takes from the library.
// <todo>
// </solution>

using namespace rex;

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
  //| // TODO: begin at a contact that is certain to be a corner. Which one is next, and when is it the last?
  //| return Eigen::MatrixXd::Zero(2, 0);
  // </solution>
}

double borderDistance(const Eigen::MatrixXd& corners, const Eigen::Vector2d& point) {
  // <solution borderDistance>
  const Eigen::Index sides = corners.cols();
  bool isInside = sides > 2;
  double least = INFINITY;
  for (Eigen::Index i = 0; i < sides; ++i) {
    const Eigen::Index next = (i + 1) % sides;
    const double edgeX = corners(0, next) - corners(0, i), edgeY = corners(1, next) - corners(1, i);
    const double toX = point.x() - corners(0, i), toY = point.y() - corners(1, i);
    // The nearest point lies so far along the edge, 0 to 1.
    const double length2 = edgeX * edgeX + edgeY * edgeY;
    const double share = sides > 1 ? std::clamp((toX * edgeX + toY * edgeY) / length2, 0., 1.) : 0;
    least = std::min(least, std::hypot(toX - share * edgeX, toY - share * edgeY));
    isInside = isInside && edgeX * toY - edgeY * toX > 0;
  }
  return isInside ? least : -least;
  // <todo>
  //| // TODO: the nearest point of each edge. On which side of every edge is a point inside?
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
  //| // TODO: write down the x and y components of the sum on 11:10, with r = p - (x, y, groundHeight).
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
  //| return start;
  // </solution>
}

Eigen::Vector2d capturePoint(const Pendulum& pendulum, const Sway& now) {
  // <solution capturePoint>
  return now.c + now.v * std::sqrt(pendulum.height / pendulum.g);
  // <todo>
  //| // TODO: for which p does the part that grows vanish?
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
  //| return x;
  // </solution>
}

PreviewLaw previewLaw(const CartTable& cart) {
  // <solution previewLaw>
  // The state is the error p - r and the change of x in the last time step, driven by the change of the jerk.
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
  double price = cart.R;  // of a change of the jerk, now and in all time steps to come
  for (int row = 0; row < 4; ++row)
    for (int j = 0; j < 4; ++j) price += G[row] * riccati.X(row, j) * G[j];
  // A change of the reference in j time steps is a change of the error then; what it costs, carried back to
  // now.
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
  //| // TODO: start at rest; in each time step the law gives the change of the jerk.
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
  //| // TODO: two angular momenta are the same before and after the impact. About which points?
  //| return x;
  // </solution>
}

// <solution swings>
// One time step by the method of Runge and Kutta.
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
  //| // TODO: small time steps by Runge-Kutta, and the time of the impact within the last of them.
  //| return {};
  // </solution>
}

Eigen::Matrix4d stepDerivative(const Walker& walker, const Eigen::Vector4d& x) {
  // <solution stepDerivative>
  constexpr double d = 1e-5;
  Eigen::Matrix4d J;
  for (int column = 0; column < 4; ++column) {
    const auto high = stepFrom(walker, x + d * Eigen::Vector4d::Unit(column));
    const auto low = stepFrom(walker, x - d * Eigen::Vector4d::Unit(column));
    if (!high || !low) return Eigen::Matrix4d::Constant(NAN);
    J.col(column) = (high->x - low->x) / (2 * d);
  }
  return J;
  // <todo>
  //| // TODO: central differences of stepFrom().
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
  //| return {};
  // </solution>
}

Eigen::VectorXd multiplierSizes(const Walker& walker, const Eigen::Vector4d& gait) {
  // <solution multiplierSizes>
  Eigen::VectorXd sizes = eigenvalues(stepDerivative(walker, gait)).cwiseAbs();
  std::sort(sizes.begin(), sizes.end(), std::greater<>());
  return sizes;
  // <todo>
  //| // TODO: the multipliers are eigenvalues. Return their moduli, the largest first.
  //| return Eigen::VectorXd::Zero(4);
  // </solution>
}

// What follows is given, and never graded: change it as you like. show.h says what each line draws.

int main() {
  // Part 1: two soles, 25 x 12.5 cm, centred here [m].
  showSupport({0, .125}, {.25, -.125});

  // Part 2: a body on one sole accelerates, backwards and forwards. The pendulum begins above the origin with
  // 0.6 m/s.
  showTipping();
  showCapture(Pendulum{}, {.c = {0, 0}, .v = {.6, 0}});

  // Part 3: a walk around a bend. The centre of mass is 0.8 m high, and the preview 1.6 s long.
  const CartTable cart{.height = .8, .step = .01, .ahead = 160};
  const PreviewLaw law = previewLaw(cart);
  showGains(cart, law);
  showWalk(cart, law);
  showHorizon(cart, law);

  // Part 4: from this guess the compass walker settles; then other slopes than 3 degrees.
  const Eigen::Vector4d guess(.2, -.3, -1, -.3);
  showCompass(Walker{}, guess);
  showSlopes(guess);
}
