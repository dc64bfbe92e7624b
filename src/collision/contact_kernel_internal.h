#pragma once

namespace rex::internal {

/// Kernels take eight solids side by side: of different pairs, or of one shape in different configurations.
/// Number i of lane l stands at [i * kContactLanes + l].
inline constexpr int kContactLanes = 8;
inline constexpr int kPoseNumbers = 12 * kContactLanes;  ///< rotations by columns, then origins, as in Pose
inline constexpr int kSizeNumbers = 4 * kContactLanes;   ///< half sizes of the core, then the radius

/// Solids are passed over only where spheres about them are farther apart than asked for by this, metres:
/// more than any rounding. Else the answer for a lane would depend on whether those beside it are looked at.
inline constexpr double kCullSlack = 1e-9;

/// Solids one after the other: kPoseNumbers each at X_WS, kSizeNumbers each at size.
struct LaneSolids {
  const double* X_WS;
  const double* size;
};

/// Two solids by their places, and where the results go.
struct CorePair {
  int a, b;
  int row;
  double reach;  ///< sum of the radii of spheres about both origins that hold them
};

/// What is found of a pair, see Proximity.
struct LaneProximities {
  double distance[kContactLanes];
  double p_WA[3 * kContactLanes], p_WB[3 * kContactLanes], normal_W[3 * kContactLanes];
};

/// The functions of contact_kernel.cpp for pairs of two segments, of a segment and a box, or of two boxes.
struct PairKernel {
  /// Writes row `pair.row` of `distances`, kContactLanes numbers, for each pair.
  void (*distances)(const CorePair* pairs, int count, const LaneSolids& solids, double* distances);
  /// One pair, in the first `lanes` lanes at least.
  void (*proximities)(const CorePair& pair, int lanes, const LaneSolids& solids, LaneProximities& found);
  /// The lanes, as bits, in which some pair is nearer than `margin`; of the lanes in `known` this need not be
  /// found out again. If one is enough, it stops at the first that was not known.
  unsigned (*hits)(const CorePair* pairs, int count, const LaneSolids& solids, double margin, unsigned known,
                   bool isOneEnough);
};

struct ContactKernel {
  /// X_WB (kPoseNumbers) times X_BS (12 numbers).
  void (*place)(const double* X_WB, const double* X_BS, double* X_WS);
  PairKernel pairs[3];

  template <int kLanes>
  static ContactKernel compiled();
};

}  // namespace rex::internal
