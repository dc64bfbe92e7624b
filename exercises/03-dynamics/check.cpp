#include "grading/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "approach_checks.h"
#include "arm_checks.h"
#include "dynamics/inverse_dynamics.h"
#include "dynamics/mass_matrix.h"
#include "interface.h"
#include "random_chain.h"

using namespace rex;
using grading::Check;
using grading::Group;

namespace {

constexpr double kMass = 3.456;
const std::array<Regime, 3> kRegimes = {Regime::kOscillatory, Regime::kCritical, Regime::kOverdamped};

std::string nameOf(Regime regime) {
  return regime == Regime::kOscillatory ? "oscillatory"
         : regime == Regime::kCritical  ? "critical"
                                        : "over-damped";
}

std::string text(double x) { return std::to_string(x).substr(0, 5); }

Eigen::MatrixXd randomMatrix(Rng& rng, int rows, int columns) {
  return rng.normalVector(rows * columns).reshaped(rows, columns);
}

// Symmetric, positive definite.
Eigen::MatrixXd randomMetric(Rng& rng, int n) {
  const Eigen::MatrixXd A = randomMatrix(rng, n, n);
  return A * A.transpose() / n + 0.3 * Eigen::MatrixXd::Identity(n, n);
}

// Part 1.

void stepsAndPulls(Check& check, Student& student) {
  check.forEachCase(5, [&](int) {
    Rng& rng = check.rng();
    const PointState at{rng.normal(), rng.normal()}, wanted{rng.normal(), rng.normal()};
    const double u = rng.normal(), mass = rng.uniform(0.5, 5), tau = rng.uniform(0.005, 0.1);
    const Gains gains{rng.uniform(1, 50), rng.uniform(1, 20)};
    check.input("a random state, force, mass and step; random gains");
    const PointState next = student.eulerStep(at, u, mass, tau);
    check.near("position after one step", next.q, at.q + tau * at.v, 1e-12, "m");
    check.near("velocity after one step", next.v, at.v + tau * u / mass, 1e-12, "m/s");
    check.near("force of PD control", student.pdForce(at, wanted, gains),
               gains.Kp * (wanted.q - at.q) + gains.Kd * (wanted.v - at.v), 1e-9, "N");
  });
}

void reaches(Check& check, Student& student, Regime regime, double T, double mass) {
  check.input(nameOf(regime) + ", T = " + text(T) + " s, mass = " + text(mass) + " kg, from 0 to 1 m");
  const Gains gains = student.gainsFor(regime, T, mass);
  check.that("the gains are positive and finite",
             gains.Kp > 0 && gains.Kd > 0 && std::isfinite(gains.Kp) && std::isfinite(gains.Kd));
  Approach approach;
  const auto shown = check.show([&] { return approachSeen(approach, regime, T); });
  PointState at{};
  for (double t = 0; t < 3 * T; t += kTau) {
    approach.push_back(1 - at.q);
    check.that("the point stays within 10 m", std::abs(at.q) < 10);
    at = moved(at, gains.Kp * (1 - at.q) - gains.Kd * at.v, mass);
  }
  isInRegime(check, approach, regime);
  arrivesInTime(check, approach, T);
}

void reachesInEveryRegime(Check& check, Student& student) {
  for (const double T : {1., 2., 5.})
    for (const Regime regime : kRegimes) reaches(check, student, regime, T, kMass);
}

// <hidden>
void reachesWithAnyMass(Check& check, Student& student) {
  check.forEachCase(9, [&](int i) {
    Rng& rng = check.rng();
    reaches(check, student, kRegimes[static_cast<std::size_t>(i % 3)], rng.uniform(1, 5),
            std::exp(rng.uniform(-2, 3)));
  });
}
// </hidden>

// Part 2.

void pidSteps(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (const bool restart : {false, true}) {
    check.input(restart ? "a random state and gains, switched on now" : "a random state and gains");
    const PointState at{rng.normal(), rng.normal()}, wanted{rng.normal(), rng.normal()};
    const PidSettings gains{rng.uniform(1, 50), rng.uniform(1, 20), rng.uniform(1, 20)};
    const double before = rng.uniform(0.5, 2), sum = restart ? 0 : before;
    const PidStep step = student.pidStep(at, wanted, gains, before, kTau, restart);
    check.near("force", step.u, gains.Kp * (wanted.q - at.q) + gains.Kd * (wanted.v - at.v) + gains.Ki * sum,
               1e-9, "N");
    check.near("integral after the step", step.integral, sum + kTau * (wanted.q - at.q), 1e-12, "m s");
  }
  check.input("Kp = 60, Ki = 40, Kd = 25 against a push of 5 to 15 N, from 0 to 1 m");
  const double push = -rng.uniform(5, 15);
  double integral = 0;
  PointState at{};
  std::vector<double> places;
  const auto shown = check.show([&] {
    return grading::Evidence{.figures = {curveOf("The point under PID control", "q [m]", places, 1)}};
  });
  for (int i = 0; i < 1500; ++i) {
    places.push_back(at.q);
    const PidStep step = student.pidStep(at, {1, 0}, {60, 40, 25}, integral, kTau, i == 0);
    integral = step.integral;
    at = moved(at, step.u + push, kMass);
    check.that("the point stays within 100 m", std::abs(at.q) < 100);
  }
  check.near("position after 15 s", at.q, 1, 1e-3, "m");
}

// The greatest real part of the roots of m s^3 + Kd s^2 + Kp s + Ki, or of m s^2 + Kd s + Kp if Ki is zero.
double growth(const PidSettings& gains, double mass) {
  const int order = gains.Ki == 0 ? 2 : 3;
  const Eigen::Vector3d coefficients = -Eigen::Vector3d(gains.Kd, gains.Kp, gains.Ki) / mass;
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(order, order);
  companion.row(0) = coefficients.head(order).transpose();
  companion.bottomLeftCorner(order - 1, order - 1).setIdentity();
  return eigenvalues(companion).real().maxCoeff();
}

struct KnownLoop {
  PidSettings gains{};
  double mass = kMass;
  bool isStable = false;
};

// Shuffled, so that counting calls does not help. Random gains whose roots are too close to the imaginary
// axis are left out; the cases on the axis are exact.
void judgesPid(Check& check, Student& student) {
  std::vector<KnownLoop> loops{{.gains = {0, 2, 0}},  // Ki alone
                               {.gains = {0, 2, 3}},  // Ki and Kd
                               {.gains = {5, 0, 0}},  // oscillates for ever
                               {.gains = {0, 0, 5}},  // comes to rest anywhere
                               {.gains = {5, 0, 3}, .isStable = true},
                               {.gains = {4, 6, 3}, .mass = 2},  // on the border
                               {.gains = {-4, 1, -3}, .mass = 2}};
  Rng& rng = check.rng();
  while (loops.size() < 67) {
    const PidSettings gains{rng.uniform(-3, 10), rng.index(3) == 0 ? 0 : rng.uniform(-3, 10),
                            rng.uniform(-3, 10)};
    const double mass = rng.uniform(0.5, 5), rate = growth(gains, mass);
    // Half of the cases are stable, half are not.
    if (std::abs(rate) < 1e-3 || (rate < 0) != (loops.size() % 2 == 0)) continue;
    loops.push_back({gains, mass, rate < 0});
  }
  for (std::size_t k = loops.size(); k > 0; --k) {
    std::swap(loops[k - 1], loops[static_cast<std::size_t>(rng.index(static_cast<int>(k)))]);
    const auto& [gains, mass, isStable] = loops[k - 1];
    check.input("Kp = " + text(gains.Kp) + ", Ki = " + text(gains.Ki) + ", Kd = " + text(gains.Kd) +
                ", mass = " + text(mass) + " kg");
    check.that("isStable() says whether the point comes to rest", student.isStable(gains, mass) == isStable);
  }
}

// Part 3.

// The signed distance from cos t at each step. The point starts `start` away from the reference, with its
// velocity; kick(step) is added to the velocity of the point.
template <class Kick>
std::vector<double> distances(Check& check, Student& student, Regime regime, double mass, double start,
                              double t0, int steps, const Kick& kick) {
  std::vector<double> off;
  PointState at{std::cos(t0) + start, -std::sin(t0)};
  for (int i = 0; i < steps; ++i) {
    const double t = t0 + kTau * i;
    at.v += kick(i);
    off.push_back(at.q - std::cos(t));
    at = moved(at, student.followForce(at, t, mass, regime), mass);
    check.that("the point stays within 10 m", std::abs(at.q) < 10);
  }
  return off;
}

double none(int) { return 0; }

// Euler steps of a cosine make the velocity wrong by tau / 2 times the acceleration, which PD control turns
// into 2 lambda tau / 2 = 1.5 mm at most. So the way back is measured from a point that was not pushed.
void comesBack(Check& check, Student& student, Regime regime, double mass, double t0) {
  check.input(nameOf(regime) + ", mass = " + text(mass) + " kg, 0.5 m off the reference at t = " + text(t0));
  const auto pushed = distances(check, student, regime, mass, 0.5, t0, 300, none);
  const auto still = distances(check, student, regime, mass, 0, t0, 300, none);
  Approach approach;
  for (std::size_t i = 0; i < pushed.size(); ++i) approach.push_back((pushed[i] - still[i]) / 0.5);
  const auto shown = check.show([&] { return approachSeen(approach, regime, 1); });
  isInRegime(check, approach, regime);
  arrivesInTime(check, approach, 1);
}

void followsTheCosine(Check& check, Student& student) {
  for (const Regime regime : kRegimes) {
    const double t = check.rng().uniform(0, 6);
    check.input(nameOf(regime) + ", on the reference at t = " + text(t) + " s");
    check.near("force on the reference", student.followForce({std::cos(t), -std::sin(t)}, t, kMass, regime),
               -kMass * std::cos(t), 1e-9, "N");
    comesBack(check, student, regime, kMass, t);
  }
}

// <hidden>
// The effect of a kick of 0.5 m/s (five standard deviations) has shrunk to 3 mm before the next, and 1.5 mm
// are always there: 10 mm are never reached.
void followsUnderKicks(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    Rng& rng = check.rng();
    const Regime regime = kRegimes[static_cast<std::size_t>(i % 3)];
    const double mass = rng.uniform(0.5, 10);
    if (i < 3) return comesBack(check, student, regime, mass, rng.uniform(0, 6));
    const auto off = distances(check, student, regime, mass, 0, 0, 500,
                               [&](int step) { return step % 100 == 0 ? 0.1 * rng.normal() : 0; });
    for (std::size_t step = 99; step < off.size(); step += 100)
      check.atMost("distance from the reference just before the next kick", std::abs(off[step]), 0.01, "m");
  });
}
// </hidden>

