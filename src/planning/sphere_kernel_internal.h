#pragma once

// A robot of spheres among obstacles in plain numbers, for the kernel that checks its motions.
namespace rex::internal {

/// Bounds of what the kernel can hold.
inline constexpr int kMostCoordinates = 16, kMostLinks = 24, kMostNodes = 512, kMostLinkPairs = 128;

/// Link of a chain of hinges and sliders along their own z, see scene/link.h. If R of its constant only
/// exchanges axes, column i of R is +-1 at `axis[i]`, and `isExchange` says so.
struct SphereLink {
  int parent = -1;  ///< -1: the world
  int qIndex = 0;
  bool isHinge = true;
  bool isExchange = false;
  int axis[3]{};
  float sign[3]{};
  float ratio = 1, offset = 0;
  float R_PL[9]{};  ///< by columns
  float p_PL[3]{};
};

/// Node of a tree of bounding spheres in the frame of a link. A leaf is a sphere of the robot. The children
/// of an inner node follow it; `next` is the node after all that belong to it.
struct SphereNode {
  float center[3]{};
  float radius = 0;
  int next = 0;
  bool isLeaf = true;
};

/// The tree of all spheres of a link, or of those of one body of it.
struct SphereGroup {
  int link = -1;
  int node = 0;      ///< the root of the tree
  float spread = 0;  ///< the largest distance of a centre in it from that of the root
};

/// Two groups that may collide.
struct SpherePair {
  int a = 0, b = 0;
};

/// The groups of whole links, and the pairs of their bodies that may collide.
struct SphereLinkPair {
  SpherePair links;
  int first = 0, end = 0;  ///< of the pairs of bodies
};

struct SphereObstacle {
  enum class Kind { kUprightBox, kBox, kCapsule, kCylinder };
  Kind kind = Kind::kBox;
  float R[9]{};  ///< axes, by columns
  float p[3]{};
  float half[3]{};  ///< of a box; of a capsule or cylinder, half[2] is half the straight length
  float radius = 0;
};

/// The obstacles that a group of a whole link may reach.
struct SphereGuard {
  int group = 0;
  int obstacleCount = 0;
  const int* obstacles = nullptr;
};

struct SphereScene {
  float slack = 0;   ///< what is nearer than this counts as overlap, metres: more than single precision costs
  float finest = 0;  ///< motions are not divided into stretches in which spheres move less than this, metres
  int coordinates = 0;
  int linkCount = 0, nodeCount = 0, guardCount = 0, linkPairCount = 0;
  const SphereLink* links = nullptr;
  const SphereNode* nodes = nullptr;
  const SphereGroup* groups = nullptr;
  /// How far each link moves the spheres of another one, [mover][link], and the spheres of two links towards
  /// each other, [mover][pair of links], per unit of its coordinate at most. Rows are padded to multiples of
  /// eight.
  const float *reach = nullptr, *approach = nullptr;
  const SphereGuard* guards = nullptr;
  const SphereLinkPair* linkPairs = nullptr;
  const SpherePair* pairs = nullptr;
  const SphereObstacle* obstacles = nullptr;
};

/// What an edge check did, for the caller's statistics.
struct SphereCount {
  long blocks = 0;
};

struct SphereKernel {
  /// Whether the straight motion is proven free of overlap. It returns false as soon as a posture overlaps,
  /// and if a stretch that cannot be divided remains unproven.
  bool (*isFree)(const SphereScene& scene, const float* from, const float* to, SphereCount& count);
  /// The index of the nearest of `count` points, the first of equals, and its squared distance. Coordinate j
  /// of point i stands at points[(i / 8 * coordinates + j) * 8 + i % 8]; the last block is filled up with
  /// numbers that are far away.
  int (*nearest)(const float* points, int count, int coordinates, const float* to, float& squared);
  /// For each obstacle, which of eight balls reach it, one bit each; centers are [3][8].
  void (*reached)(const SphereObstacle* obstacles, int count, const float* centers, const float* radii,
                  unsigned* bits);

  template <int kLanes>
  static SphereKernel compiled();
};

}  // namespace rex::internal
