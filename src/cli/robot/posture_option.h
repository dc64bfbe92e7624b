#pragma once
// Reads postures, velocities, forces and motions from options and files.
#include <filesystem>
#include <string>
#include <vector>

#include "scene/model.h"

namespace rex::cli {

/// positionNames() and velocityNames() of scene/state.h, safe to print.
[[nodiscard]] std::vector<std::string> printablePositionNames(const Model& model);
[[nodiscard]] std::vector<std::string> printableVelocityNames(const Model& model);

/// The posture given by `--q TEXT`: all nq numbers, or "joint=number,..." for some joints with one
/// coordinate, the others as in the file; separated by blanks or commas. "0" sets all joints to zero
/// (quaternions to the identity), "file" is the posture of the file, "key:home" or "state:ready" one that the
/// file names, see Model::postures(). Throws UsageError naming an unknown posture, both sizes, the word that
/// is not a number, the joint whose quaternion is zero, or the nearest joints (the first dozen if none is
/// near).
[[nodiscard]] Eigen::VectorXd parsePosture(const Model& model, const std::string& text);
/// The same for options other than --q, such as "--goal".
[[nodiscard]] Eigen::VectorXd parsePostureAsGiven(const Model& model, const std::string& option,
                                                  const std::string& text);

/// The velocities (nv) given by `--v TEXT`: all numbers, "joint=number,..." with the others at rest, or
/// "0". Throws like parsePosture.
[[nodiscard]] Eigen::VectorXd parseVelocities(const Model& model, const std::string& text);

/// The joint forces (nv) given by `--u TEXT`, in the same forms as parseVelocities.
[[nodiscard]] Eigen::VectorXd parseForces(const Model& model, const std::string& text);

/// Postures and their times, seconds from 0.
struct Motion {
  std::vector<double> times;
  std::vector<Eigen::VectorXd> postures;
};

/// Reads a motion, a table of numbers (cli/numbers.h): one posture per line. Either all lines begin with a
/// time in seconds, or there are `rate` lines per second. Column names are skipped. Returns `rate` postures
/// per second, the latest at each time. Throws UsageError with file:line:column like readNumberTable(), for a
/// wrong count, a zero quaternion, times that do not increase, no postures, or more than two minutes.
[[nodiscard]] Motion readMotion(const Model& model, const std::filesystem::path& file, double rate);

/// A smooth motion through all `keys` (at least one), each `seconds` after the one before, at `rate` frames
/// per second; it rests at each of them. Throws UsageError for more than two minutes.
[[nodiscard]] Motion moveThrough(const Model& model, const std::vector<Eigen::VectorXd>& keys, double seconds,
                                 double rate);

/// parsePostureAsGiven() with normalised quaternions. Also throws UsageError for a zero quaternion, and for a
/// joint outside its limits, saying by how much.
[[nodiscard]] Eigen::VectorXd postureWithinLimits(const Model& model, const std::string& option,
                                                  const std::string& text);

}  // namespace rex::cli