// Parts 4 to 6: arms.

Simulator arm(const std::string& scene, const Eigen::VectorXd& q) {
  Simulator S(scene);
  S.setJointAngles(q);
  return S;
}

// Part 4.

// Over 200 seeds and masses the reference solution stayed within 0.38 rad (0.6 are allowed), within 0.10 rad
// on average (0.25), and below 1.8 rad/s (3).
void isHeld(Check& check, Student& student, const Simulator& S) {
  constexpr double kFarthest = 0.6;
  ArmRecord record;
  const auto shown = check.show([&] { return seen(S, record, kFarthest); });
  shaken(check, S, record, [&](const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Simulator&) {
    return student.holdArm(q, v);
  });
  check.atMost("angle farthest from zero", largest(record.farthest), kFarthest, "rad");
  double sum = 0;
  for (std::size_t step = 301; step <= 400; ++step) sum += record.farthest[step] / 100;
  check.atMost("angle farthest from zero, on average over the last second", sum, 0.25, "rad");
}

void holdsTheArm(Check& check, Student& student) {
  Rng& rng = check.rng();
  check.input("q = 0 and v = 0; then a single joint is moved");
  check.near("forces at rest at zero", student.holdArm(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()),
             Eigen::Vector3d::Zero(), 1e-12, "N m");
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d q = rng.normal() * Eigen::Vector3d::Unit(i),
                          v = rng.normal() * Eigen::Vector3d::Unit(i);
    Eigen::VectorXd u = student.holdArm(q, v);
    check.shape("joint forces", u, 3, 1);
    u[i] = 0;
    check.near("forces on the other joints", u, Eigen::Vector3d::Zero(), 1e-12, "N m");
  }
  check.input("pegArm.ors at q = 0, noise 1, a push of 1 rad/s after one second");
  isHeld(check, student, Simulator("pegArm.ors"));
}

