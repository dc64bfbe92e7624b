#include "grading/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "approach_checks.h"
#include "arm_checks.h"
#include "chain_checks.h"
#include "hand_checks.h"
#include "interface.h"
#include "pid_checks.h"
#include "random_chain.h"

using namespace rex;
using grading::Check;
using grading::Group;
using grading::Signal;

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
    check.input("a random step", {{"q", at.q}, {"v", at.v}, {"u", u}, {"mass", mass}, {"tau", tau}});
    const PointState next = student.eulerStep(at, u, mass, tau);
    const double v = at.v + tau * u / mass;
    check.near("q of eulerStep", next.q, at.q + tau * at.v, 1e-12, "m");
    check.near("v of eulerStep", next.v, v, 1e-12, "m/s");
    const double e = wanted.q - at.q, ed = wanted.v - at.v;
    check.input("a random state and gains", {{"q", at.q},
                                             {"v", at.v},
                                             {"wanted q", wanted.q},
                                             {"wanted v", wanted.v},
                                             {"Kp", gains.Kp},
                                             {"Kd", gains.Kd}});
    check.near("pdForce", student.pdForce(at, wanted, gains), gains.Kp * e + gains.Kd * ed, 1e-9, "N");
  });
}

void reaches(Check& check, Student& student, Regime regime, double T, double mass) {
  check.input(nameOf(regime), {{"T", T}, {"mass", mass}});
  const Gains gains = student.gainsFor(regime, T, mass);
  check.input(nameOf(regime), {{"T", T}, {"mass", mass}, {"Kp of gainsFor", gains.Kp}, {"Kd", gains.Kd}});
  check.that("the gains of gainsFor are positive and finite",
             gains.Kp > 0 && gains.Kd > 0 && std::isfinite(gains.Kp) && std::isfinite(gains.Kd));
  // Of a right answer, xi is in its range, and the slower of two rates, or the only one, takes about T.
  const auto isRight = [&](double Kp, double Kd, Regime kind) {
    const double xi = Kd / (2 * std::sqrt(Kp * mass)), lambda = std::sqrt(mass / Kp);
    const double rate = (xi > 1 ? xi - std::sqrt(xi * xi - 1) : xi) / lambda * T;
    const bool fits = kind == Regime::kOscillatory ? xi > 0.1 && xi < 0.75
                      : kind == Regime::kCritical  ? std::abs(xi - 1) < 0.1
                                                   : xi > 1.25;
    return fits && rate > 4.5 && rate < 17;
  };
  const auto exchanged = check.ask("Are Kp and Kd exchanged?", isRight(gains.Kd, gains.Kp, regime));
  const auto noMass =
      check.ask("Is the mass left out of the gains?", isRight(gains.Kp * mass, gains.Kd * mass, regime));
  const auto isT = check.ask("Is lambda equal to T? The distance only shrinks like exp(-xi t / lambda).",
                             std::abs(std::sqrt(mass / gains.Kp) - T) < 1e-9);
  const auto other = check.ask("These gains fit another regime: are regimes exchanged?",
                               std::any_of(kRegimes.begin(), kRegimes.end(), [&](Regime kind) {
                                 return kind != regime && isRight(gains.Kp, gains.Kd, kind);
                               }));
  const auto faster = check.ask("Which of the two rates of an over-damped point decides when it is there?",
                                regime == Regime::kOverdamped);
  Approach approach;
  const auto shown = check.show([&] { return approachSeen(approach, regime, T); });
  PointState at{};
  for (double t = 0; t < 3 * T && std::abs(at.q) < 10; t += kTau) {
    approach.push_back(1 - at.q);
    at = moved(at, gains.Kp * (1 - at.q) - gains.Kd * at.v, mass);
  }
  if (std::abs(at.q) >= 10) approach.push_back(1 - at.q);
  check.atMost("farthest that the point gets under the gains of gainsFor", std::abs(at.q), 10, "m");
  isInRegime(check, "the gains of gainsFor", approach, regime);
  arrivesInTime(check, "the gains of gainsFor", approach, T);
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
    const PointState at{rng.normal(), rng.normal()}, wanted{rng.normal(), rng.normal()};
    const PidSettings gains{rng.uniform(1, 50), rng.uniform(1, 20), rng.uniform(1, 20)};
    const double before = rng.uniform(0.5, 2), sum = restart ? 0 : before, e = wanted.q - at.q;
    check.input(restart ? "switched on now" : "already on", {{"q", at.q},
                                                             {"v", at.v},
                                                             {"wanted q", wanted.q},
                                                             {"wanted v", wanted.v},
                                                             {"Kp", gains.Kp},
                                                             {"Ki", gains.Ki},
                                                             {"Kd", gains.Kd},
                                                             {"integral", before},
                                                             {"tau", kTau}});
    const PidStep step = student.pidStep(at, wanted, gains, before, kTau, restart);
    const double pd = gains.Kp * e + gains.Kd * (wanted.v - at.v);
    check.near("force u of pidStep", step.u, pd + gains.Ki * sum, 1e-9, "N");
    check.near("integral of pidStep", step.integral, sum + kTau * e, 1e-12, "m s");
  }
  check.input("Kp = 60, Ki = 40, Kd = 25 against a push of 5 to 15 N, from 0 to 1 m");
  const double push = -rng.uniform(5, 15);
  double integral = 0;
  PointState at{};
  std::vector<double> places;
  const auto shown = check.show([&] {
    return grading::Evidence{.figures = {curveOf("The point under PID control", "q [m]", places, 1)}};
  });
  for (int i = 0; i < 1500; ++i) {  // as far as 100 m
    places.push_back(at.q);
    const PidStep step = student.pidStep(at, {1, 0}, {60, 40, 25}, integral, kTau, i == 0);
    integral = step.integral;
    at = moved(at, step.u + push, kMass);
    if (!(std::abs(at.q) < 100)) break;
  }
  check.near("position under pidStep after 15 s", at.q, 1, 1e-3, "m");
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
    check.atMost("distance of the point from 0 under followForce", std::abs(at.q), 10, "m");
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
  isInRegime(check, "followForce", approach, regime);
  arrivesInTime(check, "followForce", approach, 1);
}

