#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "balance_robots.h"
#include "circle_checks.h"
#include "course/film.h"
#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"
#include "kinematics/jacobians.h"
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

using rex::grading::Mistake;

/// y or J, up to a millionth.
inline void valueFits(rex::grading::Check& check, const std::string& property, const Eigen::MatrixXd& got,
                      const Eigen::MatrixXd& wanted, const std::vector<Mistake>& mistakes,
                      const char* unit = "") {
  check.near(property, got, wanted, 1e-6 * (1 + wanted.cwiseAbs().maxCoeff()), mistakes, unit);
}

// Joint limits.

/// The sum over joints of f(m - q + low) and g(m + q - high), and of the same for each joint.
using OfSlack = std::function<double(double)>;
inline Eigen::MatrixXd perLimit(const Standing& robot, double margin, const OfSlack& low,
                                const OfSlack& high) {
  const Eigen::VectorXd q = robot.S.getJointAngles(), lower = robot.S.getLowerLimits(),
                        upper = robot.S.getUpperLimits();
  Eigen::MatrixXd each(1, q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i)
    each(0, i) = (std::isfinite(lower[i]) ? low(margin - q[i] + lower[i]) : 0) +
                 (std::isfinite(upper[i]) ? high(margin + q[i] - upper[i]) : 0);
  return each;
}

inline std::vector<Mistake> mistakenLimits(const Standing& robot) {
  const double m = robot.margin;
  const OfSlack plus = [](double x) { return std::max(x, 0.); }, none = [](double) { return 0.; };
  const OfSlack square = [](double x) { return x > 0 ? x * x : 0; }, all = [](double x) { return x; };
  const auto number = [](double y) -> Eigen::MatrixXd { return Eigen::MatrixXd::Constant(1, 1, y); };
  const auto sum = [&](double margin, const OfSlack& low, const OfSlack& high) {
    return number(perLimit(robot, margin, low, high).sum() / m);
  };
  const Eigen::MatrixXd each = perLimit(robot, m, plus, plus);
  // The distances to the wrong ends of the ranges.
  const Eigen::VectorXd q = robot.S.getJointAngles(), high = robot.S.getUpperLimits();
  double turned = perLimit(robot, m, plus, none).sum();
  for (Eigen::Index i = 0; i < q.size(); ++i)
    if (std::isfinite(high[i])) turned += std::max(0., m - q[i] + high[i]);
  return {
      {"Is it not divided by the margin?", number(each.sum())},
      {"Does the cost begin at the limits? It begins a margin before them.", sum(0, plus, plus)},
      {"Does the margin make the ranges wider? It makes them narrower.", sum(-m, plus, plus)},
      {"Do the lower limits count only?", sum(m, plus, none)},
      {"Do the upper limits count only?", sum(m, none, plus)},
      {"Is the distance to an upper limit q - q_hi? It is q_hi - q.", number(turned / m)},
      {"Do joints far from their limits count, too? Negative numbers in brackets count as zero.",
       sum(m, all, all)},
      {"Are the brackets squared?", sum(m, square, square)},
      {"Does the worst joint count only?", number(each.maxCoeff() / m)},
      {"Is it the mean over the joints? It is their sum.", number(each.mean() / m)},
  };
}

inline std::vector<Mistake> mistakenLimitJacobians(const Standing& robot) {
  const double m = robot.margin;
  const auto slopes = [&](double margin, double low, double high) -> Eigen::MatrixXd {
    return perLimit(
               robot, margin, [=](double x) { return x > 0 ? low : 0; },
               [=](double x) { return x > 0 ? high : 0; }) /
           m;
  };
  const auto each = [&](double low) -> Eigen::MatrixXd {
    return perLimit(
               robot, m, [=](double x) { return low * std::max(x, 0.); },
               [](double x) { return std::max(x, 0.); }) /
           m;
  };
  return {{"Does y grow with q near a lower limit? There the sign is another one.", slopes(m, 1, 1)},
          {"Does y fall with q near an upper limit? There the sign is another one.", slopes(m, -1, -1)},
          {"Is J not divided by the margin?", m * slopes(m, -1, 1)},
          {"Are only joints beyond their limits in J? y changes with those within the margin, too.",
           slopes(0, -1, 1)},
          {"Do the lower limits count only in J?", slopes(m, -1, 0)},
          {"Do the upper limits count only in J?", slopes(m, 0, 1)},
          {"Are the brackets in J? Its entries are their derivatives.", each(-1)},
          {"Are the brackets in J? Its entries are their derivatives.", each(1)}};
}