// <hidden>
void holdsOtherArms(Check& check, Student& student) {
  check.forEachCase(4,
                    [&](int) { isHeld(check, student, withOtherMasses("pegArm.ors", 0.15, check.rng())); });
}
// </hidden>

// Part 5.

Eigen::VectorXd torques(Check& check, Student& student, const Simulator& S, const PathPoint& reference,
                        double lambda, double xi) {
  Eigen::MatrixXd M;
  Eigen::VectorXd F;
  S.getDynamics(M, F);
  const Eigen::VectorXd a =
      student.wantedAcceleration(S.getJointAngles(), S.getJointVels(), reference, lambda, xi);
  check.shape("wanted acceleration", a, S.getJointDimension(), 1);
  return student.computedTorque(M, F, a);
}

void accelerates(Check& check, Student& student) {
  check.forEachCase(6, [&](int) {
    Rng& rng = check.rng();
    const int n = 1 + rng.index(7);
    const double lambda = rng.uniform(0.1, 2), xi = rng.uniform(0.3, 2);
    const Eigen::VectorXd y = rng.normalVector(n), yd = rng.normalVector(n), F = rng.normalVector(n);
    const PathPoint reference{rng.normalVector(n), rng.normalVector(n), rng.normalVector(n)};
    const Eigen::MatrixXd M = randomMetric(rng, n);
    check.input("random states and references, random M and F");
    const Eigen::VectorXd a = student.wantedAcceleration(y, yd, reference, lambda, xi);
    check.shape("wanted acceleration", a, n, 1);
    // The distance from the reference moves like the point of mass 1 of slide 3:14.
    check.near(
        "lambda^2 e'' + 2 xi lambda e' + e for e = y - reference",
        lambda * lambda * (a - reference.ydd) + 2 * xi * lambda * (yd - reference.yd) + y - reference.y,
        Eigen::VectorXd::Zero(n), 1e-9);
    const Eigen::VectorXd u = student.computedTorque(M, F, a);
    check.shape("joint forces", u, n, 1);
    check.near("acceleration under these forces", solve(M, u - F), a, 1e-8, "rad/s^2");
  });
}

