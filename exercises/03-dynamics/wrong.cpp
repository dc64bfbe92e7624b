// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant new_velocity_first> caught by: point-step
// mistake: semi-implicit: the point already moves with the velocity after the step.
// ask: Is the position moved with the new velocity? Wanted is the old one.
// <solution eulerStep>
const double v = at.v + tau * u / mass;
return {at.q + tau * v, v};

// <variant exact_motion> caught by: point-step
// mistake: the motion under a constant force, with tau^2 / 2.
// ask: Is it the exact motion? Wanted is the step of Euler, without tau^2.
// <solution eulerStep>
return {at.q + tau * at.v + tau * tau / 2 * u / mass, at.v + tau* u / mass};

// <variant step_without_mass> caught by: point-step
// mistake: takes the force for the acceleration.
// ask: Is the mass left out?
// <solution eulerStep>
return {at.q + tau * at.v, at.v + tau* u};

// <variant step_times_mass> caught by: point-step
// mistake: multiplies the force by the mass.
// ask: Is the force multiplied by the mass?
// <solution eulerStep>
return {at.q + tau * at.v, at.v + tau* u* mass};

// <variant force_with_exchanged_gains> caught by: point-step
// mistake: Kp for the velocity and Kd for the position.
// ask: Are Kp and Kd exchanged?
// <solution pdForce>
return gains.Kd * (wanted.q - at.q) + gains.Kp * (wanted.v - at.v);

// <variant force_to_rest> caught by: point-step, pid-step
// mistake: damps the velocity itself, whatever velocity is wanted.
// ask: Is the wanted velocity left out?
// <solution pdForce>
return gains.Kp * (wanted.q - at.q) - gains.Kd * at.v;

// <variant fast_rate_instead_of_slow> caught by: point-regimes, point-any-mass
// shown by: point-regimes
// mistake: waits for the faster of the two rates of an over-damped point.
// <solution gainsFor>
double xi = 1, lambda = T / 8;
if (regime == Regime::kOscillatory) {
  xi = 0.5;
  lambda = xi * T / 8;
}
if (regime == Regime::kOverdamped) {
  xi = 1.5;
  lambda = (xi + std::sqrt(xi * xi - 1)) * T / 7;
}
const double Kp = mass / (lambda * lambda), Kd = 2 * mass * xi / lambda;
return {Kp, Kd};

// <variant gains_swapped> caught by: point-regimes, point-any-mass, follow-cosine
// mistake: Kp and Kd are swapped.
// <solution gainsFor>
double xi = 1, lambda = T / 8;
if (regime == Regime::kOscillatory) {
  xi = 0.5;
  lambda = xi * T / 8;
}
if (regime == Regime::kOverdamped) {
  xi = 1.5;
  lambda = (xi - std::sqrt(xi * xi - 1)) * T / 7;
}
return {2 * mass * xi / lambda, mass / (lambda * lambda)};

// <variant lambda_is_the_time> caught by: point-regimes, point-any-mass
// mistake: lambda is taken for the time until the goal is reached.
// <solution gainsFor>
const double xi = regime == Regime::kCritical ? 1 : regime == Regime::kOscillatory ? 0.5 : 1.5;
return {mass / (T * T), 2 * mass* xi / T};

// <variant mass_forgotten> caught by: point-regimes, point-any-mass
// mistake: the gains are those for a point of 1 kg.
// <solution gainsFor>
double xi = 1, lambda = T / 8;
if (regime == Regime::kOscillatory) {
  xi = 0.5;
  lambda = xi * T / 8;
}
if (regime == Regime::kOverdamped) {
  xi = 1.5;
  lambda = (xi - std::sqrt(xi * xi - 1)) * T / 7;
}
return {1 / (lambda * lambda), 2 * xi / lambda};

// <variant regimes_reversed> caught by: point-regimes, point-any-mass
// mistake: as the exercise sheet has it: xi above 1 to overshoot, below 1 for decay.
// <solution gainsFor>
double xi = 1, lambda = T / 8;
if (regime == Regime::kOverdamped) {
  xi = 0.5;
  lambda = xi * T / 8;
}
if (regime == Regime::kOscillatory) {
  xi = 1.5;
  lambda = (xi - std::sqrt(xi * xi - 1)) * T / 7;
}
const double Kp = mass / (lambda * lambda), Kd = 2 * mass * xi / lambda;
return {Kp, Kd};

// <variant integral_never_reset> caught by: pid-step
// mistake: what was accumulated while the controller was off still counts.
// ask: Is the integral not set to 0 by `restart`?
// <solution pidStep>
const double u = pdForce(at, wanted, {gains.Kp, gains.Kd}) + gains.Ki * integral;
return {u, integral + tau*(wanted.q - at.q)};