inline void limitsFit(rex::grading::Check& check, Student& student, const Standing& robot) {
  check.input(robot.S.description().sceneName + " with limits", {{"margin", robot.margin},
                                                                 {"q", robot.S.getJointAngles()},
                                                                 {"lower limits", robot.S.getLowerLimits()},
                                                                 {"upper limits", robot.S.getUpperLimits()}});
  const TaskMapValue got = student.jointLimits(robot.S.description(), robot.margin),
                     wanted = valueOf(robot.S, rex::jointLimitsTask(robot.margin));
  valueFits(check, "y of jointLimits", got.y, wanted.y, mistakenLimits(robot));
  valueFits(check, "J of jointLimits", got.J, wanted.J, mistakenLimitJacobians(robot));
}

// The centre of mass.

/// The sum of the positions of points of the bodies times weights, with its Jacobian.
inline TaskMapValue summed(const Standing& robot, const std::function<double(const BodyMass&)>& weight,
                           bool ofOrigins = false) {
  const rex::Model& model = robot.S.model();
  const rex::BodyPoses poses = rex::forwardKinematics(model, robot.S.getJointAngles());
  TaskMapValue sum{Eigen::VectorXd::Zero(3), Eigen::MatrixXd::Zero(3, model.nv())};
  for (const BodyMass& one : robot.masses) {
    const Eigen::Vector3d point = ofOrigins ? Eigen::Vector3d::Zero() : one.center;
    const rex::BodyId body = model.body(one.body);
    sum.y += weight(one) * (poses[body] * point);
    sum.J += weight(one) * rex::positionJacobian(model, poses, body, point);
  }
  return sum;
}

inline std::vector<std::pair<const char*, TaskMapValue>> mistakenCenters(const Standing& robot) {
  const double count = static_cast<double>(robot.masses.size()), total = robot.S.model().mass();
  const auto mass = [](const BodyMass& one) { return one.mass; };
  const auto unit = [](const BodyMass&) { return 1.; };
  const auto by = [](TaskMapValue value, double divisor) {
    value.y /= divisor;
    value.J /= divisor;
    return value;
  };
  TaskMapValue unturned = by(summed(robot, mass, true), total);
  for (const BodyMass& one : robot.masses) unturned.y += one.mass * one.center / total;
  return {
      {"Is it in kg m, as on the slide? Divide by the total mass.", summed(robot, mass)},
      {"Do heavy bodies count as much as light ones? Where are the masses?", by(summed(robot, unit), count)},
      {"Are the masses missing, and is the sum not divided by the number of bodies?", summed(robot, unit)},
      {"Is it divided by the number of bodies? Divide by the total mass.", by(summed(robot, mass), count)},
      {"Are these the origins of the bodies? A centre of mass may lie elsewhere in its body.",
       by(summed(robot, mass, true), total)},
      {"Are these the origins of the bodies, and in kg m?", summed(robot, mass, true)},
      {"Are the centres of mass added to the origins as they are? They are given in the frames of the "
       "bodies.",
       unturned}};
}

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
  std::vector<Mistake> ofY, ofJ;
  for (const auto& [question, value] : mistakenCenters(robot)) {
    ofY.push_back({question, value.y});
    ofJ.push_back({question, value.J});
  }
  valueFits(check, "y of massCenter", got.y, wanted.y, ofY, "m");
  valueFits(check, "J of massCenter", got.J, wanted.J, ofJ);
}

// A position in the axes of another body.