// The noise moves a joint by sqrt(lambda^3 / 4) = 0.045 rad (one standard deviation), the push by 0.07: 0.5
// is far beyond what 1200 numbers reach. Without noise, only 2e-4 of the push is left after two seconds.
void holdsWithTorques(Check& check, Student& student) {
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  const PathPoint rest{zero, zero, zero};
  check.input("pegArm.ors at q = 0, lambda = 0.2 s, xi = 1, noise 1, a push of 1 rad/s after one second");
  constexpr double kFarthest = 0.5;
  const Simulator arm("pegArm.ors");
  ArmRecord record;
  const auto shown = check.show([&] { return seen(arm, record, kFarthest); });
  shaken(check, arm, record, [&](const Eigen::VectorXd&, const Eigen::VectorXd&, const Simulator& S) {
    return torques(check, student, S, rest, 0.2, 1);
  });
  check.atMost("angle farthest from zero", largest(record.farthest), kFarthest, "rad");
  check.input("pegArm.ors at q = 0, lambda = 0.2 s, xi = 1, pushed by 1 rad/s");
  Simulator S("pegArm.ors");
  S.setJointAnglesAndVels(zero, Eigen::Vector3d::Ones());
  record = {};
  for (int step = 0; step < 200; ++step) {
    record.moments.push_back(S.getJointAngles());
    record.farthest.push_back(record.moments.back().cwiseAbs().maxCoeff());
    advance(check, S, torques(check, student, S, rest, 0.2, 1));
  }
  check.atMost("angle farthest from zero after 2 s", S.getJointAngles().cwiseAbs().maxCoeff(), 2e-3, "rad");
}

