#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/glb_writer_internal.h"

namespace rex::internal {

/// What one thing is at one moment, and where.
struct GlbState {
  int mesh = -1;
  GlbExtras extras{};
  Pose pose{};
  Eigen::Vector3d scale{1, 1, 1};
};

/// A thing through all moments of a film; none where it is not there.
using GlbTrack = std::vector<std::optional<GlbState>>;

/// Puts things that move into a file. `times` are seconds, one per moment; `parent` is their node.
class GlbTracks {
 public:
  GlbTracks(GlbWriter& writer, std::vector<float> times, int parent);

  /// Adds a node for each mesh with its extras that the track has, and moves, shows and hides it.
  void add(const std::string& name, const GlbTrack& track);

 private:
  void move(int node, const std::vector<GlbState>& way);
  void blink(int node, const std::vector<bool>& shown);

  GlbWriter* writer_;
  std::vector<float> times_;
  int parent_;
};

}  // namespace rex::internal
