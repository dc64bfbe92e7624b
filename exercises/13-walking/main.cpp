#include <algorithm>
#include <cmath>
#include <functional>

#include "control/riccati.h"
#include "exercise.h"
#include "show.h"
#include "swing.h"

using namespace rex;

Eigen::MatrixXd supportCorners(const Eigen::MatrixXd& contacts) {
  // TODO: begin at a contact that is certain to be a corner. Which one is next, and when is it the last?
  return Eigen::MatrixXd::Zero(2, 0);
}

double borderDistance(const Eigen::MatrixXd& corners, const Eigen::Vector2d& point) {
  // TODO: the nearest point of each edge. On which side of every edge is a point inside?
  return 0;
}

double staticMargin(const std::vector<MovingMass>& robot, const Eigen::MatrixXd& contacts) {
  // TODO: where is the centre of mass?
  return 0;
}

std::optional<Eigen::Vector2d> zeroMoment(const std::vector<MovingMass>& robot, double groundHeight,
                                          double g) {
  // TODO: write down the x and y components of the sum on 11:10, with r = p - (x, y, groundHeight).
  return {};
}

Sway swayed(const Pendulum& pendulum, const Sway& start, const Eigen::Vector2d& p, double t) {
  // TODO: c'' = omega^2 (c - p) has a solution of two exponentials, or of cosh and sinh.
  return start;
}

Eigen::Vector2d capturePoint(const Pendulum& pendulum, const Sway& now) {
  // TODO: for which p does the part that grows vanish?
  return now.c;
}

Eigen::Vector3d cartStep(const CartTable& cart, const Eigen::Vector3d& x, double jerk) {
  // TODO: c is a cubic in time while the jerk is held.
  return x;
}

PreviewLaw previewLaw(const CartTable& cart) {
  // TODO: the state of the Riccati equation is the error and the change of x. See the README.
  return {0, Eigen::RowVector3d::Zero(), Eigen::VectorXd::Zero(cart.ahead)};
}

Eigen::MatrixXd followed(const CartTable& cart, const PreviewLaw& law, const Eigen::VectorXd& reference) {
  // TODO: start at rest; in each time step the law gives the change of the jerk.
  return Eigen::MatrixXd::Zero(3, reference.size());
}

Eigen::Vector4d impactOf(const Walker& walker, const Eigen::Vector4d& x) {
  // TODO: two angular momenta are the same before and after the impact. About which points?
  return x;
}

std::optional<StepEnd> stepFrom(const Walker& walker, const Eigen::Vector4d& x) {
  // TODO: small time steps by Runge-Kutta, and the time of the impact within the last of them.
  return {};
}

Eigen::Matrix4d stepDerivative(const Walker& walker, const Eigen::Vector4d& x) {
  // TODO: central differences of stepFrom().
  return Eigen::Matrix4d::Zero();
}

std::optional<Eigen::Vector4d> gaitNear(const Walker& walker, const Eigen::Vector4d& guess) {
  // TODO: Newton's method for step(x) - x = 0.
  return {};
}

Eigen::VectorXd multiplierSizes(const Walker& walker, const Eigen::Vector4d& gait) {
  // TODO: the multipliers are eigenvalues. Return their moduli, the largest first.
  return Eigen::VectorXd::Zero(4);
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