// <hidden>
// Holding the force for tau costs 19 mrad, 24 at most in 200 cases. Without the acceleration of the
// reference, a joint is off by lambda^2 times that acceleration, 0.1 rad.
void followsWithTheOtherArm(Check& check, Student& student) {
  check.forEachCase(3, [&](int) {
    Rng& rng = check.rng();
    Simulator S = withOtherMasses("pegArm2.ors", 0.5, rng);
    const Eigen::VectorXd middle = rng.uniformVector(7, -1, 1), swing = rng.uniformVector(7, 0.4, 0.5);
    const double w = 2.5;
    S.setJointAnglesAndVels(middle, w * swing);
    double error = 0;
    for (int step = 0; step < 200; ++step) {
      const double t = kTau * step;
      const PathPoint reference{middle + std::sin(w * t) * swing, w * std::cos(w * t) * swing,
                                -w * w * std::sin(w * t) * swing};
      error = std::max(error, (S.getJointAngles() - reference.y).cwiseAbs().maxCoeff());
      advance(check, S, torques(check, student, S, reference, 0.2, 1));
    }
    check.atMost("largest distance of a joint from its reference", error, 0.06, "rad");
  });
}
// </hidden>

// Part 6.

Simulator inMotion(Simulator S, Rng& rng) {
  const int n = S.getJointDimension();
  S.setJointAnglesAndVels(rng.uniformVector(n, -1, 1), rng.uniformVector(n, -2, 2));
  return S;
}

// The acceleration of the body along q + t v, by a second difference; accurate to 1e-6 at these speeds.
Eigen::Vector3d secondDifference(Simulator S, const std::string& body) {
  const Eigen::VectorXd middle = S.getJointAngles(), rate = S.getJointVels();
  const double h = 2e-4;
  const auto place = [&](double t) {
    S.setJointAngles(middle + t * rate);
    return S.kinematicsPos(body);
  };
  return (place(h) - 2 * place(0) + place(-h)) / (h * h);
}

void biasAndForce(Check& check, Student& student) {
  check.forEachCase(8, [&](int i) {
    Rng& rng = check.rng();
    if (i < 4) {
      const Simulator S = inMotion(Simulator(i < 2 ? "pegArm2.ors" : "arm3.ors"), rng);
      const std::string body = i < 2 ? "peg" : "eff";
      check.input(S.description().sceneName + ", body '" + body + "', random posture and velocities");
      const Eigen::Vector3d wanted = secondDifference(S, body);
      check.near("acceleration at constant joint velocities", student.accelerationBias(S.description(), body),
                 wanted, 1e-4 * std::max(1., wanted.norm()), "m/s^2");
      return;
    }
    const int d = 1 + rng.index(4), n = d + rng.index(5);
    const AccelerationTask task{randomMatrix(rng, d, n), rng.normalVector(d), rng.normalVector(d),
                                100 * randomMetric(rng, d)};
    const Eigen::MatrixXd M = randomMetric(rng, n), H = randomMetric(rng, n);
    const Eigen::VectorXd F = rng.normalVector(n);
    check.input("a random task, M, F and H");
    const Eigen::VectorXd u = student.operationalForce(task, M, F, H);
    check.shape("joint forces", u, n, 1);
    const Eigen::MatrixXd T = task.J * inverse(M);
    const Eigen::VectorXd miss = T * (u - F) + task.bias - task.ydd, pull = T.transpose() * task.C * miss;
    const Eigen::VectorXd wanted =
        solve(H + T.transpose() * task.C * T, T.transpose() * task.C * (T * F - task.bias + task.ydd));
    const double scale =
        T.norm() * task.C.norm() * (T.norm() * (wanted.norm() + F.norm()) + 2) + H.norm() * wanted.norm();
    check.atMost("relative gradient of the cost at u", (pull + H * u).norm() / scale, 1e-10);
  });
}

