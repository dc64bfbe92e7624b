#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/inverse_dynamics.h"
#include "exercise.h"
#include "scene/model.h"

using namespace rex;

PointState eulerStep(const PointState& at, double u, double mass, double tau) {
  // TODO: both rows of the system equation, with what is known before the step.
  static_cast<void>(u);
  static_cast<void>(mass);
  static_cast<void>(tau);
  return at;
}

double pdForce(const PointState& at, const PointState& wanted, const Gains& gains) {
  // TODO: slide 3:10.
  static_cast<void>(at);
  static_cast<void>(wanted);
  static_cast<void>(gains);
  return 0;
}

Gains gainsFor(Regime regime, double T, double mass) {
  // TODO: choose xi for the regime, then lambda for T, and compute the gains from both (3:14).
  static_cast<void>(regime);
  static_cast<void>(T);
  static_cast<void>(mass);
  return {};
}

PidStep pidStep(const PointState& at, const PointState& wanted, const PidGains& gains, double integral,
                double tau, bool restart) {
  // TODO: slide 3:16. What does the integral start from when the controller is switched on?
  static_cast<void>(at);
  static_cast<void>(wanted);
  static_cast<void>(gains);
  static_cast<void>(tau);
  static_cast<void>(restart);
  return {0, integral};
}

bool isStable(const PidGains& gains, double mass) {
  // TODO: insert q = q* + exp(s t) into the differential equation. Where must all s lie?
  static_cast<void>(gains);
  static_cast<void>(mass);
  return true;
}

double followForce(const PointState& at, double t, double mass, Regime regime) {
  // TODO: which force does a point need that is on the reference already? And what if it is not?
  static_cast<void>(at);
  static_cast<void>(t);
  static_cast<void>(mass);
  static_cast<void>(regime);
  return 0;
}

Eigen::VectorXd holdArm(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  // TODO: gains for each of the three joints. Let main() show you what they do.
  static_cast<void>(v);
  return Eigen::VectorXd::Zero(q.size());
}

Eigen::VectorXd wantedAcceleration(const Eigen::VectorXd& y, const Eigen::VectorXd& yd,
                                   const Reference& reference, double lambda, double xi) {
  // TODO: the last line of slide 3:30.
  static_cast<void>(yd);
  static_cast<void>(reference);
  static_cast<void>(lambda);
  static_cast<void>(xi);
  return Eigen::VectorXd::Zero(y.size());
}

Eigen::VectorXd computedTorque(const Eigen::MatrixXd& M, const Eigen::VectorXd& F,
                               const Eigen::VectorXd& qdd) {
  // TODO: inverse dynamics of slide 3:29.
  static_cast<void>(F);
  static_cast<void>(qdd);
  return Eigen::VectorXd::Zero(M.rows());
}

Eigen::Vector3d accelerationBias(Simulator& S, const std::string& body) {
  // TODO: S can take postures a little later and a little earlier. How much does J differ?
  static_cast<void>(S);
  static_cast<void>(body);
  return Eigen::Vector3d::Zero();
}

Eigen::VectorXd operationalForce(const AccelerationTask& task, const Eigen::MatrixXd& M,
                                 const Eigen::VectorXd& F, const Eigen::MatrixXd& H) {
  // TODO: slide 3:33, with the bias once, not twice. solve(A, B) gives the X with A X = B.
  static_cast<void>(task);
  static_cast<void>(M);
  static_cast<void>(H);
  return Eigen::VectorXd::Zero(F.size());
}

Eigen::VectorXd followWithHand(Simulator& S, const std::string& hand, const Reference& reference) {
  const int n = S.getJointDimension();
  // TODO: an AccelerationTask for the hand, and its force. What do the joints do that the hand leaves
  // free? Slide 3:35: a task may be made of two, one below the other.
  static_cast<void>(hand);
  static_cast<void>(reference);
  return Eigen::VectorXd::Zero(n);
}

