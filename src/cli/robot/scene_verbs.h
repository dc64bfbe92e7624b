#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "base/exit_code.h"
#include "cli/robot/scene_option.h"
#include "cli/terminal.h"

namespace rex::cli {

struct SceneOptions {
  SceneOption scene{};
  std::string posture = "file";  ///< see parsePosture()
  bool json = false;
};
/// Prints the bodies as a tree, and the coordinates of the joints.
ExitCode sceneInfo(const Project& project, const SceneOptions& options);
/// Prints everything that is wrong with a file. Returns kBelow if it does not load.
ExitCode sceneCheck(const Project& project, const SceneOptions& options);
/// Prints the poses of the bodies.
ExitCode sceneKinematics(const Project& project, const SceneOptions& options);

struct JacobianOptions {
  SceneOptions scene{};
  std::string body{};
  std::string point = "0,0,0";  ///< in the body's frame, metres
};
ExitCode sceneJacobian(const Project& project, const JacobianOptions& options);

struct ContactsOptions {
  SceneOptions scene{};
  double margin = kContactMargin;  ///< metres
};
/// Prints the nearby pairs that may collide, and their contact cost.
ExitCode sceneContacts(const Project& project, const ContactsOptions& options);

struct PairsOptions {
  SceneOptions scene{};
  int samples = 1000;  ///< random postures
  std::uint64_t seed = 0;
};
/// Prints which pairs of bodies may collide, and why the others may not.
ExitCode scenePairs(const Project& project, const PairsOptions& options);
/// Prints an SRDF with the pairs that never or always touched in random postures.
ExitCode sceneNeverTouching(const Project& project, const PairsOptions& options);

struct DynamicsOptions {
  SceneOptions scene{};
  std::string velocity = "0";  ///< see parseVelocities()
  std::string force = "0";     ///< see parseForces()
};
/// Prints the mass matrix, bias forces, energies, and joint accelerations.
ExitCode sceneDynamics(const Project& project, const DynamicsOptions& options);

struct ConvertOptions {
  SceneOption scene{};
  std::filesystem::path out{};  ///< its extension says which format
};
/// Writes the scene in another format.
ExitCode sceneConvert(const Project& project, const ConvertOptions& options);

/// Says so where an answer has numbers that are too large for a double.
inline void noteOverflow(bool isFinite) {
  if (!isFinite) note("warning: some numbers are too large to compute with: inf and nan, in JSON null");
}

}  // namespace rex::cli
