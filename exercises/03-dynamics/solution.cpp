#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "control/point_mass.h"
#include "dynamics/dynamics_batch.h"
#include "exercise.h"
#include "scene/model.h"

using namespace rex;

// Keeps the compiler quiet about what a function below does not use yet.
template <class... Unused>
void notUsedYet(const Unused&...) {}

PointState eulerStep(const PointState& at, double u, double mass, double tau) {
  // <solution eulerStep>
  return {at.q + tau * at.v, at.v + tau * u / mass};
  // <todo>
  //| // TODO: both rows of the system equation, with what is known before the step.
  //| notUsedYet(u, mass, tau);
  //| return at;
  // </solution>
}

double pdForce(const PointState& at, const PointState& wanted, const Gains& gains) {
  // <solution pdForce>
  return gains.Kp * (wanted.q - at.q) + gains.Kd * (wanted.v - at.v);
  // <todo>
  //| // TODO: slide 3:10.
  //| notUsedYet(at, wanted, gains);
  //| return 0;
  // </solution>
}

Gains gainsFor(Regime regime, double T, double mass) {
  // <solution gainsFor>
  // The slower of the two rates of decay decides when the point is there: rate * T = 8 leaves 0.3 % also
  // where two equal rates add a factor of T.
  const double xi = regime == Regime::kOscillatory ? 0.5 : regime == Regime::kCritical ? 1 : 1.5;
  const double lambda = xi > 1 ? (xi - std::sqrt(xi * xi - 1)) * T / 7 : xi * T / 8;
  return {mass / (lambda * lambda), 2 * mass * xi / lambda};
  // <todo>
  //| // TODO: choose xi for the regime, then lambda for T, and compute the gains from both (3:14).
  //| notUsedYet(regime, T, mass);
  //| return {};
  // </solution>
}

PidStep pidStep(const PointState& at, const PointState& wanted, const PidSettings& gains, double integral,
                double tau, bool restart) {
  // <solution pidStep>
  if (restart) integral = 0;
  const double u = pdForce(at, wanted, {gains.Kp, gains.Kd}) + gains.Ki * integral;
  return {u, integral + tau * (wanted.q - at.q)};
  // <todo>
  //| // TODO: slide 3:16. What does the integral start from when the controller is switched on?
  //| notUsedYet(at, wanted, gains, tau, restart);
  //| return {0, integral};
  // </solution>
}

bool isStable(const PidSettings& gains, double mass) {
  // <solution isStable>
  // All roots of m s^3 + Kd s^2 + Kp s + Ki have to lie in the left half plane (Routh and Hurwitz). Without
  // Ki the root s = 0 belongs to an integral that moves nothing.
  if (gains.Ki == 0) return gains.Kp > 0 && gains.Kd > 0;
  return gains.Ki > 0 && gains.Kd > 0 && gains.Kp * gains.Kd > mass * gains.Ki;
  // <todo>
  //| // TODO: insert q = q* + exp(s t) into the differential equation. Where must all s lie?
  //| notUsedYet(gains, mass);
  //| return true;
  // </solution>
}

double followForce(const PointState& at, double t, double mass, Regime regime) {
  // <solution followForce>
  const PointState reference{std::cos(t), -std::sin(t)};
  return mass * -std::cos(t) + pdForce(at, reference, gainsFor(regime, 1, mass));
  // <todo>
  //| // TODO: which force does a point need that is on the reference already? And what if it is not?
  //| notUsedYet(at, t, mass, regime);
  //| return 0;
  // </solution>
}

Eigen::VectorXd holdArm(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  // <solution holdArm>
  // The first joint carries most. More damping does not help: what a joint moves alone, without the others,
  // has little inertia, and within tau the damping would throw it to the other side.
  const Eigen::Vector3d Kp(45, 20, 7), Kd(2.6, 1.1, 0.35);
  return -Kp.cwiseProduct(q) - Kd.cwiseProduct(v);
  // <todo>
  //| // TODO: gains for each of the three joints. Let main() show you what they do.
  //| notUsedYet(v);
  //| return Eigen::VectorXd::Zero(q.size());
  // </solution>
}

