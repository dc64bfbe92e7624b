#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/error.h"
#include "estimation/pose_graph.h"

namespace rex {

/// The content of a g2o file.
struct G2oFile {
  std::variant<PlanarPoseGraph, SpatialPoseGraph> graph{};
  std::vector<long> ids{};          ///< ids of the poses in the file; empty: 0, 1, ...
  std::vector<long> landmarkIds{};  ///< ids of the landmarks; empty: they follow those of the poses
  bool hasPoses = false;            ///< false: the file had only edges; setOdometryPoses() made the poses
  std::vector<Diagnostic> notes{};
};

/// Reads VERTEX_SE2, EDGE_SE2, VERTEX_XY and EDGE_SE2_XY (landmarks), VERTEX_SE3:QUAT, EDGE_SE3:QUAT and
/// FIX; the pose with the lowest id is pose 0. Lines with other tags are ignored, with one warning per tag.
/// Quaternions of unit length within 1e-3 are normalised; information that is not positive semidefinite
/// becomes nearestSemidefinite(), with a warning. Throws Error with line and column for words that are not
/// numbers, too few or too many words, edges to missing vertices, duplicate ids, two fixed poses, a mix of
/// planar and spatial poses, poses not connected to the first, unseen landmarks, and no edges; `file` is
/// for messages.
[[nodiscard]] G2oFile parseG2o(std::string_view text, const std::string& file = "");
/// Throws Error for a file that cannot be read, and like parseG2o.
[[nodiscard]] G2oFile readG2o(const std::filesystem::path& file);

/// Writes poses and edges as text, with enough digits to read the same numbers back (spatial: to 1e-15).
/// Comments, FIX, and whether the file had poses are not written. Throws Error if the number of ids is
/// neither that of the poses (or landmarks) nor zero, and like poseGraphCost.
[[nodiscard]] std::string writeG2o(const G2oFile& file);

}  // namespace rex