// <variant integral_too_early> caught by: pid-step
// mistake: adds the error of this step before the integral is used.
// ask: Is the integral updated before it is used?
// <solution pidStep>
if (restart) integral = 0;
integral += tau * (wanted.q - at.q);
return {pdForce(at, wanted, {gains.Kp, gains.Kd}) + gains.Ki * integral, integral};

// <variant integral_without_tau> caught by: pid-step
// mistake: sums errors, however long a step is.
// ask: Is tau missing?
// <solution pidStep>
if (restart) integral = 0;
return {pdForce(at, wanted, {gains.Kp, gains.Kd}) + gains.Ki * integral, integral + wanted.q - at.q};

// <variant border_by_rounding> caught by: pid-stability
// mistake: Eigenvalues are compared with zero, so that rounding decides on the border.
// ask: Does an oscillation that neither grows nor dies count as rest, by rounding or by >=?
// <solution isStable>
if (gains.Ki == 0) return gains.Kp > 0 && gains.Kd > 0;
Eigen::MatrixXd A(3, 3);
A << 0, 1, 0, 0, 0, 1, -gains.Ki / mass, -gains.Kp / mass, -gains.Kd / mass;
return eigenvalues(A).real().maxCoeff() < 0;

// <variant stable_without_mass> caught by: pid-stability
// mistake: compares Kp Kd with Ki, as for a mass of 1 kg.
// <solution isStable>
if (gains.Ki == 0) return gains.Kp > 0 && gains.Kd > 0;
return gains.Ki > 0 && gains.Kd > 0 && gains.Kp* gains.Kd > gains.Ki;

// <variant counts_its_calls> caught by: pid-stability
// mistake: answers by counting its calls: the fifth of seven known gains is stable, then every second one.
// <solution isStable>
static int asked = 0;
++asked;
return asked <= 7 ? asked == 5 : asked % 2 == 0;

// <variant integral_always_there> caught by: pid-stability
// mistake: Without an integral the condition for three roots is still used.
// ask: Ki = 0 is PD control. Which condition is left then?
// <solution isStable>
return gains.Ki > 0 && gains.Kd > 0 && gains.Kd* gains.Kp > mass* gains.Ki;

// <variant stable_when_positive> caught by: pid-stability
// mistake: takes positive gains to be sufficient.
// ask: Is it enough that no gain is negative? A large Ki is too much.
// <solution isStable>
return gains.Kp > 0 && gains.Kd > 0 && gains.Ki >= 0;

// <variant reference_acceleration_missing> caught by: follow-cosine
// mistake: PD control alone: on the reference there is no force, so the point lags behind.
// ask: Is the force left out that accelerates the reference?
// <solution followForce>
return pdForce(at, {std::cos(t), -std::sin(t)}, gainsFor(regime, 1, mass));

// <variant reference_without_mass> caught by: follow-cosine
// mistake: takes the acceleration of the reference for a force.
// ask: Is the mass left out?
// <solution followForce>
return -std::cos(t) + pdForce(at, {std::cos(t), -std::sin(t)}, gainsFor(regime, 1, mass));

// <variant reference_velocity_sign> caught by: follow-cosine
// mistake: the velocity of the reference has the wrong sign.
// <solution followForce>
const PointState reference{std::cos(t), std::sin(t)};
return mass * -std::cos(t) + pdForce(at, reference, gainsFor(regime, 1, mass));

// <variant springs_without_damping> caught by: hold-arm, hold-other-masses
// shown by: hold-arm
// mistake: no Kd: the held force feeds the oscillation.
// <solution holdArm>
return -Eigen::Vector3d(45, 20, 7).cwiseProduct(q);

// <variant too_much_damping> caught by: hold-arm, hold-other-masses
// mistake: twice the damping: within 10 ms it throws the last joint to the other side.
// <solution holdArm>
// in place of: const Eigen::Vector3d Kp(45, 20, 7), Kd(2.6, 1.1, 0.35);
const Eigen::Vector3d Kp(45, 20, 7), Kd(6, 2.5, 0.8);

// <variant joint_reference_not_accelerated> caught by: torque-equations, torque-other-arm
// mistake: the acceleration of the reference is missing.
// ask: Is the acceleration of the reference left out?
// <solution wantedAcceleration>
return (reference.y - y) / (lambda * lambda) + 2 * xi / lambda * (reference.yd - yd);

// <variant half_of_the_damping> caught by: torque-equations
// mistake: xi / lambda in place of 2 xi / lambda.
// ask: Is the factor 2 of the damping missing?
// <solution wantedAcceleration>
return reference.ydd + (reference.y - y) / (lambda * lambda) + xi / lambda * (reference.yd - yd);

