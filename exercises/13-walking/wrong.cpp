// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant points_on_edges_kept> caught by: corners
// shown by: corners
// mistake: counts all points in a row as corners, even those between two others.
// <solution supportCorners>
std::vector<Eigen::Vector2d> points;
for (Eigen::Index i = 0; i < contacts.cols(); ++i) points.emplace_back(contacts.col(i));
std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
  return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
});
points.erase(std::unique(points.begin(), points.end()), points.end());
std::vector<Eigen::Vector2d> corners;
for (int pass = 0; pass < 2 && points.size() > 1; ++pass) {
  const std::size_t first = corners.size();
  for (const Eigen::Vector2d& p : points) {
    while (corners.size() >= first + 2) {
      const Eigen::Vector2d along = corners.back() - corners[corners.size() - 2], on = p - corners.back();
      if (along.x() * on.y() - along.y() * on.x() >= 0) break;
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

// <variant wraps_any_in_a_row> caught by: corners
// mistake: wraps the points like a gift, and takes any of several in one direction.
// <solution supportCorners>
const Eigen::Index n = contacts.cols();
std::vector<Eigen::Index> chosen;
Eigen::Index at = 0;
for (Eigen::Index i = 1; i < n; ++i)
  if (contacts(0, i) < contacts(0, at)) at = i;
const Eigen::Index first = at;
do {
  chosen.push_back(at);
  Eigen::Index next = at == 0 ? 1 : 0;
  for (Eigen::Index i = 0; i < n && next < n; ++i) {
    const Eigen::Vector2d way = contacts.col(next) - contacts.col(at),
                          to = contacts.col(i) - contacts.col(at);
    if (way.x() * to.y() - way.y() * to.x() < 0) next = i;
  }
  at = next;
} while (at < n && at != first && static_cast<Eigen::Index>(chosen.size()) < n);
Eigen::MatrixXd result(2, n == 0 ? 0 : chosen.size());
for (Eigen::Index i = 0; i < result.cols(); ++i)
  result.col(i) = contacts.col(chosen[static_cast<std::size_t>(i)]);
return result;

// <variant lines_for_edges> caught by: border, stands-any
// mistake: measures the distance from the infinite lines on which the edges lie.
// ask: Is it the distance from an infinite line? An edge ends at its corners.
// <solution borderDistance>
const Eigen::Index k = corners.cols();
double least = INFINITY;
for (Eigen::Index i = 0; i < k; ++i) {
  const Eigen::Vector2d edge = corners.col((i + 1) % k) - corners.col(i), to = point - corners.col(i);
  least = std::min(least, (edge.x() * to.y() - edge.y() * to.x()) / edge.norm());
}
return least;

// <variant masses_forgotten> caught by: stands, stands-any
// mistake: takes the mean position of all parts, whatever they weigh.
// ask: Do all parts count the same, whatever their masses are?
// <solution staticMargin>
Eigen::Vector2d sum = Eigen::Vector2d::Zero();
for (const MovingMass& part : robot) sum += part.p.head<2>();
return borderDistance(supportCorners(contacts), sum / static_cast<double>(robot.size()));

// <variant gravity_pulls_up> caught by: moment, moment-any
// mistake: the slide as printed: gravity is added to the force instead of taken from it.
// ask: Is the sign of gravity wrong? What counts is m (a - gravity), with gravity = (0, 0, -g).
// <solution zeroMoment>
// in place of: const Eigen::Vector3d force = part.mass * (part.a + Eigen::Vector3d(0, 0, g));
const Eigen::Vector3d force = part.mass * (part.a + Eigen::Vector3d(0, 0, -g));
// in place of: if (push <= 0) return std::nullopt;
if (push >= 0) return std::nullopt;

// <variant heights_from_zero> caught by: moment, moment-any
// mistake: the ground is always at zero.
// ask: Is the ground always at z = 0?
// <solution zeroMoment>
// in place of: sum += force.z() * part.p.head<2>() - (part.p.z() - groundHeight) * force.head<2>();
sum += force.z() * part.p.head<2>() - part.p.z() * force.head<2>();

// <variant forces_push_the_wrong_way> caught by: moment, moment-any
// mistake: the moment of horizontal forces has the wrong sign.
// ask: Do horizontal forces move the point the wrong way?
// <solution zeroMoment>
// in place of: sum += force.z() * part.p.head<2>() - (part.p.z() - groundHeight) * force.head<2>();
sum += force.z() * part.p.head<2>() + (part.p.z() - groundHeight) * force.head<2>();

// <variant weights_only> caught by: moment, moment-any
// mistake: leaves out the moment of horizontal forces.
// ask: Do the horizontal accelerations not count?
// <solution zeroMoment>
// in place of: sum += force.z() * part.p.head<2>() - (part.p.z() - groundHeight) * force.head<2>();
sum += force.z() * part.p.head<2>();

// <variant height_over_gravity> caught by: sways
// mistake: omega^2 upside down.
// ask: Is omega^2 = g / height upside down?
// <solution swayed>
// in place of: const double omega = std::sqrt(pendulum.g / pendulum.height);
const double omega = std::sqrt(pendulum.height / pendulum.g);

// <variant sways_like_a_clock> caught by: sways
// mistake: a pendulum that hangs: cosine and sine.
// ask: Does the pendulum hang? The solution of c'' = omega^2 (c - p) grows instead of oscillating.
// <solution swayed>
const double omega = std::sqrt(pendulum.g / pendulum.height), c = std::cos(omega * t),
             s = std::sin(omega * t);
return {p + c * (start.c - p) + s / omega * start.v, c* start.v - omega* s*(start.c - p)};

// <variant omega_inverted> caught by: capture
// shown by: capture
// mistake: the velocity times omega instead of divided by it.
// ask: Is v multiplied by omega instead of divided by it?
// <solution capturePoint>
return now.c + now.v * std::sqrt(pendulum.g / pendulum.height);

// <variant captures_behind> caught by: capture
// mistake: the velocity is subtracted.
// ask: Is v subtracted? The point lies ahead of the motion.
// <solution capturePoint>
return now.c - now.v * std::sqrt(pendulum.height / pendulum.g);

// <variant cart_by_euler> caught by: follows
// mistake: only the first powers of the time step.
// ask: Are the terms with step^2 and step^3 missing? The state must be exact.
// <solution cartStep>
return x + cart.step * Eigen::Vector3d(x[1], x[2], jerk);

// <variant cart_without_cube> caught by: follows
// mistake: the jerk does not move the cart within a time step.
// <solution cartStep>
const double h = cart.step;
return {x[0] + h * x[1] + h * h / 2 * x[2], x[1] + h* x[2] + h* h / 2 * jerk, x[2] + h* jerk};

// <variant calls_the_library> caught by: forbidden-call
// mistake: takes gains and gait from the library.
// <solution headers>
#include "locomotion/limit_cycle.h"
#include "locomotion/walking_pattern.h"
// <solution previewLaw>
const PreviewGains gains = previewGains({.height = cart.height,
                                         .g = cart.g,
                                         .step = cart.step,
                                         .preview = cart.step * cart.ahead,
                                         .Qe = cart.Qe,
                                         .R = cart.R});
return {gains.Gi, gains.Gx, gains.Gp};
// <solution gaitNear>
const LimitCycle cycle =
    findLimitCycle({walker.a, walker.b, walker.legMass, walker.hipMass, walker.slope, walker.g}, guess);
if (cycle.status == LimitCycle::Status::kFell) return std::nullopt;
return cycle.x;

// <variant gains_shifted> caught by: gains, gains-any
// mistake: the gains of the preview begin one time step too late.
// ask: Do the gains of the preview begin one step too late?
// <solution previewLaw>
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
Eigen::Vector4d cost = loop.transpose() * X.col(0);
for (double& gain : law.Gp) {
  gain = G.dot(cost) / (cart.R + G.dot(X * G));
  cost = (loop.transpose() * cost).eval();
}
return law;

// <variant errors_not_summed> caught by: follows
// mistake: the law gives the jerk itself instead of its change.
// ask: Is it the jerk that the law gives? It gives the change of the jerk, u_k - u_(k-1).
// <solution followed>
// in place of: double jerk = 0;
// in place of: const double p = x[0] - cart.height / cart.g * x[2]; ... jerk -= law.Gi * (p - reference[k]) +
double jerk = -law.Gi * (x[0] - cart.height / cart.g * x[2] - reference[k]) - law.Gx.dot(change);

// <variant preview_of_the_present> caught by: follows
// shown by: follows
// mistake: applies the first gain of the preview to a change of the reference that is already past.
// ask: Does the preview begin one step too late? Gp[0] belongs to r_(k+1) - r_k.
// <solution followed>
// in place of: for (Eigen::Index j = 1; j <= law.Gp.size() && k + j < n; ... jerk += law.Gp[j - 1] *
for (Eigen::Index j = 1; j <= law.Gp.size() && k + j - 1 < n; ++j)
  if (k + j > 1) jerk += law.Gp[j - 1] * (reference[k + j - 1] - reference[k + j - 2]);

// <variant preview_of_the_day_after> caught by: follows
// mistake: applies the first gain of the preview to the change after the next.
// ask: Does the preview begin one step too early? Gp[0] belongs to r_(k+1) - r_k.
// <solution followed>
// in place of: for (Eigen::Index j = 1; j <= law.Gp.size() && k + j < n; ... jerk += law.Gp[j - 1] *
for (Eigen::Index j = 1; j <= law.Gp.size() && k + j + 1 < n; ++j)
  jerk += law.Gp[j - 1] * (reference[k + j + 1] - reference[k + j]);

// <variant legs_not_exchanged> caught by: impact, step, other-steps, gait
// mistake: the leg that stood is still the first after the impact.
// ask: Are the legs not exchanged? The first angle is that of the leg that lands.
// <solution impactOf>
const double l = walker.a + walker.b, m = walker.legMass, c = std::cos(x[0] - x[1]);
const double a = walker.a, b = walker.b;
Eigen::Matrix2d before, after;
before << (walker.hipMass * l * l + 2 * m * a * l) * c - m * a * b, -m *a *b, -m *a *b, 0;
after << (walker.hipMass + m) * l * l + m * a * a - m * l * b * c, m *b *(b - l * c), -m *l *b *c, m *b *b;
const Eigen::Vector2d rates = solve(after, Eigen::Vector2d(before* x.tail<2>()));
return {x[0], x[1], rates[1], rates[0]};

// <variant rates_kept> caught by: impact, step, other-steps, gait
// shown by: step
// mistake: the impact does nothing but swap the roles of the legs.
// ask: Are the rates only exchanged? The impact changes them.
// <solution impactOf>
return {x[1], x[0], x[3], x[2]};

// <variant rates_in_the_old_order> caught by: impact, step, other-steps, gait
// mistake: the angles are exchanged, and the rates are not.
// ask: Are the two rates in the wrong order?
// <solution impactOf>
// in place of: return {x[1], x[0], (behind2 * all - all2 * behind) / determinant, ... (all1 * behind
return {x[1], x[0], (all1 * behind - behind1 * all) / determinant,
        (behind2 * all - all2 * behind) / determinant};

// <variant lands_behind> caught by: step
// mistake: a swing foot that comes down behind the stance foot ends the step, too.
// <solution stepFrom>
// in place of: if (!lands(now) && lands(next) && next[1] > next[0]) { ... }
if (i > 10 && !lands(now) && lands(next)) {
  double low = 0, high = h;
  for (int j = 0; j < 60; ++j) (lands(swung(walker, now, (low + high) / 2)) ? high : low) = (low + high) / 2;
  return StepEnd{impactOf(walker, swung(walker, now, high)), i * h + high};
}

// <variant lands_in_passing> caught by: step, gait, other-steps, other-gaits
// mistake: the foot lands where it first touches the ground, when the legs pass.
// <solution stepFrom>
const auto height = [&](const Eigen::Vector4d& at) {
  return std::cos(at[0] + walker.slope) - std::cos(at[1] + walker.slope);
};
constexpr double h = 1e-3;
Eigen::Vector4d now = x;
for (int i = 0; i < 5000; ++i) {
  const Eigen::Vector4d next = swung(walker, now, h);
  if (height(now) > 0 && height(next) <= 0) {
    double low = 0, high = h;
    for (int j = 0; j < 60; ++j)
      (height(swung(walker, now, (low + high) / 2)) <= 0 ? high : low) = (low + high) / 2;
    return StepEnd{impactOf(walker, swung(walker, now, high)), i * h + high};
  }
  if (std::abs(next[0] + walker.slope) >= M_PI / 2) return std::nullopt;
  now = next;
}
return std::nullopt;

// <variant lands_too_late> caught by: step, other-steps
// mistake: the impact happens at the end of a time step.
// <solution stepFrom>
// in place of: constexpr double h = 1e-3;
// in place of: const Eigen::Vector4d next = swung(walker, now, h); ... }
const Eigen::Vector4d next = swung(walker, now, 1e-3);
if (!lands(now) && lands(next) && next[1] > next[0]) return StepEnd{impactOf(walker, next), (i + 1) * 1e-3};

// <variant steps_for_hours> caught by: step
// mistake: a step may take any time.
// ask: May a step take longer than 5 s?
// <solution stepFrom>
const auto lands = [&](const Eigen::Vector4d& at) { return at[0] + at[1] + 2 * walker.slope <= 0; };
constexpr double h = 1e-3;
Eigen::Vector4d now = x;
for (int i = 0; i < 500000; ++i) {
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

// <variant swings_on_below_ground> caught by: step
// mistake: a fall is noticed only when the stance leg hangs straight down.
// ask: Is a fall noticed when the hip reaches the ground?
// <solution stepFrom>
// in place of: if (std::abs(next[0] + walker.slope) >= M_PI / 2) return std::nullopt;
if (std::abs(next[0]) >= M_PI) return std::nullopt;

// <variant derivative_of_the_flow> caught by: derivative, gait, other-gaits
// mistake: keeps the time of the step fixed, so that the foot need not be on the ground when it lands.
// <solution stepDerivative>
constexpr double d = 1e-5;
const auto end = stepFrom(walker, x);
if (!end) return Eigen::Matrix4d::Constant(NAN);
const auto flow = [&](Eigen::Vector4d at) {
  for (int i = 0; i < 1000; ++i) at = swung(walker, at, end->time / 1000);
  return impactOf(walker, at);
};
Eigen::Matrix4d J;
for (int i = 0; i < 4; ++i) {
  const Eigen::Vector4d change = d * Eigen::Vector4d::Unit(i);
  J.col(i) = (flow(x + change) - flow(x - change)) / (2 * d);
}
return J;

// <variant gait_of_the_paper_only> caught by: gait, other-gaits
// mistake: the numbers of the paper, whatever the slope is.
// ask: Is it the gait of the default walker, whatever the walker is?
// <solution gaitNear>
if (!stepFrom(walker, guess)) return std::nullopt;
return Eigen::Vector4d(.218668802939, -.323388558059, -1.091826677490, -.377181558403);
// <solution multiplierSizes>
return Eigen::Vector4d(.579952, .579952, .131573, 0);

// <variant walks_until_it_settles> caught by: other-gaits
// mistake: walks on until nothing changes, which finds stable gaits only.
// <solution gaitNear>
Eigen::Vector4d x = guess;
for (int i = 0; i < 400; ++i) {
  const auto end = stepFrom(walker, x);
  if (!end) return std::nullopt;
  if ((end->x - x).norm() < 1e-9) break;
  x = end->x;
}
return x;

// <variant eigenvalues_of_the_swing> caught by: gait, other-gaits
// mistake: eigenvalues of the rate at the beginning of a step, as if nothing else happened in it.
// <solution multiplierSizes>
Eigen::Matrix4d J;
for (int i = 0; i < 4; ++i) {
  const Eigen::Vector4d change = 1e-5 * Eigen::Vector4d::Unit(i);
  J.col(i) = (swingRate(walker, gait + change) - swingRate(walker, gait - change)) / 2e-5;
}
Eigen::VectorXd sizes = eigenvalues(J).cwiseAbs();
std::sort(sizes.begin(), sizes.end(), std::greater<>());
return sizes;