Eigen::VectorXd wantedAcceleration(const Eigen::VectorXd& y, const Eigen::VectorXd& yd,
                                   const PathPoint& reference, double lambda, double xi) {
  // <solution wantedAcceleration>
  return reference.ydd + (reference.y - y) / (lambda * lambda) + 2 * xi / lambda * (reference.yd - yd);
  // <todo>
  //| // TODO: the last line of slide 3:30.
  //| notUsedYet(yd, reference, lambda, xi);
  //| return Eigen::VectorXd::Zero(y.size());
  // </solution>
}

Eigen::VectorXd computedTorque(const Eigen::MatrixXd& M, const Eigen::VectorXd& F,
                               const Eigen::VectorXd& qdd) {
  // <solution computedTorque>
  return M * qdd + F;
  // <todo>
  //| // TODO: inverse dynamics of slide 3:29.
  //| notUsedYet(F, qdd);
  //| return Eigen::VectorXd::Zero(M.rows());
  // </solution>
}

Eigen::Vector3d accelerationBias(Simulator& S, const std::string& body) {
  // <solution accelerationBias>
  // How J changes along the motion, by a difference to both sides.
  const Eigen::VectorXd q = S.getJointAngles(), v = S.getJointVels();
  const double h = 1e-5 / (1 + v.norm());
  S.setJointAngles(q + h * v);
  const Eigen::MatrixXd later = S.jacobianPos(body);
  S.setJointAngles(q - h * v);
  const Eigen::MatrixXd before = S.jacobianPos(body);
  S.setJointAngles(q);
  return (later - before) * v / (2 * h);
  // <todo>
  //| // TODO: S can take postures a little later and a little earlier. How much does J differ?
  //| notUsedYet(S, body);
  //| return Eigen::Vector3d::Zero();
  // </solution>
}

Eigen::VectorXd operationalForce(const AccelerationTask& task, const Eigen::MatrixXd& M,
                                 const Eigen::VectorXd& F, const Eigen::MatrixXd& H) {
  // <solution operationalForce>
  const Eigen::MatrixXd T = solve(M, task.J.transpose()).transpose();  // J M^-1, for M is symmetric
  return solve(T.transpose() * task.C * T + H, T.transpose() * task.C * (task.ydd - task.bias + T * F));
  // <todo>
  //| // TODO: slide 3:33, with the bias once, not twice. solve(A, B) gives the X with A X = B.
  //| notUsedYet(task, M, H);
  //| return Eigen::VectorXd::Zero(F.size());
  // </solution>
}

Eigen::VectorXd followWithHand(Simulator& S, const std::string& hand, const PathPoint& reference) {
  const int n = S.getJointDimension();
  // <solution followWithHand>
  const Eigen::VectorXd v = S.getJointVels();
  Eigen::MatrixXd M;
  Eigen::VectorXd F;
  S.getDynamics(M, F);
  // The hand first; below it, with a ten-thousandth of its weight, all joints want to slow down.
  AccelerationTask both{Eigen::MatrixXd(3 + n, n), Eigen::VectorXd::Zero(3 + n), Eigen::VectorXd(3 + n),
                        Eigen::MatrixXd::Identity(3 + n, n + 3)};
  both.J << S.jacobianPos(hand), Eigen::MatrixXd::Identity(n, n);
  both.bias.head(3) = accelerationBias(S, hand);
  both.ydd << wantedAcceleration(S.kinematicsPos(hand), S.jacobianPos(hand) * v, reference, 0.1, 1), -5 * v;
  both.C.topLeftCorner(3, 3) *= 1e4;
  return operationalForce(both, M, F, 1e-3 * Eigen::MatrixXd::Identity(n, n));
  // <todo>
  //| // TODO: an AccelerationTask for the hand, and its force. What do the joints do that the hand leaves
  //| // free? Slide 3:35: a task may be made of two, one below the other.
  //| notUsedYet(hand, reference);
  //| return Eigen::VectorXd::Zero(n);
  // </solution>
}