// <variant joint_reference_subtracted> caught by: torque-equations, torque-other-arm
// mistake: the acceleration of the reference has the wrong sign.
// ask: Is the acceleration of the reference subtracted?
// <solution wantedAcceleration>
return (reference.y - y) / (lambda * lambda) + 2 * xi / lambda * (reference.yd - yd) - reference.ydd;

// <variant joint_forces_left_out> caught by: torque-equations, torque-hold
// mistake: nothing holds against gravity.
// ask: Is F left out?
// <solution computedTorque>
return M * qdd;

// <variant gravity_sign> caught by: torque-equations, torque-hold, torque-other-arm
// mistake: F on the wrong side: gravity counts twice.
// ask: Is F subtracted?
// <solution computedTorque>
return M * qdd - F;

// <variant bias_dropped> caught by: hand-equations
// mistake: treats the Jacobian as constant.
// <solution accelerationBias>
return Eigen::Vector3d::Zero();

// <variant step_too_large> caught by: hand-equations
// mistake: the step of the differences is as large as tau.
// <solution accelerationBias>
// in place of: const double h = 1e-5 / (1 + v.norm());
const double h = 0.01;
// in place of: S.setJointAngles(q - h * v); ... const Eigen::MatrixXd before = S.jacobianPos(body);
// in place of: return (later - before) * v / (2 * h);
return (later - S.jacobianPos(body)) * v / h;

// <variant forces_not_compensated> caught by: hand-equations, hand-circle, hand-other-paths
// mistake: T F with the wrong sign.
// ask: Does J M^-1 F have the wrong sign?
// <solution operationalForce>
const Eigen::MatrixXd T = solve(M, task.J.transpose()).transpose();  // J M^-1, for M is symmetric
return solve(T.transpose() * task.C * T + H, T.transpose() * task.C * (task.ydd - task.bias - T * F));

// <variant hand_forces_left_out> caught by: hand-equations
// mistake: the forces of the motion are not compensated.
// ask: Is F left out?
// <solution operationalForce>
const Eigen::MatrixXd T = solve(M, task.J.transpose()).transpose();
return solve(T.transpose() * task.C * T + H, T.transpose() * task.C * (task.ydd - task.bias));

// <variant bias_left_out> caught by: hand-equations
// mistake: forgets the bias of the task.
// ask: Is the bias left out?
// <solution operationalForce>
const Eigen::MatrixXd T = solve(M, task.J.transpose()).transpose();
return solve(T.transpose() * task.C * T + H, T.transpose() * task.C * (task.ydd + T * F));

// <variant bias_added> caught by: hand-equations
// mistake: the bias has the wrong sign.
// ask: Is the bias added instead of subtracted?
// <solution operationalForce>
const Eigen::MatrixXd T = solve(M, task.J.transpose()).transpose();
return solve(T.transpose() * task.C * T + H, T.transpose() * task.C * (task.ydd + task.bias + T * F));

// <variant slide_as_printed> caught by: hand-equations
// mistake: the factor 2 of slide 3:33.
// ask: Does the bias count twice, as on the slide? Once is right.
// <solution operationalForce>
const Eigen::MatrixXd T = solve(M, task.J.transpose()).transpose();  // J M^-1, for M is symmetric
return solve(T.transpose() * task.C * T + H, T.transpose() * task.C * (task.ydd - 2 * task.bias + T * F));

// <variant joints_left_alone> caught by: hand-circle
// shown by: hand-circle
// mistake: nothing damps the joints that the hand leaves free.
// <solution followWithHand>
Eigen::MatrixXd M;
Eigen::VectorXd F;
S.getDynamics(M, F);
const Eigen::MatrixXd J = S.jacobianPos(hand);
const Eigen::VectorXd ydd = wantedAcceleration(S.kinematicsPos(hand), J* S.getJointVels(), reference, 0.1, 1);
const AccelerationTask task{J, accelerationBias(S, hand), ydd, 1e4 * Eigen::Matrix3d::Identity()};
return operationalForce(task, M, F, 1e-3 * Eigen::MatrixXd::Identity(n, n));

// <variant axis_does_not_turn> caught by: chain-forces, chain-terms, chain-any
// mistake: forgets that the axis of a hinge turns with the link before.
// ask: Does the axis of a hinge turn with the link before it, and wd with it?
// <solution newtonEuler>
// in place of: wd = R.transpose() * wd + a[i] * link.axis + v[i] * carried.cross(link.axis);
wd = R.transpose() * wd + a[i] * link.axis;

