#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "collision/contacts.h"

namespace rex {

/// The label of a shape of the model, given its index in Model::shapes(): its own name, or that of its
/// body. A number counts a body's shapes without a name, "hole#2", and shapes that share a name, as the
/// collision shapes of a URDF link do: "panda_link2#3" is the third of them.
[[nodiscard]] std::string shapeLabel(const Model& model, int shape);

/// A table of the pairs, nearest first, with a headline and a line for each: names, distance, and the
/// nearest points of both shapes in W, metres. Distances that are not a number come first.
[[nodiscard]] std::string proxyReport(const Model& model, std::span<const Proxy> proxies);

/// The reason for the verdict on a pair of bodies. The first one that applies decides.
enum class PairReason {
  kSamePart,         ///< fixed to each other, or both in the world
  kCannotMove,       ///< coupled joints provably cancel, so their relative pose never changes
  kMasks,            ///< no two of their shapes may touch, see ContactMask
  kChosen,           ///< chosen by the scene: an SRDF, or `collisions` in .ors
  kNeighbours,       ///< a joint or a pin links them
  kFourGenerations,  ///< both are within four generations below a common ancestor, which may be one of them
  kOverlapAtHome,    ///< they overlap deeper than kHomeTolerance in the initial posture
  kNone              ///< nothing rules out a collision
};

/// Bodies that overlap no deeper than this in the initial posture may collide, metres: mesh rounding.
inline constexpr double kHomeTolerance = 1e-6;

/// Whether two bodies may collide, and why.
struct PairVerdict {
  BodyId a{}, b{};  ///< a < b
  bool mayCollide = true;
  PairReason reason = PairReason::kNone;
  std::string said{};                  ///< for a choice: its reason, if it has one
  std::optional<ShapePair> deepest{};  ///< for an overlap at home: the shapes, and its depth in metres
  double depth = 0;
};

/// "neighbours", "overlap at home by 0.012 m ('palm' and 'tip')", ...
[[nodiscard]] std::string toString(const PairVerdict& verdict, const Model& model);

/// The verdict on each pair of bodies with shapes in contact. With kAllButNeighbours, neighbours are the
/// two bodies of a joint or a pin and everything fixed to them, where joints chained by massless links
/// without shapes count as one; of everything fixed to the world, only the body that carries the joint
/// counts. A free joint makes no neighbours, and overlaps at home with its descendants do not count, because
/// they will be moved elsewhere. What overlaps at home but not with all joints in the middle of their limits
/// may collide: 0, the home of URDF, is often an end of a range, where a robot is folded. With
/// kFourGenerations, neighbours are the two bodies of a joint, and those of a pin with everything fixed to
/// them; overlaps at home do not count. Shapes that are paired in their masks may touch; other shapes of
/// these bodies may touch only if these rules allow it.
[[nodiscard]] std::vector<PairVerdict> pairVerdicts(const Model& model);

/// The pairs of shapes in contact that may touch (ContactMask) on bodies that may collide, and those of pairs
/// in masks on all bodies that can move relative to each other; sorted: those of ContactModel(model). The
/// time is proportional to their number, and proximity() runs only where axis-aligned boxes overlap at home.
[[nodiscard]] std::vector<ShapePair> collidingPairs(const Model& model);

/// A warning for each pair of bodies that is left out because it overlaps at home, and for each choice
/// without effect. Their location is the name of the scene.
[[nodiscard]] Diagnostics collisionWarnings(const Model& model);

}  // namespace rex
