// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant gaze_in_body_frame> caught by: look-at-zero, maps-other-robot
// mistake: The gaze is given in the body's frame, but the direction to the target in the world's.
// ask: Is the direction in the body's frame used as one in the world?
// <solution lookAt>
// in place of: return {S.kinematicsVec(body, gaze) - toTarget, S.jacobianVec(body, gaze) + across *
return {gaze - toTarget, across* S.jacobianPos(body)};

// <variant nothing_yet> caught by: look-at-zero
// mistake: as it was handed out.
// <solution lookAt>
return {Eigen::Vector3d::Zero(), Eigen::MatrixXd::Zero(3, S.getJointDimension())};

// <variant looks_away_too> caught by: look-at-zero
// mistake: The cross product of gaze and direction is zero also when the body looks away from the target.
// ask: Is it a cross product, or a square? These are zero there, too.
// <solution lookAt>
// in place of: return {S.kinematicsVec(body, gaze) - toTarget, S.jacobianVec(body, gaze) + across *
const Eigen::Vector3d seen = S.kinematicsVec(body, gaze);
const auto crossMatrix = [](const Eigen::Vector3d& w) {
  return (Eigen::Matrix3d() << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0).finished();
};
const Eigen::MatrixXd J =
    -crossMatrix(toTarget) * S.jacobianVec(body, gaze) - crossMatrix(seen) * across * S.jacobianPos(body);
return {crossMatrix(seen) * toTarget, J};

// <variant posture_for_a_map>
// caught by: look-at-jacobian, palms-jacobian, distance-jacobian, maps-other-robot
// mistake: the posture is a function of q with a simple Jacobian, but says nothing about the task.
// <solution lookAt>
return {S.getJointAngles(), Eigen::MatrixXd::Identity(S.getJointDimension(), S.getJointDimension())};
// <solution opposePalms>
return {S.getJointAngles(), Eigen::MatrixXd::Identity(S.getJointDimension(), S.getJointDimension())};
// <solution distanceToGoal>
return {S.getJointAngles().head(1), Eigen::MatrixXd::Identity(1, S.getJointDimension())};

// <variant sign_flipped_jacobian> caught by: look-at-jacobian
// mistake: The direction to the target turns the other way: that part of the Jacobian has the wrong sign.
// ask: Does the part with jacobianPos have the wrong sign?
// <solution lookAt>
// in place of: return {S.kinematicsVec(body, gaze) - toTarget, S.jacobianVec(body, gaze) + across *
return {S.kinematicsVec(body, gaze) - toTarget, S.jacobianVec(body, gaze) - across* S.jacobianPos(body)};

// <variant sum_of_differences> caught by: look-at-zero
// mistake: Differences of either sign can add up to zero although none of them is zero.
// ask: Can parts of either sign cancel in it?
// <solution lookAt>
// in place of: return {S.kinematicsVec(body, gaze) - toTarget, S.jacobianVec(body, gaze) + across *
const Eigen::MatrixXd J = S.jacobianVec(body, gaze) + across * S.jacobianPos(body);
return {Eigen::VectorXd::Constant(1, (S.kinematicsVec(body, gaze) - toTarget).sum()), J.colwise().sum()};

// <variant two_coordinates_only> caught by: look-at-zero
// mistake: Two coordinates of a direction leave the sign of the third open: a mirror image gives zero too.
// ask: Is a coordinate of the direction left out?
// <solution lookAt>
// in place of: return {S.kinematicsVec(body, gaze) - toTarget, S.jacobianVec(body, gaze) + across *
const Eigen::MatrixXd J = S.jacobianVec(body, gaze) + across * S.jacobianPos(body);
return {(S.kinematicsVec(body, gaze) - toTarget).head(2), J.topRows(2)};

// <variant palms_in_same_direction> caught by: palms-zero
// mistake: The difference of the palms is zero when they point the same way, as for two hands on a table.
// ask: It is zero with palms that point in the same direction: does a sign differ?
// <solution opposePalms>
return {S.kinematicsVec(left, palm) - S.kinematicsVec(right, palm),
        S.jacobianVec(left, palm) - S.jacobianVec(right, palm)};

// <variant distance_changes_sign> caught by: distance-zero, maps-other-robot
// mistake: The sum of the differences is one number, but zero on a whole plane through the goal.
// ask: Can differences of either sign cancel in it?
// <solution distanceToGoal>
const Eigen::Vector3d away = S.kinematicsPos(body) - goal;
return {Eigen::VectorXd::Constant(1, away.sum()), S.jacobianPos(body).colwise().sum()};

// <variant distance_not_a_number> caught by: distance-zero
// mistake: The derivative of the distance divides by the distance, which is zero at the goal.
// <solution distanceToGoal>
const Eigen::Vector3d away = S.kinematicsPos(body) - goal;
return {Eigen::VectorXd::Constant(1, away.norm()), away.transpose() * S.jacobianPos(body) / away.norm()};