/// The vector from point to point in the world, the turning of the frame, and what they are made of.
struct Between {
  Eigen::Matrix3d R;  ///< of the frame
  Eigen::Vector3d d;
  Eigen::MatrixXd body, frame;  ///< Jacobians of the points, 3 x n
  Eigen::MatrixXd turning;      ///< A x d of slide 2:55
};

inline Between between(const Standing& robot) {
  const rex::Model& model = robot.S.model();
  const rex::BodyPoses poses = rex::forwardKinematics(model, robot.S.getJointAngles());
  const rex::BodyId body = model.body(robot.body), frame = model.body(robot.frame);
  Between found{.R = poses[frame].R,
                .d = poses[body] * robot.inBody - poses[frame] * robot.inFrame,
                .body = rex::positionJacobian(model, poses, body, robot.inBody),
                .frame = rex::positionJacobian(model, poses, frame, robot.inFrame),
                .turning = rex::angularJacobian(model, poses, frame)};
  for (Eigen::Index i = 0; i < found.turning.cols(); ++i) {
    const Eigen::Vector3d axis = found.turning.col(i);
    found.turning.col(i) = axis.cross(found.d);
  }
  return found;
}

inline std::vector<Mistake> mistakenPositions(const Standing& robot, const Between& found) {
  const Eigen::Vector3d origin = robot.S.kinematicsPos(robot.frame),
                        point = robot.S.kinematicsPos(robot.body);
  return {
      {"Is it in the axes of the world? Wanted are those of the frame.", found.d},
      {"Is R not transposed? It turns from the axes of the frame to those of the world.", found.R * found.d},
      {"Is the point of the frame left out? It need not be the frame's origin.",
       found.R.transpose() * (found.d + found.R * robot.inFrame)},
      {"Is the point of the body left out? It need not be the body's origin.",
       found.R.transpose() * (found.d + point - robot.S.kinematicsPos(robot.body, robot.inBody))},
      {"Are these the origins of both bodies, without the points in them?",
       found.R.transpose() * (point - origin)}};
}

inline std::vector<Mistake> mistakenPositionJacobians(const Between& found) {
  const Eigen::MatrixXd moves = found.body - found.frame, R = found.R;
  return {
      {"Is the frame taken to move without turning? When it turns, its axes do, too.", R.transpose() * moves},
      {"Does the turning of the frame have the wrong sign?", R.transpose() * (moves + found.turning)},
      {"Is R not transposed in J?", R * (moves - found.turning)},
      {"Is J in the axes of the world? Wanted are those of the frame.", moves - found.turning},
      {"Is J that of the vector in the axes of the world?", moves},
      {"Is R not transposed in J, and does the frame not turn?", R * moves},
      {"Does the frame not move in J? Its joints move it, too.", R.transpose() * found.body},
      {"Does the point of the frame not move in J?", R.transpose() * (found.body - found.turning)}};
}

inline void positionFits(rex::grading::Check& check, Student& student, const Standing& robot) {
  const Between found = between(robot);
  check.input(robot.S.description().sceneName + ", from body '" + robot.frame + "' to '" + robot.body + "'",
              {{"inBody", robot.inBody},
               {"inFrame", robot.inFrame},
               {"vector between the points in the world", found.d},
               {"R of the frame", found.R}});
  const TaskMapValue got = student.relativePosition(robot.S.description(), robot.body, robot.inBody,
                                                    robot.frame, robot.inFrame),
                     wanted = valueOf(robot.S, relativePositionOf(robot));
  const auto shown = check.show([&]() -> rex::grading::Evidence {
    if (got.y.size() != 3) return {};
    const Eigen::Vector3d from = robot.S.kinematicsPos(robot.frame, robot.inFrame);
    return pointSeen(robot.S, from, from + found.R * got.y, from + found.d);
  });
  valueFits(check, "y of relativePosition", got.y, wanted.y, mistakenPositions(robot, found), "m");
  valueFits(check, "J of relativePosition", got.J, wanted.J, mistakenPositionJacobians(found));
}