Eigen::VectorXd newtonEuler(const std::vector<ChainLink>& chain, const Eigen::VectorXd& q,
                            const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                            const Eigen::Vector3d& gravity) {
  const auto n = static_cast<Eigen::Index>(chain.size());
  Eigen::VectorXd u = Eigen::VectorXd::Zero(n);
  // <solution newtonEuler>
  // Everything in the frame of its own link: w and wd turn it, pdd is the acceleration of its origin, f and
  // torque are what it takes from the link before. A world that falls upwards stands for gravity.
  std::vector<Eigen::Matrix3d> R_PL;
  std::vector<Eigen::Vector3d> f, torque;
  Eigen::Vector3d w = Eigen::Vector3d::Zero(), wd = Eigen::Vector3d::Zero(), pdd = -gravity;
  for (Eigen::Index i = 0; i < n; ++i) {
    const ChainLink& link = chain[static_cast<std::size_t>(i)];
    const Eigen::Matrix3d R = link.R_PL0 * Eigen::AngleAxisd(q[i], link.axis).toRotationMatrix();
    pdd = R.transpose() * (pdd + wd.cross(link.p_PL) + w.cross(w.cross(link.p_PL)));
    const Eigen::Vector3d carried = R.transpose() * w;
    w = carried + v[i] * link.axis;
    wd = R.transpose() * wd + a[i] * link.axis + v[i] * carried.cross(link.axis);
    const Eigen::Vector3d cdd = pdd + wd.cross(link.center) + w.cross(w.cross(link.center));
    R_PL.push_back(R);
    f.emplace_back(link.mass * cdd);
    torque.emplace_back(link.inertia * wd + w.cross(link.inertia * w) + link.center.cross(f.back()));
  }
  for (Eigen::Index i = n - 1; i >= 0; --i) {
    const auto k = static_cast<std::size_t>(i);
    u[i] = chain[k].axis.dot(torque[k]);
    if (i == 0) break;
    const Eigen::Vector3d handed = R_PL[k] * f[k];
    f[k - 1] += handed;
    torque[k - 1] += R_PL[k] * torque[k] + chain[k].p_PL.cross(handed);
  }
  // <todo>
  //| // TODO: from the first link to the last: how does it turn and accelerate, and which force and torque
  //| // does that take? Then from the last to the first: who hands them on, and what does the hinge feel?
  //| notUsedYet(q, v, a, gravity);
  // </solution>
  return u;
}

Eigen::VectorXd gravityTerm(const std::vector<ChainLink>& chain, const Eigen::VectorXd& q,
                            const Eigen::Vector3d& gravity) {
  // <solution gravityTerm>
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(q.size());
  return newtonEuler(chain, q, zero, zero, gravity);
  // <todo>
  //| // TODO: slide 3:24.
  //| notUsedYet(chain, gravity);
  //| return Eigen::VectorXd::Zero(q.size());
  // </solution>
}

Eigen::VectorXd coriolisTerm(const std::vector<ChainLink>& chain, const Eigen::VectorXd& q,
                             const Eigen::VectorXd& v) {
  // <solution coriolisTerm>
  return newtonEuler(chain, q, v, Eigen::VectorXd::Zero(q.size()), Eigen::Vector3d::Zero());
  // <todo>
  //| // TODO: slide 3:24, without the gravity that is in its second line.
  //| notUsedYet(chain, v);
  //| return Eigen::VectorXd::Zero(q.size());
  // </solution>
}

Eigen::MatrixXd inertiaMatrix(const std::vector<ChainLink>& chain, const Eigen::VectorXd& q) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(q.size());
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(q.size(), q.size());
  // <solution inertiaMatrix>
  for (Eigen::Index i = 0; i < q.size(); ++i)
    M.col(i) = newtonEuler(chain, q, zero, Eigen::VectorXd::Unit(q.size(), i), Eigen::Vector3d::Zero());
  // <todo>
  //| // TODO: slide 3:24 once more, column by column; what does gravity have to be?
  //| notUsedYet(chain);
  // </solution>
  return M;
}