Eigen::VectorXd newtonEuler(const std::vector<Link>& chain, const Eigen::VectorXd& q,
                            const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                            const Eigen::Vector3d& gravity) {
  const auto n = static_cast<Eigen::Index>(chain.size());
  Eigen::VectorXd u = Eigen::VectorXd::Zero(n);
  // TODO: from the first link to the last: how does it turn and accelerate, and which force and torque
  // does that take? Then from the last to the first: who hands them on, and what does the hinge feel?
  static_cast<void>(q);
  static_cast<void>(v);
  static_cast<void>(a);
  static_cast<void>(gravity);
  return u;
}

Eigen::VectorXd gravityTerm(const std::vector<Link>& chain, const Eigen::VectorXd& q,
                            const Eigen::Vector3d& gravity) {
  // TODO: slide 3:24.
  static_cast<void>(chain);
  static_cast<void>(gravity);
  return Eigen::VectorXd::Zero(q.size());
}

Eigen::VectorXd coriolisTerm(const std::vector<Link>& chain, const Eigen::VectorXd& q,
                             const Eigen::VectorXd& v) {
  // TODO: slide 3:24, without the gravity that is in its second line.
  static_cast<void>(chain);
  static_cast<void>(v);
  return Eigen::VectorXd::Zero(q.size());
}

Eigen::MatrixXd inertiaMatrix(const std::vector<Link>& chain, const Eigen::VectorXd& q) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(q.size());
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(q.size(), q.size());
  // TODO: slide 3:24 once more, column by column; what does gravity have to be?
  static_cast<void>(chain);
  return M;
}

Eigen::VectorXd balancePin(Simulator& S, const Eigen::VectorXd& home) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(8);
  // TODO: the tilt of the pin is a task for the six joints with a motor. Which H keeps the others out?
  // Where does the arm go if it does nothing but keep the pin upright, and how can the pin bring it back?
  static_cast<void>(S);
  static_cast<void>(home);
  return u;
}

// From here on everything is given: the parts of the exercise one after another, with pictures. Change it as
// you like.

