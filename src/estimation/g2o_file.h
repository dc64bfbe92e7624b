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
  std::vector<long> ids{};  ///< of the poses, in the file; none: 0, 1, ..
  bool hasPoses = false;    ///< false: there were only edges, and poses follow from these (setOdometryPoses)
  std::vector<Diagnostic> notes{};
};

/// Reads VERTEX_SE2, EDGE_SE2, VERTEX_SE3:QUAT, EDGE_SE3:QUAT and FIX; the pose with the lowest id is pose 0.
/// Quaternions of unit length within 1e-3 are normalised. Throws Error with line and column for another tag
/// (did you mean), a word that is no number, too few or too many, information that is not positive
/// semidefinite, an edge to a pose that is not there, two poses of one id, two that are fixed, planar and
/// spatial poses mixed, a pose that no edges join to the first, and no edges at all; `file` only names the
/// place.
[[nodiscard]] G2oFile parseG2o(std::string_view text, const std::string& file = "");
/// Throws Error for a file that cannot be read, and as parseG2o.
[[nodiscard]] G2oFile readG2o(const std::filesystem::path& file);

/// Poses and edges as text, with as many digits as it takes to read the same numbers back (spatial: to
/// 1e-15). Leaves out comments, FIX, and whether the poses were in the file. Throws Error for a count of ids
/// that is neither that of the poses nor zero, and as poseGraphCost.
[[nodiscard]] std::string writeG2o(const G2oFile& file);

}  // namespace rex