Eigen::VectorXd balancePin(Simulator& S, const Eigen::VectorXd& home) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(8);
  // <solution balancePin>
  const Eigen::VectorXd q = S.getJointAngles(), v = S.getJointVels();
  Eigen::MatrixXd M;
  Eigen::VectorXd F;
  S.getDynamics(M, F);
  S.setJointAngles(home);
  const Eigen::Vector2d footAtHome = S.kinematicsPos("universalJoint").head<2>();
  const auto J = [&](double h) -> Eigen::MatrixXd {
    S.setJointAngles(q + h * v);
    return S.jacobianVec("pin").topRows(2);
  };
  const double h = 1e-5 / (1 + v.norm());
  AccelerationTask task{Eigen::MatrixXd(8, 8), Eigen::VectorXd::Zero(8), Eigen::VectorXd(8),
                        Eigen::MatrixXd::Identity(8, 8)};
  task.bias.head(2) = (J(h) - J(-h)) * v / (2 * h);
  task.J << J(0), Eigen::MatrixXd::Identity(6, 8);
  // The foot can only go where the pin leans: as on an inclined plane, it accelerates by g times the tilt.
  // So the tilt takes orders from a slow controller of the foot, and is itself one of the two tasks. Four
  // ways are left to the arm; in those it goes home.
  const Eigen::Vector2d foot = S.kinematicsPos("universalJoint").head<2>();
  const Eigen::Vector2d footVelocity = S.jacobianPos("universalJoint").topRows(2) * v;
  const PathPoint stay{footAtHome, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  const Eigen::VectorXd lean = wantedAcceleration(foot, footVelocity, stay, 2, 1) / 9.81;
  const PathPoint upright{lean, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  const PathPoint atHome{home.head(6), Eigen::VectorXd::Zero(6), Eigen::VectorXd::Zero(6)};
  task.ydd << wantedAcceleration(S.kinematicsVec("pin").head(2), J(0) * v, upright, 0.25, 1),
      wantedAcceleration(q.head(6), v.head(6), atHome, 0.5, 1);
  task.C.topLeftCorner(2, 2) *= 1e4;
  // Forces that nobody can afford are not used.
  Eigen::MatrixXd H = 1e-4 * Eigen::MatrixXd::Identity(8, 8);
  H.bottomRightCorner(2, 2) = 1e8 * Eigen::Matrix2d::Identity();
  u.head(6) = operationalForce(task, M, F, H).head(6);
  // <todo>
  //| // TODO: the tilt of the pin is a task for the six joints with a motor. Which H keeps the others out?
  //| // Where does the arm go if it does nothing but keep the pin upright, and how can the pin bring it back?
  //| notUsedYet(S, home);
  // </solution>
  return u;
}

// From here on everything is given: all parts one after another, with pictures. Change it as you like.

namespace {

constexpr double kTau = 0.01, kMass = 3.456;
// Of pegArm2, and of pin_balancing.
const Eigen::VectorXd kBent = (Eigen::VectorXd(7) << 0.6, -0.2, -0.7, 0.9, 0.9, 0.1, -1.6).finished();
const Eigen::VectorXd kPinUp =
    (Eigen::VectorXd(8) << 0, 1.0472, 1.0472, 0.523599, 0, 0, 2.34565, 0.00194306).finished();

const std::vector<std::pair<std::string, Regime>> kRegimes = {{"oscillatory", Regime::kOscillatory},
                                                              {"critical", Regime::kCritical},
                                                              {"over-damped", Regime::kOverdamped}};

struct PointMotion {
  std::vector<double> t, q, v;
  void add(const PointState& at) {
    t.push_back(kTau * static_cast<double>(t.size()));
    q.push_back(at.q);
    v.push_back(at.v);
  }
};

// `seconds` of a point from rest at 0; u(at, t) is the force on it.
template <class Force>
PointMotion simulate(double seconds, const Force& u) {
  PointMotion motion;
  PointState at;
  for (motion.add(at); motion.t.back() < seconds; motion.add(at))
    at = eulerStep(at, u(at, motion.t.back()), kMass, kTau);
  return motion;
}

PointMotion reach(Regime regime, double T) {
  const Gains gains = gainsFor(regime, T, kMass);
  return simulate(1.5 * T, [&](const PointState& at, double) { return pdForce(at, {1, 0}, gains); });
}

Series curve(const std::string& label, const PointMotion& motion) {
  return {.label = label, .x = motion.t, .y = motion.q};
}

Figure overTime(const std::string& title, const std::string& yLabel, const std::vector<Series>& series) {
  return {.title = title,
          .xLabel = "time [s]",
          .yLabel = yLabel,
          .legend = series.size() > 1 ? Legend::kOutside : Legend::kNone,
          .series = series};
}

// What the library has to say, on top of yours.
Series dashed(const std::vector<double>& x, const std::vector<double>& y) {
  return {.x = x, .y = y, .dashed = true, .color = Color{0, 0, 0}};
}

// A point that shall get to 1 m.
void plotWay(const std::string& name, const std::string& title, const std::vector<Series>& series,
             const std::vector<Guide>& moments = {}) {
  Figure figure = overTime(title, "position [m]", series);
  figure.horizontalLines = {{1, "goal"}};
  figure.verticalLines = moments;
  plot(name, figure);
}

// exact(gains, t): where the point is after t seconds [m] without the error of Euler steps.
void showPoint(double (*exact)(const Gains& gains, double t)) {
  std::vector<Series> ways, exactWays, phases, horizons;
  for (const auto& [name, regime] : kRegimes) {
    const PointMotion motion = reach(regime, 1);
    ways.push_back(curve(name, motion));
    phases.push_back({.label = name, .x = motion.q, .y = motion.v});
    exactWays.push_back(dashed(motion.t, motion.t));
    for (double& y : exactWays.back().y) y = exact(gainsFor(regime, 1, kMass), y);
  }
  ways.insert(ways.end(), exactWays.begin(), exactWays.end());
  plotWay("regimes", "Three ways to the goal in one second (dashed: exact motion)", ways, {{1, "T"}});
  Figure phase = overTime("The same ways in phase space", "velocity [m/s]", phases);
  phase.xLabel = "position [m]";
  plot("phase", phase);
  for (const int T : {1, 2, 5}) {
    const Gains gains = gainsFor(Regime::kCritical, T, kMass);
    horizons.push_back(curve("T = " + std::to_string(T) + " s", reach(Regime::kCritical, T)));
    print("Kp, Kd for T = " + std::to_string(T) + " s", Eigen::RowVector2d(gains.Kp, gains.Kd));
  }
  plotWay("horizons", "Critically damped, in one, two and five seconds", horizons);
}

// PID control of a point to 1 m against a steady push [N]. Until `released` it is held where it is, but the
// controller works on; then it is switched on anew, or not.
PointMotion pidMotion(const PidSettings& gains, double seconds, double push, double released, bool restart) {
  double integral = 0;
  return simulate(seconds, [&](const PointState& at, double t) {
    const bool first = t < 0.5 * kTau || (restart && std::abs(t - released) < 0.5 * kTau);
    const PidStep step = pidStep(at, {1, 0}, gains, integral, kTau, first);
    integral = step.integral;
    return t < released - 0.5 * kTau ? 0 : step.u + push;
  });
}

void showPid() {
  const PidSettings pd{60, 0, 25}, pid{60, 40, 25}, alone{0, 2, 0}, damped{0, 2, 2}, all{10, 4, 8};
  plotWay("load", "Against a steady push of 10 N",
          {curve("PD", pidMotion(pd, 8, -10, 0, false)), curve("PID", pidMotion(pid, 8, -10, 0, false))});
  plotWay("integral", "What an integral does without the others",
          {curve("Ki alone", pidMotion(alone, 10, 0, 0, false)),
           curve("Ki and Kd", pidMotion(damped, 10, 0, 0, false)),
           curve("all three", pidMotion(all, 10, 0, 0, false))});
  plotWay("restart", "Held for three seconds, then released",
          {curve("integral kept", pidMotion(pid, 12, 0, 3, false)),
           curve("integral restarted", pidMotion(pid, 12, 0, 3, true))},
          {{3, "released"}});
  for (const PidSettings& gains : {alone, damped, all})
    print("Kp, Ki, Kd and whether stable",
          Eigen::RowVector4d(gains.Kp, gains.Ki, gains.Kd, isStable(gains, kMass) ? 1 : 0));
}

void showFollowing() {
  std::vector<Series> ways;
  for (const auto& [name, regime] : kRegimes) {
    Rng rng(3);
    PointState at{1, 0};
    PointMotion off;
    for (int step = 0; step <= 600; ++step) {
      const double t = kTau * step;
      if (step > 0 && step % 100 == 0) at.v += 0.1 * rng.normal();
      off.add({1e3 * (at.q - std::cos(t)), 0});
      at = eulerStep(at, followForce(at, t, kMass, regime), kMass, kTau);
    }
    ways.push_back(curve(name, off));
  }
  plot("kicks", overTime("Following a cosine, with a kick every second", "distance from it [mm]", ways));
}

// y at 0.01, 0.02, ... seconds.
Series everyStep(const std::string& label, const std::vector<double>& y) {
  Series series{.label = label, .y = y};
  for (std::size_t i = 1; i <= y.size(); ++i) series.x.push_back(kTau * static_cast<double>(i));
  return series;
}

// Four seconds of an arm, under noise with a push of 1 rad/s after one: u(q, v, S) are the forces. Returns
// the angle of the joint that is farthest from zero.
template <class Force>
std::vector<double> swing(Simulator& S, double noise, const Force& u) {
  S.setDynamicSimulationNoise(noise);
  std::vector<double> farthest;
  for (int step = 0; step < 400; ++step) {
    const Eigen::VectorXd angles = S.getJointAngles();
    if (noise > 0 && step == 100)
      S.setJointAnglesAndVels(angles, S.getJointVels() + Eigen::VectorXd::Ones(angles.size()));
    S.stepDynamics(u(angles, S.getJointVels(), S), kTau);
    farthest.push_back(S.getJointAngles().cwiseAbs().maxCoeff());
  }
  return farthest;
}

Eigen::VectorXd byComputedTorque(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Simulator& S) {
  Eigen::MatrixXd M;
  Eigen::VectorXd F;
  S.getDynamics(M, F);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(q.size());
  return computedTorque(M, F, wantedAcceleration(q, v, {zero, zero, zero}, 0.2, 1));
}

// In real time: 30 frames a second.
void film(const Simulator& S, const std::string& name, const PictureOptions& look, int seconds) {
  writeVideo(S, name, look, 30 * seconds);
  writeContactSheet(S, name + "_sheet", look, 6, 30 * seconds);
}

void showFall() {
  Simulator falling("pegArm.ors");
  const double atFirst = falling.getEnergy();
  std::vector<double> drift;
  swing(falling, 0, [&](const Eigen::VectorXd& q, const Eigen::VectorXd&, const Simulator& S) {
    drift.push_back(1e6 * (S.getEnergy() - atFirst));
    return Eigen::VectorXd::Zero(q.size()).eval();
  });
  plot("energy", overTime("Energy of a falling arm", "energy gained [uJ]", {everyStep("", drift)}));
  film(falling, "fall", {.caption = "Without forces", .traces = {"peg"}, .view = {1, -0.3, 0.3}}, 4);
}

void showArms() {
  Simulator held("pegArm.ors"), known("pegArm.ors"), known2("pegArm2.ors");
  const auto byPd = [](const auto& q, const auto& v, const Simulator&) { return holdArm(q, v); };
  Figure figure = overTime("Holding arms at zero, under noise and a push", "joint farthest from zero [rad]",
                           {everyStep("PD, pegArm", swing(held, 1, byPd)),
                            everyStep("M and F, pegArm", swing(known, 1, byComputedTorque)),
                            everyStep("M and F, pegArm2", swing(known2, 1, byComputedTorque))});
  figure.verticalLines = {{1, "push"}};
  plot("holding", figure);
  film(held, "hold", {.caption = "PD in each joint", .view = {1, -0.3, 0.3}}, 4);
  film(known, "torque", {.caption = "Computed torque", .view = {1, -0.3, 0.3}}, 4);
}

// The hand on a circle of 20 cm radius from where it is, once round in three seconds, from rest to rest.
PathPoint onCircle(const Eigen::Vector3d& start, double t) {
  const double pi = std::numbers::pi, w = pi / 3, angle = pi * (1 - std::cos(w * t));
  const double rate = pi * w * std::sin(w * t), growth = pi * w * w * std::cos(w * t);
  const Eigen::Vector3d out(0, std::sin(angle), std::cos(angle)), along(0, std::cos(angle), -std::sin(angle));
  return {start + 0.2 * (out - Eigen::Vector3d::UnitZ()), 0.2 * rate * along,
          0.2 * (growth * along - rate * rate * out)};
}

void showHand() {
  Simulator S("pegArm2.ors");
  S.setJointAngles(kBent);
  S.clearRecording();
  const Eigen::Vector3d start = S.kinematicsPos("peg");
  std::vector<double> error;
  std::vector<Eigen::Vector3d> circle;
  for (int step = 0; step < 300; ++step) {
    const PathPoint reference = onCircle(start, kTau * step);
    circle.emplace_back(reference.y);
    Simulator here = S;
    S.stepDynamics(followWithHand(here, "peg", reference), kTau);
    error.push_back(1e3 * (S.kinematicsPos("peg") - onCircle(start, kTau * (step + 1)).y).norm());
  }
  const Figure figure =
      overTime("The hand on its circle", "distance from its reference [mm]", {everyStep("", error)});
  const PictureOptions look{
      .caption = "Operational space control", .traces = {"peg"}, .paths = {circle}, .view = {1, -0.6, 0.4}};
  plot("hand", figure);
  film(S, "circle", look, 3);
  writeReplay(S, "circle", look, {figure}, 90);
}

// A chain for newtonEuler(): the frame of each link is that of its hinge.
std::vector<ChainLink> chainOf(const Model& model) {
  std::vector<ChainLink> chain;
  Pose X_PB = model.bodies()[static_cast<std::size_t>(model.joints()[0].parent)].X_PB;
  for (const Joint& joint : model.joints()) {
    const Body& body = model[joint.child];
    const Pose X_PL = X_PB * joint.X_PF;
    X_PB = joint.X_MC;
    chain.push_back({X_PL.R, X_PL.p, joint.axis, body.mass, X_PB * body.p_BBcm,
                     X_PB.R * body.I_BBcm_B * X_PB.R.transpose()});
  }
  return chain;
}

// q, v and a of a swing of pegArm2 through both sides of zero, a column for each step.
std::array<Eigen::MatrixXd, 3> wideSwing() {
  const Eigen::VectorXd far = Eigen::VectorXd::LinSpaced(7, 1.2, -0.8);
  Eigen::MatrixXd Q(7, 300), V(7, 300);
  for (int step = 0; step < 300; ++step) {
    Q.col(step) = std::sin(2 * kTau * (step + 1)) * far;
    V.col(step) = 2 * std::cos(2 * kTau * (step + 1)) * far;
  }
  return {Q, V, -4 * Q};
}

void showNewtonEuler(const std::vector<ChainLink>& chain, const Eigen::MatrixXd& byLibrary) {
  const auto [Q, V, A] = wideSwing();
  std::vector<Series> yours, library;
  for (const int joint : {0, 2, 4}) {
    std::vector<double> u, expected;
    for (int step = 0; step < Q.cols(); ++step) {
      u.push_back(newtonEuler(chain, Q.col(step), V.col(step), A.col(step), earthGravity())[joint]);
      expected.push_back(byLibrary(joint, step));
    }
    yours.push_back(everyStep("joint " + std::to_string(joint + 1), u));
    library.push_back(dashed(yours.back().x, expected));
  }
  yours.insert(yours.end(), library.begin(), library.end());
  plot("newtonEuler",
       overTime("A swing of pegArm2: your forces, and the library's (dashed)", "joint force [N m]", yours));
  Eigen::MatrixXd terms(7, 9);
  terms << inertiaMatrix(chain, kBent), gravityTerm(chain, kBent, earthGravity()),
      coriolisTerm(chain, kBent, Eigen::VectorXd::Ones(7));
  print("M, G and C v of pegArm2, bent and turning at 1 rad/s", terms);
}

void showPin() {
  Simulator S("pin_balancing.ors");
  Eigen::VectorXd q = kPinUp;
  q[6] += 0.02;
  S.setJointAngles(q);
  S.clearRecording();
  std::vector<double> tilt;
  for (int step = 0; step < 500; ++step) {
    Simulator here = S;
    S.stepDynamics(balancePin(here, kPinUp), kTau);
    tilt.push_back(std::acos(std::clamp(S.kinematicsVec("pin").z(), -1., 1.)));
  }
  plot("pin", overTime("A pin that starts at 0.02 rad", "tilt of the pin [rad]", {everyStep("", tilt)}));
  film(S, "pin", {.caption = "Balancing a pin", .traces = {"universalJoint"}, .view = {1, -1, 0.4}}, 5);
}

}  // namespace

int main() {
  showPoint([](const Gains& g, double t) { return pdResponse({kMass}, {g.Kp, g.Kd}, {}, 1, t).q; });
  showPid();
  showFollowing();
  showFall();
  showArms();
  showHand();
  showPin();

  // Once your own recursion works, it lies on the library's, which takes all moments at once.
  const Simulator S("pegArm2.ors");
  const auto [Q, V, A] = wideSwing();
  Eigen::MatrixXd U = Q;
  DynamicsWorkspace workspace;
  inverseDynamicsBatch(S.model(), Q, V, A, earthGravity(), workspace, U);
  showNewtonEuler(chainOf(S.model()), U);
}