// The reference of a hand: once along a path, from rest to rest in three seconds, with the sine profile.
struct Path {
  Eigen::Vector3d start, along, out;  ///< a line to start + along; with `out`, a circle with that radius
  PathPoint at(double t) const {
    const double w = std::numbers::pi / 3, s = (1 - std::cos(w * t)) / 2, sd = w * std::sin(w * t) / 2,
                 sdd = w * w * std::cos(w * t) / 2;
    if (out.isZero()) return {start + s * along, sd * along, sdd * along};
    const double turn = 2 * std::numbers::pi, angle = turn * s;
    const Eigen::Vector3d x = std::cos(angle) * out + std::sin(angle) * along,
                          xd = turn * (-std::sin(angle) * out + std::cos(angle) * along);
    return {start + x - out, sd * xd, sdd * xd - turn * turn * sd * sd * x};
  }
};

// The hand and its wanted point on the path, which is red.
grading::Evidence handSeen(const Simulator& S, const std::string& hand, const Path& path,
                           const std::vector<Eigen::VectorXd>& moments, const std::vector<double>& errors,
                           double limit) {
  if (moments.empty()) return {};
  std::vector<Eigen::Vector3d> way;
  for (int step = 0; step <= 300; ++step) way.emplace_back(path.at(kTau * step).y);
  Film film =
      filmOf(S, moments, {.caption = "wanted: the hand on the red point", .traces = {hand}, .paths = {way}});
  for (std::size_t i = 0; i < film.size(); ++i) {
    film[i].time = kTau * static_cast<double>(i);
    film[i].picture.pointSets.push_back({.points = {way[i]}, .color = grading::kWrongColor, .size = 9});
  }
  const double moment = kTau * static_cast<double>(worstOf(errors, limit));
  Figure figure = curveOf("Distance of the hand from the red point", "distance [m]", errors, limit);
  figure.verticalLines = {grading::wrongFrom(moment)};
  return {.figures = {figure}, .film = std::move(film), .moment = moment};
}

// The reference solution stays within 0.6 mm and 0.6 rad/s on all of 60 paths.
void handFollows(Check& check, Student& student, Simulator S, const std::string& hand, const Path& path) {
  constexpr double kFarthest = 5e-3;
  double speed = 0;
  std::vector<double> errors;
  std::vector<Eigen::VectorXd> moments;
  const auto shown = check.show([&] { return handSeen(S, hand, path, moments, errors, kFarthest); });
  for (int step = 0; step <= 300; ++step) {
    const PathPoint reference = path.at(kTau * step);
    moments.push_back(S.getJointAngles());
    errors.push_back((S.kinematicsPos(hand) - reference.y).norm());
    speed = std::max(speed, S.getJointVels().cwiseAbs().maxCoeff());
    if (step < 300) advance(check, S, student.followWithHand(S.description(), hand, reference));
  }
  check.atMost("largest distance of the hand from its reference", largest(errors), kFarthest, "m");
  check.atMost("largest joint speed", speed, 5, "rad/s");
}

const Eigen::VectorXd kBent = (Eigen::VectorXd(7) << 0.6, -0.2, -0.7, 0.9, 0.9, 0.1, -1.6).finished();

void followsACircle(Check& check, Student& student) {
  check.input("pegArm2.ors, bent, the peg on a circle of 0.2 m radius in 3 s");
  const Simulator S = arm("pegArm2.ors", kBent);
  handFollows(check, student, S, "peg", {S.kinematicsPos("peg"), {0, 0.2, 0}, {0, 0, 0.2}});
}

// <hidden>
void followsALine(Check& check, Student& student) {
  check.forEachCase(3, [&](int i) {
    Rng& rng = check.rng();
    Simulator S = withOtherMasses("pegArm2.ors", 0.5, rng);
    S.setJointAngles(kBent + rng.uniformVector(7, -0.1, 0.1));
    const Eigen::Vector3d start = S.kinematicsPos("peg"), along = 0.2 * rng.normalVector(3).normalized();
    const Eigen::Vector3d out = 0.2 * along.cross(Eigen::Vector3d(rng.normalVector(3))).normalized();
    handFollows(check, student, S, "peg", {start, along, i == 0 ? Eigen::Vector3d::Zero().eval() : out});
  });
}
// </hidden>

// Part 7.

