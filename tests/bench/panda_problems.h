#pragma once

#include <filesystem>

namespace rex::bench {

struct PandaOptions {
  std::filesystem::path problems;  ///< a folder, see readSphereProblems()
  std::filesystem::path urdf{};    ///< empty: ../urdf/panda_spherized.urdf beside the folder
  std::filesystem::path srdf{};    ///< empty: NAME.srdf beside NAME.urdf, if any
  int seed = 1;                    ///< the first point of the Halton sequence
  int repetitions = 9;             ///< of each problem; the smallest time counts
  bool asJson = false;
};

/// Solves all problems of a folder and prints what that took, per set and overall. Paths are judged by exact
/// distances, outside of the timing. Throws Error as readSphereProblems() and readSphereRobot().
void runPandaProblems(const PandaOptions& options);

}  // namespace rex::bench
