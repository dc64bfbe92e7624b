#pragma once

#include <string>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. n is the number of joint angles of the robot in S; positions are
// metres in the world frame, angles radians. Slides are cited as chapter:number.

/// A task map at the present posture: its value y (d numbers) and its Jacobian J = dy/dq (d x n).
struct TaskMapValue {
  Eigen::VectorXd y;
  Eigen::MatrixXd J;
};

// Part 1, task maps (12.3.1). Any map is right if its value is zero exactly when the task is fulfilled. You
// may choose the dimension d unless it is given. Values are finite in every posture.

/// Zero exactly when `body` looks at the world point `target`: when `gaze`, a unit vector fixed in the body's
/// frame, points from the body's origin towards the target. Nonzero when the body looks away from it.
TaskMapValue lookAt(const rex::Simulator& S, const std::string& body, const Eigen::Vector3d& gaze,
                    const Eigen::Vector3d& target);

/// Zero exactly when two hands are ready to clap: when `palm`, a unit vector fixed in each hand's frame,
/// points in opposite world directions for the two hands. Nonzero when they point in the same direction.
TaskMapValue opposePalms(const rex::Simulator& S, const std::string& left, const std::string& right,
                         const Eigen::Vector3d& palm);

/// One-dimensional (d = 1): zero exactly when the origin of `body` is at the world point `goal`. At the goal
/// itself, where a distance has no derivative, any finite J will do.
TaskMapValue distanceToGoal(const rex::Simulator& S, const std::string& body, const Eigen::Vector3d& goal);

// Part 2, one step of inverse kinematics (slide 2:29 with W = Id and C = Id / sigma^2).

/// The step dq (n numbers) that minimises |J dq - dy|^2 + sigma^2 |dq|^2, for J (d x n), dy (d numbers) and
/// sigma > 0.
Eigen::VectorXd ikStep(const Eigen::MatrixXd& J, const Eigen::VectorXd& dy, double sigma);

// Part 3, motions (12.3.2). Each starts in the posture of S, moves S through the motion, and returns its
// postures q_1, ..., q_T (n numbers each), without the one it started from.

/// `steps` steps q <- q + alpha * ikStep towards `target` for the origin of `body`.
std::vector<Eigen::VectorXd> smallSteps(rex::Simulator& S, const std::string& body,
                                        const Eigen::Vector3d& target, double alpha, double sigma, int steps);

/// T full steps along the straight line from the body's position to `target`: slide 2:31.
std::vector<Eigen::VectorXd> straightLine(rex::Simulator& S, const std::string& body,
                                          const Eigen::Vector3d& target, double sigma, int T);

/// T full steps around a circle in the plane of x and z: at step t = 1, ..., T the origin of `body` should be
/// at center + radius * (cos(t / 20), 0, sin(t / 20)).
std::vector<Eigen::VectorXd> circle(rex::Simulator& S, const std::string& body, const Eigen::Vector3d& center,
                                    double radius, double sigma, int T);