void forcesOf(Check& check, Student& student, const std::vector<ChainLink>& chain,
              const Eigen::Vector3d& gravity) {
  Rng& rng = check.rng();
  const auto n = static_cast<int>(chain.size());
  const Eigen::VectorXd q = 2 * rng.normalVector(n), v = rng.normalVector(n), a = rng.normalVector(n);
  const Eigen::VectorXd wanted = inverseDynamics(modelOf(chain), q, v, a, gravity);
  check.near("joint forces", student.newtonEuler(chain, q, v, a, gravity), wanted, 1e-9 * (1 + wanted.norm()),
             "N m");
}

void newtonAndEuler(Check& check, Student& student) {
  Rng& rng = check.rng();
  check.input("a pendulum: one link, axis x, its centre of mass below the hinge (3:21)");
  const double mass = rng.uniform(0.5, 2), length = rng.uniform(0.3, 1), moment = 0.02;
  const ChainLink link{
      Eigen::Matrix3d::Identity(),         {0, 0, 2}, Eigen::Vector3d::UnitX(), mass, {0, 0, -length},
      moment * Eigen::Matrix3d::Identity()};
  const Eigen::VectorXd q = rng.normalVector(1), v = rng.normalVector(1), a = rng.normalVector(1);
  const double wanted = (mass * length * length + moment) * a[0] + mass * 9.81 * length * std::sin(q[0]);
  check.near("joint force", student.newtonEuler({link}, q, v, a, {0, 0, -9.81}),
             Eigen::VectorXd::Constant(1, wanted), 1e-9, "N m");
  for (const int n : {1, 2, 3, 7}) {
    check.input("a random chain of length " + std::to_string(n) + ", gravity downwards");
    forcesOf(check, student, randomChain(rng, n), earthGravity());
  }
}

void terms(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (const int n : {2, 5}) {
    check.input("a random chain of length " + std::to_string(n));
    const std::vector<ChainLink> chain = randomChain(rng, n);
    const Model model = modelOf(chain);
    const Eigen::VectorXd q = rng.normalVector(n), v = rng.normalVector(n);
    const auto near = [&](const std::string& property, const Eigen::MatrixXd& got,
                          const Eigen::MatrixXd& wanted) {
      check.near(property, got, wanted, 1e-9 * (1 + wanted.norm()));
    };
    near("M", student.inertiaMatrix(chain, q), massMatrix(model, q));
    near("G", student.gravityTerm(chain, q, earthGravity()), gravityForces(model, q));
    near("C v", student.coriolisTerm(chain, q, v), biasForces(model, q, v, Eigen::Vector3d::Zero()));
  }
}

// <hidden>
void anyChain(Check& check, Student& student) {
  check.forEachCase(8, [&](int i) {
    Rng& rng = check.rng();
    const std::vector<ChainLink> chain = randomChain(rng, 1 + rng.index(9));
    forcesOf(check, student, chain,
             i < 2 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(9 * rng.normalVector(3)));
  });
}
// </hidden>

// Part 8.

const Eigen::VectorXd kPinUp =
    (Eigen::VectorXd(8) << 0, 1.0472, 1.0472, 0.523599, 0, 0, 2.34565, 0.00194306).finished();

// In 24 directions the reference solution never tilts by more than at the start. At the end it tilts by 0.001
// rad, with its foot 4 cm from home. Without anything that brings it home, the foot ends 13 to 50 cm away.
void balances(Check& check, Student& student, double tilt, double direction) {
  Eigen::VectorXd q = kPinUp;
  q.tail(2) += tilt * Eigen::Vector2d(std::cos(direction), std::sin(direction));
  Simulator S = arm("pin_balancing.ors", q);
  const auto angle = [&] { return std::acos(std::clamp(S.kinematicsVec("pin").z(), -1., 1.)); };
  const auto foot = [&] { return Eigen::Vector2d(S.kinematicsPos("universalJoint").head<2>()); };
  const Eigen::Vector2d home = arm("pin_balancing.ors", kPinUp).kinematicsPos("universalJoint").head<2>();
  double most = 0;
  std::vector<double> tilts, ways;
  std::vector<Eigen::VectorXd> moments;
  const auto record = [&] {
    moments.push_back(S.getJointAngles());
    tilts.push_back(angle());
    ways.push_back((foot() - home).norm());
  };
  // The requirements hold in all steps, or they fail in the last one recorded.
  const auto shown = check.show([&] {
    grading::Evidence evidence = filmed(S, moments, {kPinUp}, moments.size() - 1,
                                        curveOf("Tilt of the pin", "angle [rad]", tilts, 0.01));
    evidence.figures.push_back(curveOf("Distance of the foot from home", "distance [m]", ways, 0.08));
    return evidence;
  });
  record();
  for (int step = 0; step < 500; ++step) {
    const Eigen::VectorXd u = student.balancePin(S.description(), kPinUp);
    check.shape("joint forces", u, 8, 1);
    check.near("forces of the joints without a motor", u.tail(2), Eigen::Vector2d::Zero(), 0, "N m");
    advance(check, S, u);
    record();
    most = std::max(most, angle());
    check.atMost("tilt of the pin", most, 0.1, "rad");
  }
  check.atMost("tilt of the pin after 5 s", angle(), 0.01, "rad");
  check.atMost("distance of the foot from home after 5 s", (foot() - home).norm(), 0.08, "m");
}

