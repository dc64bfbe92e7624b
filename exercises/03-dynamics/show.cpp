#include "show.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>

#include "control/point_mass.h"
#include "dynamics/dynamics_batch.h"
#include "scene/model.h"

using namespace rex;

namespace {

constexpr double kTau = 0.01;
// Postures of pegArm2 and of pin_balancing.
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

// The motion of a point of that mass for `seconds`, from rest at 0; u(at, t) is the force on it.
template <class Force>
PointMotion simulate(double mass, double seconds, const Force& u) {
  PointMotion motion;
  PointState at;
  for (motion.add(at); motion.t.back() < seconds; motion.add(at))
    at = eulerStep(at, u(at, motion.t.back()), mass, kTau);
  return motion;
}

PointMotion reach(double mass, Regime regime, double T) {
  const Gains gains = gainsFor(regime, T, mass);
  return simulate(mass, 1.5 * T, [&](const PointState& at, double) { return pdForce(at, {1, 0}, gains); });
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

// The library's curve, drawn on top of yours.
Series dashed(const std::vector<double>& x, const std::vector<double>& y) {
  return {.x = x, .y = y, .dashed = true, .color = Color{0, 0, 0}};
}

// A point that should reach 1 m.
void plotWay(const std::string& name, const std::string& title, const std::vector<Series>& series,
             const std::vector<Guide>& moments = {}) {
  Figure figure = overTime(title, "position [m]", series);
  figure.horizontalLines = {{1, "goal"}};
  figure.verticalLines = moments;
  plot(name, figure);
}

// PID control of a point to 1 m against a steady push [N]. Until `released` the point is held in place while
// the controller keeps running; then the controller is restarted, or not.
PointMotion pidMotion(double mass, const PidSettings& gains, double seconds, double push, double released,
                      bool restart) {
  double integral = 0;
  return simulate(mass, seconds, [&](const PointState& at, double t) {
    const bool first = t < 0.5 * kTau || (restart && std::abs(t - released) < 0.5 * kTau);
    const PidStep step = pidStep(at, {1, 0}, gains, integral, kTau, first);
    integral = step.integral;
    return t < released - 0.5 * kTau ? 0 : step.u + push;
  });
}

// y at 0.01, 0.02, ... seconds.
Series everyStep(const std::string& label, const std::vector<double>& y) {
  Series series{.label = label, .y = y};
  for (std::size_t i = 1; i <= y.size(); ++i) series.x.push_back(kTau * static_cast<double>(i));
  return series;
}

// Four seconds of an arm under noise, with a push of 1 rad/s after one second; u(q, v, S) are the forces.
// Returns, for each step, the angle of the joint that is farthest from zero.
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
  const Eigen::VectorXd rest = 0 * q;
  return computedTorque(M, F, wantedAcceleration(q, v, {rest, rest, rest}, 0.2, 1));
}

// In real time: 30 frames a second.
void film(const Simulator& S, const std::string& name, const PictureOptions& look, int seconds) {
  writeVideo(S, name, look, 30 * seconds);
  writeContactSheet(S, name + "_sheet", look, 6, 30 * seconds);
}

// Skipped if all forces are zero: films of falling arms all look alike.
void film(const Simulator& S, const std::string& name, const PictureOptions& look, int seconds,
          const Eigen::VectorXd& forces) {
  if (!forces.isZero()) return film(S, name, look, seconds);
  std::cout << "no film " << name << ".mp4: all forces are still zero\n";
}

// The hand on a circle of 20 cm radius through its current position, once round in three seconds, from rest
// to rest.
PathPoint onCircle(const Eigen::Vector3d& start, double t) {
  const double pi = std::numbers::pi, w = pi / 3, angle = pi * (1 - std::cos(w * t));
  const double rate = pi * w * std::sin(w * t), growth = pi * w * w * std::cos(w * t);
  const Eigen::Vector3d out(0, std::sin(angle), std::cos(angle)), along(0, std::cos(angle), -std::sin(angle));
  return {start + 0.2 * (out - Eigen::Vector3d::UnitZ()), 0.2 * rate * along,
          0.2 * (growth * along - rate * rate * out)};
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

}  // namespace

void showRegimes(double mass) {
  std::vector<Series> ways, exactWays, phases;
  for (const auto& [name, regime] : kRegimes) {
    const PointMotion motion = reach(mass, regime, 1);
    const Gains gains = gainsFor(regime, 1, mass);
    ways.push_back(curve(name, motion));
    phases.push_back({.label = name, .x = motion.q, .y = motion.v});
    exactWays.push_back(dashed(motion.t, {}));
    for (const double time : motion.t)
      exactWays.back().y.push_back(pdResponse({mass}, {gains.Kp, gains.Kd}, {}, 1, time).q);
  }
  ways.insert(ways.end(), exactWays.begin(), exactWays.end());
  plotWay("regimes", "Three approaches to the goal in one second (dashed: exact motion)", ways, {{1, "T"}});
  Figure phase = overTime("The same approaches in phase space", "velocity [m/s]", phases);
  phase.xLabel = "position [m]";
  plot("phase", phase);
}

void showHorizons(double mass) {
  std::vector<Series> horizons;
  for (const int T : {1, 2, 5}) {
    const std::string label = "T = " + std::to_string(T) + " s";
    const Gains gains = gainsFor(Regime::kCritical, T, mass);
    horizons.push_back(curve(label, reach(mass, Regime::kCritical, T)));
    print("Kp, Kd for " + label, Eigen::RowVector2d(gains.Kp, gains.Kd));
  }
  plotWay("horizons", "Critically damped approaches in one, two and five seconds", horizons);
}

void showLoad(const PidSettings& pd, const PidSettings& pid, double mass) {
  plotWay("load", "Against a steady push of 10 N",
          {curve("PD", pidMotion(mass, pd, 8, -10, 0, false)),
           curve("PID", pidMotion(mass, pid, 8, -10, 0, false))});
}

void showIntegral(const PidSettings& alone, const PidSettings& damped, const PidSettings& all, double mass) {
  plotWay("integral", "The integral term without the other terms",
          {curve("Ki alone", pidMotion(mass, alone, 10, 0, 0, false)),
           curve("Ki and Kd", pidMotion(mass, damped, 10, 0, 0, false)),
           curve("all three", pidMotion(mass, all, 10, 0, 0, false))});
}

void showRestart(const PidSettings& pid, double mass) {
  plotWay("restart", "Held for three seconds, then released",
          {curve("integral kept", pidMotion(mass, pid, 12, 0, 3, false)),
           curve("integral restarted", pidMotion(mass, pid, 12, 0, 3, true))},
          {{3, "released"}});
}

void showKicks(double mass) {
  std::vector<Series> ways;
  for (const auto& [name, regime] : kRegimes) {
    Rng rng(3);
    PointState at{1, 0};
    PointMotion off;
    for (int step = 0; step <= 600; ++step) {
      const double time = kTau * step;
      if (step > 0 && step % 100 == 0) at.v += 0.1 * rng.normal();
      off.add({1e3 * (at.q - std::cos(time)), 0});
      at = eulerStep(at, followForce(at, time, mass, regime), mass, kTau);
    }
    ways.push_back(curve(name, off));
  }
  plot("kicks",
       overTime("Following a cosine, with a kick every second", "distance from the cosine [mm]", ways));
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
  const Eigen::Vector3d angles(0.1, 0.2, 0.3), rest(0, 0, 0);
  film(held, "hold", {.caption = "PD in each joint", .view = {1, -0.3, 0.3}}, 4, holdArm(angles, rest));
  film(known, "torque", {.caption = "Computed torque", .view = {1, -0.3, 0.3}}, 4,
       byComputedTorque(angles, rest, known));
}

void showHand() {
  Simulator S("pegArm2.ors");
  S.setJointAngles(kBent);
  S.clearRecording();
  const Eigen::Vector3d start = S.kinematicsPos("peg");
  Eigen::VectorXd forces;
  std::vector<double> error;
  std::vector<Eigen::Vector3d> circle;
  for (int step = 0; step < 300; ++step) {
    const PathPoint reference = onCircle(start, kTau * step);
    circle.emplace_back(reference.y);
    Simulator here = S;
    forces = followWithHand(here, "peg", reference);
    S.stepDynamics(forces, kTau);
    error.push_back(1e3 * (S.kinematicsPos("peg") - onCircle(start, kTau * (step + 1)).y).norm());
  }
  const Figure figure =
      overTime("The hand on its circle", "distance from its reference [mm]", {everyStep("", error)});
  const PictureOptions look{
      .caption = "Operational space control", .traces = {"peg"}, .paths = {circle}, .view = {1, -0.6, 0.4}};
  plot("hand", figure);
  film(S, "circle", look, 3, forces);
  if (!forces.isZero()) writeReplay(S, "circle", look, {figure}, 90);
}

void showNewtonEuler() {
  const Simulator S("pegArm2.ors");
  const std::vector<ChainLink> chain = chainOf(S.model());
  const auto [Q, V, A] = wideSwing();
  Eigen::MatrixXd byLibrary = Q;
  DynamicsWorkspace memory;
  inverseDynamicsBatch(S.model(), Q, V, A, earthGravity(), memory, byLibrary);
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
  print("M, G and C v of pegArm2, bent, with all joints turning at 1 rad/s", terms);
}

void showPin() {
  Simulator S("pin_balancing.ors");
  Eigen::VectorXd tilted = kPinUp;
  tilted[6] += 0.02;
  S.setJointAngles(tilted);
  S.clearRecording();
  Eigen::VectorXd forces;
  std::vector<double> tilt;
  for (int step = 0; step < 500; ++step) {
    Simulator here = S;
    forces = balancePin(here, kPinUp);
    S.stepDynamics(forces, kTau);
    tilt.push_back(std::acos(std::clamp(S.kinematicsVec("pin").z(), -1., 1.)));
  }
  plot("pin", overTime("A pin that starts at 0.02 rad", "tilt of the pin [rad]", {everyStep("", tilt)}));
  film(S, "pin", {.caption = "Balancing a pin", .traces = {"universalJoint"}, .view = {1, -1, 0.4}}, 5,
       forces);
}
