#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "balance_robots.h"
#include "circle_checks.h"
#include "course/film.h"
#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"
#include "kinematics/task_maps.h"

// Part 5: joint limits, the centre of mass, and a position in the axes of another body.

/// The library's task map, as an independent opinion.
inline TaskMapValue valueOf(const rex::Simulator& S, const rex::TaskMap& map) {
  const Eigen::VectorXd posture = S.getJointAngles();
  const rex::BodyPoses poses = rex::forwardKinematics(S.model(), posture);
  rex::TaskValue value;
  map({S.model(), posture, poses}, value);
  return {value.y, value.J};
}

/// The map that `relativePosition` should be.
inline rex::TaskMap relativePositionOf(const Standing& robot) {
  const rex::Model& model = robot.S.model();
  return rex::relativePositionTask(model.body(robot.body), robot.inBody, model.body(robot.frame),
                                   robot.inFrame);
}

/// y as the library has it, and J as differences of the library's y, which a program cannot choose.
inline void differencesFit(rex::grading::Check& check, const std::string& function, const Standing& robot,
                           const rex::TaskMap& map, const TaskMapValue& got) {
  const auto y = [&](const Eigen::VectorXd& q) { return valueOf(at(robot.S, q), map).y; };
  check.near("y of " + function, got.y, valueOf(robot.S, map).y, 1e-6);
  const Eigen::MatrixXd numeric = rex::numericJacobian(y, robot.S.getJointAngles());
  check.near("J of " + function + ", beside differences of its y", got.J, numeric,
             1e-5 * (1 + numeric.cwiseAbs().maxCoeff()));
}

/// y or J, up to a millionth.
inline void valueFits(rex::grading::Check& check, const std::string& property, const Eigen::MatrixXd& got,
                      const Eigen::MatrixXd& wanted, const char* unit = "") {
  check.near(property, got, wanted, 1e-6 * (1 + wanted.cwiseAbs().maxCoeff()), unit);
}

// Joint limits.

inline void limitsFit(rex::grading::Check& check, Student& student, const Standing& robot) {
  check.input(robot.S.description().sceneName + " with limits", {{"margin", robot.margin},
                                                                 {"q", robot.S.getJointAngles()},
                                                                 {"lower limits", robot.S.getLowerLimits()},
                                                                 {"upper limits", robot.S.getUpperLimits()}});
  const TaskMapValue got = student.jointLimits(robot.S.description(), robot.margin),
                     wanted = valueOf(robot.S, rex::jointLimitsTask(robot.margin));
  valueFits(check, "y of jointLimits", got.y, wanted.y);
  valueFits(check, "J of jointLimits", got.J, wanted.J);
}

// The centre of mass.

/// The robot with the point that it answered, and in green with the wanted one; both are linked to `from`.
inline rex::grading::Evidence pointSeen(const rex::Simulator& S, const Eigen::Vector3d& from,
                                        const Eigen::Vector3d& got, const Eigen::Vector3d& wanted) {
  const auto with = [&](const Eigen::Vector3d& point) {
    return rex::makeFilm(S, {S.getJointAngles(), S.getJointAngles()},
                         {.paths = {{from, point}}, .points = {point}});
  };
  return {.film = rex::grading::withWanted(with(got), with(wanted)), .moment = 1. / rex::kFilmRate};
}

inline void centerFits(rex::grading::Check& check, Student& student, const Standing& robot) {
  const Eigen::Index count = static_cast<Eigen::Index>(robot.masses.size());
  Eigen::VectorXd masses(count);
  Eigen::MatrixXd centers(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const BodyMass& one = robot.masses[static_cast<std::size_t>(i)];
    masses[i] = one.mass;
    centers.col(i) = robot.S.kinematicsPos(one.body, one.center);
  }
  check.input(robot.S.description().sceneName + " with other masses",
              {{"masses", masses}, {"their centres in the world, column by column", centers}});
  const TaskMapValue got = student.massCenter(robot.S.description(), robot.masses),
                     wanted = valueOf(robot.S, rex::centerOfMassTask());
  const auto shown = check.show([&]() -> rex::grading::Evidence {
    if (got.y.size() != 3) return {};
    return pointSeen(robot.S, {wanted.y[0], wanted.y[1], 0}, got.y, wanted.y);
  });
  valueFits(check, "y of massCenter", got.y, wanted.y, "m");
  valueFits(check, "J of massCenter", got.J, wanted.J);
}

// A position in the axes of another body.

inline void positionFits(rex::grading::Check& check, Student& student, const Standing& robot) {
  const rex::Model& model = robot.S.model();
  const rex::BodyPoses poses = rex::forwardKinematics(model, robot.S.getJointAngles());
  const Eigen::Matrix3d R = poses[model.body(robot.frame)].R;
  const Eigen::Vector3d from = robot.S.kinematicsPos(robot.frame, robot.inFrame),
                        d = robot.S.kinematicsPos(robot.body, robot.inBody) - from;
  check.input(robot.S.description().sceneName + ", from body '" + robot.frame + "' to '" + robot.body + "'",
              {{"inBody", robot.inBody},
               {"inFrame", robot.inFrame},
               {"vector between the points in the world", d},
               {"R of the frame", R}});
  const TaskMapValue got = student.relativePosition(robot.S.description(), robot.body, robot.inBody,
                                                    robot.frame, robot.inFrame),
                     wanted = valueOf(robot.S, relativePositionOf(robot));
  const auto shown = check.show([&]() -> rex::grading::Evidence {
    if (got.y.size() != 3) return {};
    return pointSeen(robot.S, from, from + R * got.y, from + d);
  });
  valueFits(check, "y of relativePosition", got.y, wanted.y, "m");
  valueFits(check, "J of relativePosition", got.J, wanted.J);
}
