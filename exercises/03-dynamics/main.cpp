#include <cmath>

#include "exercise.h"
#include "show.h"

using namespace rex;

PointState eulerStep(const PointState& at, double u, double mass, double tau) {
  // TODO: both rows of the system equation, with what is known before the step.
  return at;
}

double pdForce(const PointState& at, const PointState& wanted, const Gains& gains) {
  // TODO: slide 3:10.
  return 0;
}

Gains gainsFor(Regime regime, double T, double mass) {
  // TODO: choose xi for the regime, then lambda for T, and compute the gains from both (3:14).
  return {};
}

PidStep pidStep(const PointState& at, const PointState& wanted, const PidSettings& gains, double integral,
                double tau, bool restart) {
  // TODO: slide 3:16. What does the integral start from when the controller is switched on?
  return {0, integral};
}

bool isStable(const PidSettings& gains, double mass) {
  // TODO: insert q = q* + exp(s t) into the differential equation. Where must all s lie?
  return true;
}

double followForce(const PointState& at, double t, double mass, Regime regime) {
  // TODO: which force does a point need that is on the reference already? And what if it is not?
  return 0;
}

Eigen::VectorXd holdArm(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  // TODO: gains for each of the three joints. Let main() show you what they do.
  return Eigen::VectorXd::Zero(q.size());
}

Eigen::VectorXd wantedAcceleration(const Eigen::VectorXd& y, const Eigen::VectorXd& yd,
                                   const PathPoint& reference, double lambda, double xi) {
  // TODO: the last line of slide 3:30.
  return Eigen::VectorXd::Zero(y.size());
}

Eigen::VectorXd computedTorque(const Eigen::MatrixXd& M, const Eigen::VectorXd& F,
                               const Eigen::VectorXd& qdd) {
  // TODO: inverse dynamics of slide 3:29.
  return Eigen::VectorXd::Zero(M.rows());
}

Eigen::Vector3d accelerationBias(Simulator& S, const std::string& body) {
  // TODO: move S to q + h qdot, then to q - h qdot, for a small h. How much does J change?
  return Eigen::Vector3d::Zero();
}

Eigen::VectorXd operationalForce(const AccelerationTask& task, const Eigen::MatrixXd& M,
                                 const Eigen::VectorXd& F, const Eigen::MatrixXd& H) {
  // TODO: slide 3:33, with the bias once, not twice. solve(A, B) gives the X with A X = B.
  return Eigen::VectorXd::Zero(F.size());
}

Eigen::VectorXd followWithHand(Simulator& S, const std::string& hand, const PathPoint& reference) {
  const int n = S.getJointDimension();
  // TODO: an AccelerationTask for the hand, and its force. What do the joints do that the hand leaves
  // free? Slide 3:35: a task may be made of two, one below the other.
  return Eigen::VectorXd::Zero(n);
}

Eigen::VectorXd newtonEuler(const std::vector<ChainLink>& chain, const Eigen::VectorXd& q,
                            const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                            const Eigen::Vector3d& gravity) {
  const auto n = static_cast<Eigen::Index>(chain.size());
  Eigen::VectorXd u = Eigen::VectorXd::Zero(n);
  // TODO: from the first link to the last: how does it turn and accelerate, and which force and torque
  // does that take? Then from the last to the first: which link passes them on, and what does the hinge
  // feel?
  return u;
}

Eigen::VectorXd gravityTerm(const std::vector<ChainLink>& chain, const Eigen::VectorXd& q,
                            const Eigen::Vector3d& gravity) {
  // TODO: slide 3:24.
  return Eigen::VectorXd::Zero(q.size());
}

Eigen::VectorXd coriolisTerm(const std::vector<ChainLink>& chain, const Eigen::VectorXd& q,
                             const Eigen::VectorXd& v) {
  // TODO: slide 3:24, without the gravity that is in its second line.
  return Eigen::VectorXd::Zero(q.size());
}

Eigen::MatrixXd inertiaMatrix(const std::vector<ChainLink>& chain, const Eigen::VectorXd& q) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(q.size());
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(q.size(), q.size());
  // TODO: slide 3:24 once more, column by column, without the gravity that is in its third line.
  return M;
}

Eigen::VectorXd balancePin(Simulator& S, const Eigen::VectorXd& home) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(8);
  // TODO: the tilt of the pin is a task for the six joints with a motor. Which H keeps the others out?
  // Where does the arm go if it does nothing but keep the pin upright, and how can the pin bring it back?
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