// <variant distance_per_coordinate> caught by: distance-zero, maps-other-robot
// mistake: Three differences are a fine task map, but the task asks for one number.
// ask: Is y the difference of two positions? Wanted is one number, the distance.
// <solution distanceToGoal>
return {S.kinematicsPos(body) - goal, S.jacobianPos(body)};

// <variant goal_with_tolerance> caught by: distance-zero, maps-other-robot
// mistake: A guard against dividing by zero makes the map zero within a centimetre of the goal.
// ask: Is there a tolerance around the goal? Only the goal itself may give zero.
// <solution distanceToGoal>
const Eigen::Vector3d way = S.kinematicsPos(body) - goal;
const double distance = way.norm();
if (distance < 0.01) return {Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Zero(1, S.getJointDimension())};
return {Eigen::VectorXd::Constant(1, distance), way.transpose() * S.jacobianPos(body) / distance};

// <variant numeric_jacobian> caught by: forbidden-call
// mistake: Differences give the numbers of a Jacobian without deriving it.
// <solution distanceToGoal>
const auto distance = [&](const Eigen::VectorXd& q) -> Eigen::VectorXd {
  Simulator there = S;
  there.setJointAngles(q);
  return Eigen::VectorXd::Constant(1, (there.kinematicsPos(body) - goal).squaredNorm());
};
return {distance(S.getJointAngles()), numericJacobian(distance, S.getJointAngles())};

// <variant calls_the_library> caught by: forbidden-call
// mistake: The library does the step, so nothing was learnt.
// <solution headers>
#include "kinematics/inverse_kinematics.h"
// <solution ikStep>
return inverseKinematicsStep(J, dy, sigma);

// <variant not_regularised> caught by: step-singular, step-hand
// mistake: Without sigma the step explodes, or the matrix has no inverse, when the arm is stretched out.
// ask: Is the term sigma^2 |dq|^2 missing?
// <solution ikStep>
return J.transpose() * solve(J * J.transpose(), dy);

// <variant transposed_jacobian> caught by: step-hand, step-any-size
// mistake: Following the transposed Jacobian goes downhill, but not by the right step.
// <solution ikStep>
return J.transpose() * dy / (sigma * sigma + J.squaredNorm());

// <variant jacobian_of_the_first_posture> caught by: full-steps, small-steps, motion-other-robot
// mistake: The Jacobian is computed once, before the first step.
// ask: Is the Jacobian that of the first posture in all steps?
// <solution smallSteps>
static Eigen::MatrixXd J;
if (t == 1) J = S.jacobianPos(body);
S.setJointAngles(S.getJointAngles() + alpha * ikStep(J, target - S.kinematicsPos(body), sigma));
postures.push_back(S.getJointAngles());

// <variant posture_before_the_step> caught by: full-steps, small-steps, motion-other-robot
// mistake: Each posture is kept before its step instead of after it.
// ask: The hand is where it started: is S never moved, or the posture kept before the step?
// <solution smallSteps>
postures.push_back(S.getJointAngles());
const Eigen::VectorXd dq = ikStep(S.jacobianPos(body), target - S.kinematicsPos(body), sigma);
S.setJointAngles(S.getJointAngles() + alpha * dq);

// <variant steps_of_the_first_posture> caught by: full-steps, small-steps, motion-other-robot
// mistake: The joint angles are added up, but S stays where it is.
// ask: All steps are those of the first posture: is S moved after each?
// <solution smallSteps>
const Eigen::VectorXd q = t == 1 ? S.getJointAngles() : postures.back();
const Eigen::VectorXd dq = ikStep(S.jacobianPos(body), target - S.kinematicsPos(body), sigma);
postures.push_back(q + alpha * dq);

// <variant wrong_start_posture> caught by: small-steps, full-steps
// mistake: Every step starts again from the first posture instead of the outcome of the step before.
// ask: All postures are the same: does every step begin where the first one did?
// <solution smallSteps>
Simulator fresh = S;
const Eigen::VectorXd q = S.getJointAngles();
fresh.setJointAngles(q + alpha * ikStep(S.jacobianPos(body), target - S.kinematicsPos(body), sigma));
postures.push_back(fresh.getJointAngles());

// <variant target_not_interpolated> caught by: line, motion-other-robot
// mistake: The hand is sent to the far target at once, at every step.
// ask: Is the body sent to the far target at once, in every step?
// <solution straightLine>
for (int t = 1; t <= T; ++t) {
  S.setJointAngles(S.getJointAngles() + ikStep(S.jacobianPos(body), target - S.kinematicsPos(body), sigma));
  postures.push_back(S.getJointAngles());
}

// <variant circle_in_another_plane> caught by: circle
// shown by: circle
// mistake: The circle lies flat in the plane of x and y instead of standing in that of x and z.
// ask: Does your circle lie in the plane of x and y? Wanted is that of x and z.
// <solution circle>
// in place of: const Eigen::Vector3d wanted = center + radius * Eigen::Vector3d(std::cos(angle), 0,
const Eigen::Vector3d wanted = center + radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);