namespace {

constexpr double kTau = 0.01, kMass = 3.456;
const Eigen::Vector3d kGravity(0, 0, -9.81);
const Eigen::VectorXd kBent =
    (Eigen::VectorXd(7) << 0.58, -0.15, -0.71, 0.89, 0.85, 0.13, -1.58).finished();  // of pegArm2
const Eigen::VectorXd kPinUp =
    (Eigen::VectorXd(8) << 0, 1.0472, 1.0472, 0.523599, 0, 0, 2.34565, 0.00194306).finished();

struct NamedRegime {
  std::string name;
  Regime regime;
};
const std::vector<NamedRegime> kRegimes = {{"oscillatory", Regime::kOscillatory},
                                           {"critical", Regime::kCritical},
                                           {"over-damped", Regime::kOverdamped}};

// A simulated point: its state after 0, 1, 2, ... steps.
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
PointMotion simulate(PointState at, double seconds, const Force& u) {
  PointMotion motion;
  for (motion.add(at); motion.t.back() < seconds; motion.add(at))
    at = eulerStep(at, u(at, motion.t.back()), kMass, kTau);
  return motion;
}

PointMotion reach(Regime regime, double T) {
  const Gains gains = gainsFor(regime, T, kMass);
  return simulate({}, 1.5 * T, [&](const PointState& at, double) { return pdForce(at, {1, 0}, gains); });
}

void showPoint() {
  Figure time{.title = "Three ways to reach the goal in one second",
              .xLabel = "time [s]",
              .yLabel = "position [m]",
              .legend = Legend::kBottomRight,
              .verticalLines = {{1, "T"}},
              .horizontalLines = {{1, "goal"}}};
  Figure phase{.title = "The same ways in phase space",
               .xLabel = "position [m]",
               .yLabel = "velocity [m/s]",
               .legend = Legend::kTopRight};
  for (const auto& [name, regime] : kRegimes) {
    const PointMotion motion = reach(regime, 1);
    time.series.push_back({.label = name, .x = motion.t, .y = motion.q});
    phase.series.push_back({.label = name, .x = motion.q, .y = motion.v});
  }
  plot("regimes", time);
  plot("phase", phase);
  Figure horizons{.title = "Critically damped, in one, two and five seconds",
                  .xLabel = "time [s]",
                  .yLabel = "position [m]",
                  .legend = Legend::kBottomRight,
                  .horizontalLines = {{1, "goal"}}};
  for (const int T : {1, 2, 5}) {
    const PointMotion motion = reach(Regime::kCritical, T);
    const Gains gains = gainsFor(Regime::kCritical, T, kMass);
    horizons.series.push_back({.label = "T = " + std::to_string(T) + " s", .x = motion.t, .y = motion.q});
    print("Kp, Kd for T = " + std::to_string(T) + " s", Eigen::RowVector2d(gains.Kp, gains.Kd));
  }
  plot("horizons", horizons);
}

// PID control of a point to 1 m against a steady push [N]. Until `released` it is held where it is, but the
// controller works on; then it is switched on anew, or not.
PointMotion pidMotion(const PidGains& gains, double seconds, double push, double released, bool restart) {
  double integral = 0;
  return simulate({}, seconds, [&](const PointState& at, double t) {
    const bool first = t < 0.5 * kTau || (restart && std::abs(t - released) < 0.5 * kTau);
    const PidStep step = pidStep(at, {1, 0}, gains, integral, kTau, first);
    integral = step.integral;
    return t < released - 0.5 * kTau ? 0 : step.u + push;
  });
}

void showPid() {
  const PidGains pd{60, 25, 0}, pid{60, 25, 40};
  const auto curve = [](const std::string& label, const PointMotion& motion) {
    return Series{.label = label, .x = motion.t, .y = motion.q};
  };
  plot("load", {.title = "Against a steady push of 10 N",
                .xLabel = "time [s]",
                .yLabel = "position [m]",
                .legend = Legend::kBottomRight,
                .series = {curve("PD", pidMotion(pd, 8, -10, 0, false)),
                           curve("PID", pidMotion(pid, 8, -10, 0, false))},
                .horizontalLines = {{1, "goal"}}});
  plot("integral", {.title = "What an integral does without the others",
                    .xLabel = "time [s]",
                    .yLabel = "position [m]",
                    .legend = Legend::kTopLeft,
                    .series = {curve("Ki alone", pidMotion({0, 0, 2}, 6, 0, 0, false)),
                               curve("Ki and Kd", pidMotion({0, 2, 2}, 6, 0, 0, false)),
                               curve("all three", pidMotion({10, 8, 4}, 6, 0, 0, false))},
                    .horizontalLines = {{1, "goal"}}});
  plot("restart", {.title = "Held for three seconds, then released",
                   .xLabel = "time [s]",
                   .yLabel = "position [m]",
                   .legend = Legend::kBottomRight,
                   .series = {curve("integral kept", pidMotion(pid, 12, 0, 3, false)),
                              curve("integral restarted", pidMotion(pid, 12, 0, 3, true))},
                   .verticalLines = {{3, "released"}},
                   .horizontalLines = {{1, "goal"}}});
  for (const PidGains& gains : {PidGains{0, 0, 2}, PidGains{0, 2, 2}, PidGains{10, 8, 4}})
    print("Kp, Kd, Ki and whether stable",
          Eigen::RowVector4d(gains.Kp, gains.Kd, gains.Ki, isStable(gains, kMass) ? 1 : 0));
}

void showFollowing() {
  Figure way{.title = "Following a cosine, with a kick every second",
             .xLabel = "time [s]",
             .yLabel = "position [m]",
             .legend = Legend::kBottomRight};
  Figure error = way;
  error.title = "The way back after each kick";
  error.yLabel = "distance from the reference [mm]";
  for (const auto& [name, regime] : kRegimes) {
    Rng rng(3);
    PointState at{1, 0};
    PointMotion motion, off;
    for (int step = 0; step <= 600; ++step) {
      const double t = kTau * step;
      if (step > 0 && step % 100 == 0) at.v += 0.1 * rng.normal();
      motion.add(at);
      off.add({1e3 * (at.q - std::cos(t)), 0});
      at = eulerStep(at, followForce(at, t, kMass, regime), kMass, kTau);
    }
    way.series.push_back({.label = name, .x = motion.t, .y = motion.q});
    error.series.push_back({.label = name, .x = off.t, .y = off.q});
  }
  std::vector<double> t, reference;
  for (int step = 0; step <= 600; ++step) {
    t.push_back(kTau * step);
    reference.push_back(std::cos(t.back()));
  }
  way.series.push_back({.label = "cos t", .x = t, .y = reference, .dashed = true});
  plot("following", way);
  plot("kicks", error);
}

// Four seconds of an arm, with a push of 1 rad/s after one: u(q, v, S) are the forces. Returns the
// angle of the joint that is farthest from zero.
template <class Force>
std::vector<double> swing(Simulator& S, double noise, const Force& u) {
  S.setDynamicSimulationNoise(noise);
  std::vector<double> farthest;
  for (int step = 0; step < 400; ++step) {
    const Eigen::VectorXd q = S.getJointAngles();
    if (noise > 0 && step == 100)
      S.setJointAnglesAndVels(q, S.getJointVels() + Eigen::VectorXd::Ones(q.size()));
    S.stepDynamics(u(q, S.getJointVels(), S), kTau);
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

std::vector<double> seconds(std::size_t count) {
  std::vector<double> t;
  for (std::size_t i = 1; i <= count; ++i) t.push_back(kTau * static_cast<double>(i));
  return t;
}

void film(const Simulator& S, const std::string& name, const PictureOptions& look) {
  writeVideo(S, name, look);
  writeContactSheet(S, name + "_sheet", look);
}

// Falling freely, an arm keeps its energy; only the simulation does not quite.
void showFall() {
  Simulator falling("pegArm.ors");
  const double atFirst = falling.getEnergy();
  std::vector<double> drift;
  swing(falling, 0, [&](const Eigen::VectorXd& q, const Eigen::VectorXd&, const Simulator& S) {
    drift.push_back(1e6 * (S.getEnergy() - atFirst));
    return Eigen::VectorXd::Zero(q.size()).eval();
  });
  plot("energy", {.title = "Energy of a falling arm, by Runge and Kutta",
                  .xLabel = "time [s]",
                  .yLabel = "energy gained [uJ]",
                  .legend = Legend::kNone,
                  .series = {{.x = seconds(drift.size()), .y = drift}}});
  film(falling, "fall", {.caption = "Without forces", .traces = {"peg"}, .view = {1, -0.3, 0.3}});
}

void showArms() {
  Simulator held("pegArm.ors"), known("pegArm.ors"), known2("pegArm2.ors");
  const auto byPd = [](const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Simulator&) {
    return holdArm(q, v);
  };
  const std::vector<double> heldAngles = swing(held, 1, byPd),
                            knownAngles = swing(known, 1, byComputedTorque),
                            knownAngles2 = swing(known2, 1, byComputedTorque);
  plot("holding", {.title = "Holding arms at zero, under noise and a push",
                   .xLabel = "time [s]",
                   .yLabel = "joint farthest from zero [rad]",
                   .legend = Legend::kOutside,
                   .series = {{.label = "PD, pegArm", .x = seconds(400), .y = heldAngles},
                              {.label = "M and F, pegArm", .x = seconds(400), .y = knownAngles},
                              {.label = "M and F, pegArm2", .x = seconds(400), .y = knownAngles2}},
                   .verticalLines = {{1, "push"}}});
  const Eigen::Vector3d side(1, -0.3, 0.3);
  film(held, "hold", {.caption = "PD in each joint", .view = side});
  film(known, "torque", {.caption = "Computed torque", .view = side});
}

// The hand on a circle of 20 cm radius from where it is, once round in three seconds, from rest to rest.
Reference onCircle(const Eigen::Vector3d& start, double t) {
  const double w = std::numbers::pi / 3, angle = std::numbers::pi * (1 - std::cos(w * t));
  const double rate = std::numbers::pi * w * std::sin(w * t),
               growth = std::numbers::pi * w * w * std::cos(w * t);
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
    const Reference reference = onCircle(start, kTau * step);
    error.push_back(1e3 * (S.kinematicsPos("peg") - reference.y).norm());
    circle.emplace_back(reference.y);
    Simulator here = S;
    S.stepDynamics(followWithHand(here, "peg", reference), kTau);
  }
  const Figure figure{.title = "The hand on its circle",
                      .xLabel = "time [s]",
                      .yLabel = "distance from the reference [mm]",
                      .legend = Legend::kNone,
                      .series = {{.x = seconds(error.size()), .y = error}}};
  const PictureOptions look{
      .caption = "Operational space control", .traces = {"peg"}, .paths = {circle}, .view = {1, -0.6, 0.4}};
  plot("hand", figure);
  film(S, "circle", look);
  writeReplay(S, "circle", look, {figure});
}

// A chain for newtonEuler(): the frame of each link is that of its hinge.
std::vector<Link> chainOf(const Model& model) {
  std::vector<Link> chain;
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

// A swing of pegArm2 through both sides of zero.
struct Swing {
  Eigen::VectorXd q, v, a;
};
Swing swingAt(double t) {
  const Eigen::VectorXd far = Eigen::VectorXd::LinSpaced(7, 1.2, -0.8);
  return {std::sin(2 * t) * far, 2 * std::cos(2 * t) * far, -4 * std::sin(2 * t) * far};
}

// `byLibrary` are its forces at t = 0.01, 0.02, ... seconds of the swing.
void showNewtonEuler(const std::vector<Link>& chain, const std::vector<Eigen::VectorXd>& byLibrary) {
  Figure figure{.title = "The forces of a swing of pegArm2: yours, and the library's (dashed)",
                .xLabel = "time [s]",
                .yLabel = "joint force [N m]",
                .legend = Legend::kOutside};
  const std::vector<double> t = seconds(byLibrary.size());
  for (const int joint : {0, 2, 4}) {
    Series yours{.label = "joint " + std::to_string(joint + 1), .x = t}, library{.x = t, .dashed = true};
    for (std::size_t i = 0; i < t.size(); ++i) {
      const auto [q, v, a] = swingAt(t[i]);
      yours.y.push_back(newtonEuler(chain, q, v, a, kGravity)[joint]);
      library.y.push_back(byLibrary[i][joint]);
    }
    library.color = Color{0, 0, 0};
    figure.series.insert(figure.series.begin() + joint / 2, yours);
    figure.series.push_back(library);
  }
  plot("newtonEuler", figure);
  print("M of pegArm2 when bent", inertiaMatrix(chain, kBent));
  print("G", gravityTerm(chain, kBent, kGravity));
  print("C v when all joints turn at 1 rad/s", coriolisTerm(chain, kBent, Eigen::VectorXd::Ones(7)));
}

void showPin() {
  Simulator S("pin_balancing.ors");
  Eigen::VectorXd q = kPinUp;
  q[6] += 0.05;
  S.setJointAngles(q);
  S.clearRecording();
  std::vector<double> tilt;
  for (int step = 0; step < 500; ++step) {
    tilt.push_back(std::acos(std::clamp(S.kinematicsVec("pin").z(), -1., 1.)));
    Simulator here = S;
    S.stepDynamics(balancePin(here, kPinUp), kTau);
  }
  const Figure figure{.title = "A pin that started at 0.05 rad",
                      .xLabel = "time [s]",
                      .yLabel = "tilt of the pin [rad]",
                      .legend = Legend::kNone,
                      .series = {{.x = seconds(tilt.size()), .y = tilt}}};
  plot("pin", figure);
  film(S, "pin", {.caption = "Balancing a pin", .traces = {"universalJoint"}, .view = {1, -1, 0.4}});
}

}  // namespace

int main() {
  showPoint();
  showPid();
  showFollowing();
  showFall();
  showArms();
  showHand();
  showPin();

  // Once your own recursion works, it lies on the library's.
  const Simulator S("pegArm2.ors");
  std::vector<Eigen::VectorXd> byLibrary;
  for (const double t : seconds(300)) {
    const auto [q, v, a] = swingAt(t);
    byLibrary.push_back(inverseDynamics(S.model(), q, v, a, kGravity));
  }
  showNewtonEuler(chainOf(S.model()), byLibrary);
}