void balancesThePin(Check& check, Student& student) {
  check.input("pin_balancing.ors with the pin upright, tilted by 0.02 rad");
  balances(check, student, 0.02, 0);
}

// <hidden>
void balancesAnyTilt(Check& check, Student& student) {
  check.forEachCase(3, [&](int i) {
    balances(check, student, i == 0 ? 0.02 : 0.01, check.rng().uniform(-std::numbers::pi, std::numbers::pi));
  });
}
// </hidden>

}  // namespace

grading::Checks<Student> checks() {
  return {
      {"point-step", "point", "one Euler step, and the force of PD control", 1, Group::kVisible,
       stepsAndPulls},
      {"point-regimes", "point", "three regimes reach the goal in 1, 2 and 5 s", 1, Group::kVisible,
       reachesInEveryRegime},
      // <hidden>
      {"point-any-mass", "point", "other masses and times", 1, Group::kHidden, reachesWithAnyMass},
      // </hidden>
      {"pid-step", "pid", "PID control, and its restart", 1, Group::kVisible, pidSteps},
      {"pid-stability", "pid", "which gains are stable", 1, Group::kVisible, judgesPid},
      {"follow-cosine", "follow", "on the reference, and the return to it", 1, Group::kVisible,
       followsTheCosine},
      // <hidden>
      {"follow-kicks", "follow", "other masses, and kicks every second", 1, Group::kHidden,
       followsUnderKicks},
      // </hidden>
      {"hold-arm", "hold", "the arm is held against noise and a push", 1, Group::kVisible, holdsTheArm},
      // <hidden>
      {"hold-other-masses", "hold", "arms with other masses are held, too", 1, Group::kHidden,
       holdsOtherArms},
      // </hidden>
      {"torque-equations", "torque", "the wanted acceleration, and the forces for it", 1, Group::kVisible,
       accelerates},
      {"torque-hold", "torque", "the arm is held with M and F", 1, Group::kVisible, holdsWithTorques},
      // <hidden>
      {"torque-other-arm", "torque", "another arm follows a reference", 1, Group::kHidden,
       followsWithTheOtherArm},
      // </hidden>
      {"hand-equations", "hand", "accelerationBias, and operationalForce minimises its cost", 1,
       Group::kVisible, biasAndForce},
      {"hand-circle", "hand", "the hand follows a circle", 1, Group::kVisible, followsACircle},
      // <hidden>
      {"hand-other-paths", "hand", "other paths, other masses", 1, Group::kHidden, followsALine},
      // </hidden>
      {"chain-forces", "chain", "a pendulum, and chains under gravity", 1, Group::kVisible, newtonAndEuler},
      {"chain-terms", "chain", "M, G and C v", 1, Group::kVisible, terms},
      // <hidden>
      {"chain-any", "chain", "other chains, other gravity", 1, Group::kHidden, anyChain},
      // </hidden>
      {"pin-upright", "pin", "the pin stays upright", 1, Group::kVisible, balancesThePin},
      // <hidden>
      {"pin-any-tilt", "pin", "other tilts", 1, Group::kHidden, balancesAnyTilt},
      // </hidden>
  };
}