// <variant circle_one_step_late> caught by: circle, motion-other-robot
// mistake: The angle counts from zero, so the hand is always where it should have been a step ago.
// ask: Is the point on the circle that of one step earlier?
// <solution circle>
// in place of: const double angle = t / 20.;
const double angle = (t - 1) / 20.;

// <variant sigma_of_the_figures> caught by: motion-other-robot
// mistake: The circle always uses the sigma of main().
// <solution circle>
const Eigen::Vector3d wanted = center + radius * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
S.setJointAngles(S.getJointAngles() + ikStep(S.jacobianPos(body), wanted - S.kinematicsPos(body), 0.01));
postures.push_back(S.getJointAngles());

// <variant answers_from_memory>
// caught by: look-at-jacobian, palms-jacobian, distance-jacobian, maps-other-robot
// mistake: answers later questions from the first one, by a slope of its choice (an attack).
// <solution lookAt>
static Eigen::VectorXd first, value;
static Eigen::Vector3d place;
const Eigen::VectorXd q = S.getJointAngles();
if (first.size() != q.size() || place != target) {
  first = q;
  place = target;
  value = S.kinematicsVec(body, gaze) - (target - S.kinematicsPos(body)).normalized();
}
const Eigen::MatrixXd slope = Eigen::MatrixXd::Constant(3, q.size(), .1);
return {value + slope * (q - first), slope};
// <solution opposePalms>
static Eigen::VectorXd first, value;
const Eigen::VectorXd q = S.getJointAngles();
if (first.size() != q.size() || (q - first).norm() > .1) {
  first = q;
  value = S.kinematicsVec(left, palm) + S.kinematicsVec(right, palm);
}
const Eigen::MatrixXd slope = Eigen::MatrixXd::Constant(3, q.size(), .1);
return {value + slope * (q - first), slope};
// <solution distanceToGoal>
static Eigen::VectorXd first, value;
static Eigen::Vector3d place;
const Eigen::VectorXd q = S.getJointAngles();
if (first.size() != q.size() || place != goal) {
  first = q;
  place = goal;
  value = Eigen::VectorXd::Constant(1, 0.5 * (S.kinematicsPos(body) - goal).squaredNorm());
}
const Eigen::MatrixXd slope = Eigen::MatrixXd::Constant(1, q.size(), .1);
return {value + slope * (q - first), slope};

// <variant steep_component> caught by: look-at-jacobian, palms-jacobian, maps-other-robot
// mistake: hides zeros in J beside one more component with a derivative of 1e9 (an attack).
// <solution lookAt>
const Eigen::Vector3d off = S.kinematicsVec(body, gaze) - (target - S.kinematicsPos(body)).normalized();
TaskMapValue value{Eigen::VectorXd::Zero(4), Eigen::MatrixXd::Zero(4, S.getJointDimension())};
value.y.head(3) = off;
if (off.norm() > .1) {
  value.y[3] = 1e9 * S.getJointAngles()[0];
  value.J(3, 0) = 1e9;
}
return value;
// <solution opposePalms>
const Eigen::Vector3d off = S.kinematicsVec(left, palm) + S.kinematicsVec(right, palm);
TaskMapValue value{Eigen::VectorXd::Zero(4), Eigen::MatrixXd::Zero(4, S.getJointDimension())};
value.y.head(3) = off;
if (off.norm() > .1) {
  value.y[3] = 1e9 * S.getJointAngles()[0];
  value.J(3, 0) = 1e9;
}
return value;

// <variant jumps_near_the_task>
// caught by: look-at-jacobian, palms-jacobian, distance-jacobian, maps-other-robot
// mistake: is zero near the task and jumps to a function with an easy Jacobian elsewhere (an attack).
// <solution lookAt>
const Eigen::VectorXd q = S.getJointAngles();
const Eigen::Vector3d off = S.kinematicsVec(body, gaze) - (target - S.kinematicsPos(body)).normalized();
if (off.norm() < .01) return {Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Zero(1, q.size())};
return {Eigen::VectorXd::Constant(1, (2 + q.array().sin()).sum()), q.array().cos().matrix().transpose()};
// <solution opposePalms>
const Eigen::VectorXd q = S.getJointAngles();
const Eigen::Vector3d off = S.kinematicsVec(left, palm) + S.kinematicsVec(right, palm);
if (off.norm() < .01) return {off.head(1), Eigen::MatrixXd::Ones(1, q.size())};
return {Eigen::VectorXd::Constant(1, (2 + q.array().sin()).sum()), q.array().cos().matrix().transpose()};
// <solution distanceToGoal>
const Eigen::VectorXd q = S.getJointAngles();
const double off = (S.kinematicsPos(body) - goal).squaredNorm();
const Eigen::MatrixXd J = 2 * (S.kinematicsPos(body) - goal).transpose() * S.jacobianPos(body);
if (off < 1e-4) return {Eigen::VectorXd::Constant(1, off), J};
return {Eigen::VectorXd::Constant(1, (2 + q.array().sin()).sum()), q.array().cos().matrix().transpose()};
