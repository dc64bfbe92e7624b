#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/model.h"

namespace rex::cli {

/// The posture that `--q TEXT` asks for: all nq numbers, or "joint=number,..." for some joints of one
/// coordinate, the others as in the file; separated by blanks or commas. "0" has all joints at zero
/// (quaternions at the identity), "file" is the posture of the file. Throws UsageError naming both sizes,
/// the word that is not a number, the joint whose quaternion is zero, or the nearest joints, the first dozen
/// where none is near.
[[nodiscard]] Eigen::VectorXd parsePosture(const Model& model, const std::string& text);
/// The same for another option than --q, such as "--goal".
[[nodiscard]] Eigen::VectorXd parsePostureOf(const Model& model, const std::string& option,
                                             const std::string& text);

/// The velocities (nv) that `--v TEXT` asks for: all numbers, "joint=number,..." with the others at rest, or
/// "0". Throws as parsePosture.
[[nodiscard]] Eigen::VectorXd parseVelocities(const Model& model, const std::string& text);

/// The forces of joints (nv) that `--u TEXT` asks for, as parseVelocities.
[[nodiscard]] Eigen::VectorXd parseForces(const Model& model, const std::string& text);

/// Postures and the times at which they are taken, seconds from 0.
struct Motion {
  std::vector<double> times;
  std::vector<Eigen::VectorXd> postures;
};

/// Reads a motion: one posture per line, numbers separated by commas or blanks, in all lines before them a
/// time in seconds, or in none, then `rate` lines per second. Lines that begin with '#' are skipped, and
/// names of columns before the first posture. It is given back at `rate` postures per second, the latest at
/// each moment. Throws UsageError with file:line for a missing file, a wrong count, what is not a finite
/// number, a quaternion that is zero, a time that does not increase, no posture at all, or more than two
/// minutes.
[[nodiscard]] Motion readMotion(const Model& model, const std::filesystem::path& file, double rate);

/// A smooth motion through all `keys` (at least one), each `seconds` after the one before, at `rate` frames
/// per second; it rests at each of them. Throws UsageError for more than two minutes.
[[nodiscard]] Motion moveThrough(const Model& model, const std::vector<Eigen::VectorXd>& keys, double seconds,
                                 double rate);

}  // namespace rex::cli