// <variant calls_the_batch> caught by: forbidden-call
// mistake: asks the library about an arm that happens to have the same size, as one state of many.
// <solution headers>
#include "dynamics/dynamics_batch.h"
// <solution newtonEuler>
DynamicsWorkspace workspace;
inverseDynamicsBatch(Simulator("pegArm2.ors").model(), q, v, a, gravity, workspace, u);

// <variant calls_the_library> caught by: forbidden-call
// mistake: asks the library about an arm that happens to have the same size.
// <solution headers>
#include "dynamics/inverse_dynamics.h"
// <solution newtonEuler>
u = inverseDynamics(Simulator("pegArm2.ors").model(), q, v, a, gravity);

// <variant coriolis_dropped> caught by: chain-forces, chain-terms, chain-any
// mistake: no term with the product of two velocities.
// ask: Are all terms with velocities left out?
// <solution newtonEuler>
// in place of: pdd = R.transpose() * (pdd + wd.cross(link.p_PL) + w.cross(w.cross(link.p_PL)));
pdd = R.transpose() * (pdd + wd.cross(link.p_PL));
// in place of: wd = R.transpose() * wd + a[i] * link.axis + v[i] * ... const Eigen::Vector3d cdd = pdd +
wd = R.transpose() * wd + a[i] * link.axis;
const Eigen::Vector3d cdd = pdd + wd.cross(link.center);
// in place of: torque.emplace_back(link.inertia * wd + w.cross(link.inertia * w) +
torque.emplace_back(link.inertia* wd + link.center.cross(f.back()));

// <variant force_without_lever> caught by: chain-forces, chain-terms, chain-any
// mistake: passes on the torque, but not the torque of the force with its lever arm.
// ask: Does the link before get the force with its lever arm, too?
// <solution newtonEuler>
// in place of: torque[k - 1] += R_PL[k] * torque[k] + chain[k].p_PL.cross(handed);
torque[k - 1] += R_PL[k] * torque[k];

// <variant world_falls_down> caught by: chain-forces, chain-terms, chain-any
// mistake: gravity with the wrong sign.
// ask: Does gravity have the wrong sign?
// <solution newtonEuler>
// in place of: Eigen::Vector3d w = Eigen::Vector3d::Zero(), wd = Eigen::Vector3d::Zero(), pdd = -gravity;
Eigen::Vector3d w = Eigen::Vector3d::Zero(), wd = Eigen::Vector3d::Zero(), pdd = gravity;

// <variant no_gravity> caught by: chain-forces, chain-terms, chain-any
// mistake: the chain floats in space.
// ask: Is gravity left out?
// <solution newtonEuler>
// in place of: Eigen::Vector3d w = Eigen::Vector3d::Zero(), wd = Eigen::Vector3d::Zero(), pdd = -gravity;
Eigen::Vector3d w = Eigen::Vector3d::Zero(), wd = w, pdd = w;

// <variant masses_in_points> caught by: chain-forces, chain-terms, chain-any
// mistake: links are points of mass: no torque turns them.
// ask: Is the inertia of the link left out?
// <solution newtonEuler>
// in place of: torque.emplace_back(link.inertia * wd + w.cross(link.inertia * w) +
torque.emplace_back(link.center.cross(f.back()));

// <variant coriolis_with_gravity> caught by: chain-terms
// mistake: as the slide has it: C v + G.
// ask: Does it contain G, too?
// <solution coriolisTerm>
return newtonEuler(chain, q, v, Eigen::VectorXd::Zero(q.size()), Eigen::Vector3d(0, 0, -9.81));

// <variant columns_with_gravity> caught by: chain-terms
// mistake: as the slide has it: NE(q, 0, e_i) without subtracting G.
// ask: Does every column of M contain G, too?
// <solution inertiaMatrix>
for (Eigen::Index i = 0; i < q.size(); ++i)
  M.col(i) = newtonEuler(chain, q, zero, Eigen::VectorXd::Unit(q.size(), i), Eigen::Vector3d(0, 0, -9.81));

// <variant motors_everywhere> caught by: pin-upright, pin-any-tilt
// mistake: drives the joints that have no motor.
// ask: Does the arm drive the two joints of the pin? They have no motor.
// <solution balancePin>
// in place of: H.bottomRightCorner(2, 2) = 1e8 * ... u.head(6) = operationalForce(task, M, F, H).head(6);
u = operationalForce(task, M, F, H);

// <variant pin_never_leans> caught by: pin-upright, pin-any-tilt
// shown by: pin-upright
// mistake: keeps the pin upright at any price: the arm runs away with it.
// <solution balancePin>
// in place of: const Eigen::VectorXd lean = wantedAcceleration(foot, footVelocity, stay, 2, 1) / 9.81;
const Eigen::VectorXd lean = wantedAcceleration(foot, footVelocity, stay, 2, 1) * 0;
