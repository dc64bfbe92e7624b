#include <cmath>

#include "exercise.h"
#include "show.h"
// <solution headers>
// What a mistake in wrong.cpp takes from the library.
// <todo>
// </solution>

using namespace rex;

PointState eulerStep(const PointState& at, double u, double mass, double tau) {
  // <solution eulerStep>
  return {at.q + tau * at.v, at.v + tau * u / mass};
  // <todo>
  //| // TODO: both rows of the system equation, with what is known before the step.
  //| return at;
  // </solution>
}

double pdForce(const PointState& at, const PointState& wanted, const Gains& gains) {
  // <solution pdForce>
  return gains.Kp * (wanted.q - at.q) + gains.Kd * (wanted.v - at.v);
  // <todo>
  //| // TODO: slide 3:10.
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
  //| return true;
  // </solution>
}

double followForce(const PointState& at, double t, double mass, Regime regime) {
  // <solution followForce>
  const PointState reference{std::cos(t), -std::sin(t)};
  return mass * -std::cos(t) + pdForce(at, reference, gainsFor(regime, 1, mass));
  // <todo>
  //| // TODO: which force does a point need that is on the reference already? And what if it is not?
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
  //| return Eigen::VectorXd::Zero(q.size());
  // </solution>
}

Eigen::VectorXd wantedAcceleration(const Eigen::VectorXd& y, const Eigen::VectorXd& yd,
                                   const PathPoint& reference, double lambda, double xi) {
  // <solution wantedAcceleration>
  return reference.ydd + (reference.y - y) / (lambda * lambda) + 2 * xi / lambda * (reference.yd - yd);
  // <todo>
  //| // TODO: the last line of slide 3:30.
  //| return Eigen::VectorXd::Zero(y.size());
  // </solution>
}

Eigen::VectorXd computedTorque(const Eigen::MatrixXd& M, const Eigen::VectorXd& F,
                               const Eigen::VectorXd& qdd) {
  // <solution computedTorque>
  return M * qdd + F;
  // <todo>
  //| // TODO: inverse dynamics of slide 3:29.
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
  //| // TODO: move S to q + h qdot, then to q - h qdot, for a small h. How much does J change?
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
  //| // does that take? Then from the last to the first: which link passes them on, and what does the hinge
  //| // feel?
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
  //| return Eigen::VectorXd::Zero(q.size());
  // </solution>
}

Eigen::VectorXd coriolisTerm(const std::vector<ChainLink>& chain, const Eigen::VectorXd& q,
                             const Eigen::VectorXd& v) {
  // <solution coriolisTerm>
  return newtonEuler(chain, q, v, Eigen::VectorXd::Zero(q.size()), Eigen::Vector3d::Zero());
  // <todo>
  //| // TODO: slide 3:24, without the gravity that is in its second line.
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
  //| // TODO: slide 3:24 once more, column by column, without the gravity that is in its third line.
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
  // </solution>
  return u;
}

// What follows is given: the parts of the exercise one after another. show.cpp draws the pictures.
int main() {
  const double mass = 3.456;  // kg

  // Part 1: a point gets from rest at 0 to 1 m in one second, in three ways; then critically damped, in one,
  // two and five seconds.
  showRegimes(mass);
  showHorizons(mass);

  // Part 2: PD and PID against a steady push; Ki without Kp; an integral that should be restarted.
  const PidSettings pd{60, 0, 25}, pid{60, 40, 25}, alone{0, 2, 0}, damped{0, 2, 2}, all{10, 4, 8};
  showLoad(pd, pid, mass);
  showIntegral(alone, damped, all, mass);
  showRestart(pid, mass);
  for (const PidSettings& gains : {alone, damped, all})
    print("Kp, Ki, Kd and whether stable",
          Eigen::RowVector4d(gains.Kp, gains.Ki, gains.Kd, isStable(gains, mass) ? 1 : 0));

  // Part 3: following cos t, with a kick every second.
  showKicks(mass);

  // Parts 4 and 5: an arm without forces; arms with PD control in each joint, and with computed torque.
  showFall();
  showArms();

  // Part 5: the forces that keep an arm at rest where it is.
  Simulator S("pegArm.ors");
  const Eigen::Vector3d q(0.6, -0.2, 0.4);
  S.setJointAngles(q);
  Eigen::MatrixXd M;
  Eigen::VectorXd F;
  S.getDynamics(M, F);
  print("F of the arm at rest", F);
  print("forces for no acceleration, which should be the same",
        computedTorque(M, F, Eigen::Vector3d::Zero()));

  // Part 6: a hand on a circle, once round in three seconds.
  showHand();

  // Part 7: the forces of a swing, and the terms of slide 3:24 in one posture.
  showNewtonEuler();

  // Part 8: five seconds of a pin that starts at 0.02 rad.
  showPin();
}