void followsTheCosine(Check& check, Student& student) {
  for (const Regime regime : kRegimes) {
    const double t = check.rng().uniform(0, 6);
    check.input(nameOf(regime) + ", on the reference", {{"t", t}, {"mass", kMass}});
    // With another velocity than that of the reference the force would be right.
    const auto isRightAt = [&](double velocity) {
      return std::abs(student.followForce({std::cos(t), velocity}, t, kMass, regime) + kMass * std::cos(t)) <
             1e-9;
    };
    const auto sign =
        check.ask("Does the velocity of the reference have the wrong sign?", isRightAt(std::sin(t)));
    const auto still = check.ask("Is the velocity of the reference left out?", isRightAt(0));
    check.near("followForce on the reference",
               student.followForce({std::cos(t), -std::sin(t)}, t, kMass, regime), -kMass * std::cos(t), 1e-9,
               "N");
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
      check.atMost("distance from the reference just before the next kick, under followForce",
                   std::abs(off[step]), 0.01, "m");
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
  ArmRecord record("holdArm");
  const Eigen::Vector3d still = Eigen::Vector3d::Zero(), ones = Eigen::Vector3d::Ones();
  const auto undamped =
      check.ask("holdArm(0, v) is 0: is the damping missing?", student.holdArm(still, ones).norm() < 1e-12);
  const auto pushed = check.ask("The forces push away from zero: do they have the wrong sign?",
                                student.holdArm(ones, still).sum() > 0);
  shaken(check, S, record, [&](const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Simulator&) {
    return student.holdArm(q, v);
  });
  const auto shown = check.show([&] { return seen(S, record); });
  isNearZero(check, record, 0.6);
  double sum = 0;
  for (std::size_t step = 301; step <= 400; ++step) sum += record.farthest.values[step][0] / 100;
  const auto curve = check.show([&] {
    grading::Evidence evidence = seen(S, record);
    evidence.figures = {curveOf("Largest |q_i|; on average over the last second at most 0.25 rad",
                                "|q_i| [rad]", record.farthest, 0.25)};
    return evidence;
  });
  check.atMost("largest |q_i| under holdArm, on average over the last second", sum, 0.25, "rad");
}

void holdsTheArm(Check& check, Student& student) {
  Rng& rng = check.rng();
  check.input("q = 0 and v = 0");
  check.near("holdArm at rest at zero", student.holdArm(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()),
             Eigen::Vector3d::Zero(), 1e-12, "N m");
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d q = rng.normal() * Eigen::Vector3d::Unit(i),
                          v = rng.normal() * Eigen::Vector3d::Unit(i);
    check.input("a single joint is moved", {{"q", q}, {"v", v}});
    Eigen::VectorXd u = student.holdArm(q, v);
    check.shape("holdArm", u, 3, 1);
    u[i] = 0;
    check.near("holdArm, the forces on the other joints", u, Eigen::Vector3d::Zero(), 1e-12, "N m");
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
  check.shape("wantedAcceleration", a, S.getJointDimension(), 1);
  return student.computedTorque(M, F, a);
}

void accelerates(Check& check, Student& student) {
  check.forEachCase(6, [&](int) {
    Rng& rng = check.rng();
    const int n = 1 + rng.index(4);
    const double lambda = rng.uniform(0.1, 2), xi = rng.uniform(0.3, 2);
    const Eigen::VectorXd y = rng.normalVector(n), yd = rng.normalVector(n), F = rng.normalVector(n);
    const PathPoint reference{rng.normalVector(n), rng.normalVector(n), rng.normalVector(n)};
    const Eigen::MatrixXd M = randomMetric(rng, n);
    check.input("a random state and reference", {{"y", y},
                                                 {"yd", yd},
                                                 {"reference.y", reference.y},
                                                 {"reference.yd", reference.yd},
                                                 {"reference.ydd", reference.ydd},
                                                 {"lambda", lambda},
                                                 {"xi", xi}});
    // The distance from the reference moves like the point of mass 1 of slide 3:14.
    const Eigen::VectorXd e = y - reference.y, ed = yd - reference.yd;
    const Eigen::VectorXd back = -(2 * xi * lambda * ed + e) / (lambda * lambda);
    const Eigen::VectorXd wanted = reference.ydd + back;
    const double tolerance = 1e-9 * (1 + wanted.norm() + back.norm());
    const Eigen::VectorXd a = student.wantedAcceleration(y, yd, reference, lambda, xi);
    check.near("wantedAcceleration", a, wanted, tolerance, "rad/s^2");
    check.input("random M and F", {{"M", M}, {"F", F}, {"qdd", a}});
    check.near("computedTorque", student.computedTorque(M, F, a), F + M * a, 1e-9 * (1 + (M * a).norm()),
               "N m");
  });
}

// The noise moves a joint by sqrt(lambda^3 / 4) = 0.045 rad (one standard deviation), the push by 0.07: 0.5
// is far beyond what 1200 numbers reach. Without noise, only 2e-4 of the push is left after two seconds.
void holdsWithTorques(Check& check, Student& student) {
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  const PathPoint rest{zero, zero, zero};
  check.input("pegArm.ors at q = 0, lambda = 0.2 s, xi = 1, noise 1, a push of 1 rad/s after one second");
  const Simulator arm("pegArm.ors");
  ArmRecord record("computedTorque");
  shaken(check, arm, record, [&](const Eigen::VectorXd&, const Eigen::VectorXd&, const Simulator& S) {
    return torques(check, student, S, rest, 0.2, 1);
  });
  const auto shown = check.show([&] { return seen(arm, record); });
  isNearZero(check, record, 0.5);
  check.input("pegArm.ors at q = 0, lambda = 0.2 s, xi = 1, pushed by 1 rad/s");
  Simulator S("pegArm.ors");
  S.setJointAnglesAndVels(zero, Eigen::Vector3d::Ones());
  ArmRecord pushed("computedTorque");
  for (int step = 0; step < 200 && !pushed.isOver; ++step)
    advance(check, pushed, S, torques(check, student, S, rest, 0.2, 1));
  const auto after = check.show([&] {
    grading::Evidence evidence = seen(arm, pushed);
    evidence.figures = {curveOf("Largest |q_i| after the push", "|q_i| [rad]", pushed.farthest, 0)};
    return evidence;
  });
  couldBeSimulated(check, pushed);
  check.near("q after 2 s under computedTorque", S.getJointAngles(), zero, 2e-3, "rad");
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
    Signal errors{.axis = "time [s]"};
    ArmRecord record("computedTorque");
    for (int step = 0; step < 200 && !record.isOver; ++step) {
      const double t = kTau * step;
      const PathPoint reference{middle + std::sin(w * t) * swing, w * std::cos(w * t) * swing,
                                -w * w * std::sin(w * t) * swing};
      errors.add(t, (S.getJointAngles() - reference.y).cwiseAbs().maxCoeff());
      advance(check, record, S, torques(check, student, S, reference, 0.2, 1));
    }
    couldBeSimulated(check, record);
    check.atMostAlong("largest distance of a joint from its reference, under computedTorque", errors, 0.06,
                      "rad");
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
      const Eigen::Vector3d got = student.accelerationBias(S.description(), body);
      const auto zero =
          check.ask("Is the change of J left out? The joints keep their velocity.", got.isZero());
      const double size = std::max(1., wanted.norm());
      const auto coarse = check.ask("It is nearly right: is the step h of the differences of J too large?",
                                    got.size() == 3 && (got - wanted).norm() < 0.15 * size);
      check.near("accelerationBias", got, wanted, 1e-4 * size, "m/s^2");
      return;
    }
    const int d = 1 + rng.index(3), n = d + rng.index(3);
    const AccelerationTask task{randomMatrix(rng, d, n), rng.normalVector(d), rng.normalVector(d),
                                100 * randomMetric(rng, d)};
    const Eigen::MatrixXd M = randomMetric(rng, n), H = randomMetric(rng, n);
    const Eigen::VectorXd F = rng.normalVector(n);
    check.input(
        "a random task",
        {{"J", task.J}, {"bias", task.bias}, {"ydd", task.ydd}, {"C", task.C}, {"M", M}, {"F", F}, {"H", H}});
    const Eigen::MatrixXd T = task.J * inverse(M), pull = T.transpose() * task.C;
    const Eigen::VectorXd wanted = solve(H + pull * T, pull * (T * F - task.bias + task.ydd));
    check.near("u of operationalForce", student.operationalForce(task, M, F, H), wanted,
               1e-8 * (1 + wanted.norm()), "N m");
  });
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
  const Simulator atFirst = S;
  ArmRecord record("balancePin");
  Signal tilts{.axis = "time [s]"}, ways = tilts, pinForces = tilts;
  for (int step = 0; step < 500 && !record.isOver && angle() <= 0.1; ++step) {
    const Eigen::VectorXd u = student.balancePin(S.description(), kPinUp);
    check.shape("joint forces of balancePin", u, 8, 1);
    tilts.add(record.now(), angle());
    ways.add(record.now(), (foot() - home).norm());
    pinForces.add(record.now(), u.tail(2));
    advance(check, record, S, u);
  }
  tilts.add(record.now(), angle());
  ways.add(record.now(), (foot() - home).norm());
  const auto shown = check.show([&] { return filmed(atFirst, record.moments, {kPinUp}); });
  check.nearAlong("forces of balancePin on the joints without a motor", pinForces,
                  std::vector<Eigen::VectorXd>(pinForces.values.size(), Eigen::Vector2d::Zero()), 0, "N m");
  check.atMostAlong("tilt of the pin under balancePin", tilts, 0.1, "rad");
  couldBeSimulated(check, record);
  const auto last = check.show([&] {
    grading::Evidence evidence = filmed(atFirst, record.moments, {kPinUp});
    evidence.figures = {curveOf("Tilt of the pin; after 5 s at most 0.01 rad", "tilt [rad]", tilts, 0.01),
                        curveOf("Foot; after 5 s at most 0.08 m from home", "distance [m]", ways, 0.08)};
    return evidence;
  });
  check.atMost("tilt of the pin after 5 s under balancePin", angle(), 0.01, "rad");
  const auto leans =
      check.ask("The pin is upright, but the foot runs away: must the pin lean to bring it home?");
  check.atMost("distance of the foot from home after 5 s under balancePin", (foot() - home).norm(), 0.08,
               "m");
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
