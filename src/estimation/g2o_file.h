#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/diagnostic.h"
#include "estimation/pose_graph.h"

namespace rex {

/// A pose graph as g2o files hold it.
struct G2oFile {
  std::variant<PlanarPoseGraph, SpatialPoseGraph> graph{};
  std::vector<long> ids{};          ///< of the poses, in the file; none: 0, 1, ..
  std::vector<long> landmarkIds{};  ///< the same; none: they follow those of the poses
  bool hasPoses = false;  ///< false: there were only edges, and poses follow from these (setOdometryPoses)
  std::vector<Diagnostic> notes{};
};

/// Reads VERTEX_SE2, EDGE_SE2, VERTEX_XY and EDGE_SE2_XY (landmarks), VERTEX_SE3:QUAT, EDGE_SE3:QUAT and FIX;
/// the pose with the lowest id is pose 0. Lines with other tags are left out, with one warning for each tag.
/// Quaternions of unit length within 1e-3 are normalised; information that is not positive semidefinite
/// becomes nearestSemidefinite(), with a warning. Throws Error with line and column for a word that is not a
/// number, too few or too many, an edge to what is not there, two vertices of one id, two that are fixed,
/// planar and spatial poses mixed, a pose that no edges join to the first, a landmark that no pose sees, and
/// no edges at all; `file` only names the place.
[[nodiscard]] G2oFile parseG2o(std::string_view text, const std::string& file = "");
/// Throws Error for a file that cannot be read, and as parseG2o.
[[nodiscard]] G2oFile readG2o(const std::filesystem::path& file);

/// Poses and edges as text, with as many digits as it takes to read the same numbers back (spatial: to
/// 1e-15). Leaves out comments, FIX, and whether the poses were in the file. Throws Error for a count of ids
/// that is neither that of the poses (or landmarks) nor zero, and as poseGraphCost.
[[nodiscard]] std::string writeG2o(const G2oFile& file);

}  // namespace rex
