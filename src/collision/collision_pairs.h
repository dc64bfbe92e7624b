#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "collision/contact_model.h"

namespace rex {

/// What decides about a pair of bodies. Whatever comes first holds.
enum class PairReason {
  kSamePart,         ///< fixed to each other, or both in the world
  kCannotMove,       ///< coupled joints provably cancel, so that their relative pose never changes
  kChosen,           ///< the scene says so: an SRDF, or `collisions` in .ors
  kNeighbours,       ///< a joint links them
  kFourGenerations,  ///< both are within four generations below a common ancestor, itself included
  kOverlapAtHome,    ///< deeper than kHomeTolerance in the initial posture
  kNone              ///< nothing forbids that they collide
};

/// How deep bodies may be in overlap in the initial posture and still collide, metres: rounding of a mesh.
inline constexpr double kHomeTolerance = 1e-6;

/// Whether two bodies may collide, and why.
struct PairVerdict {
  BodyId a{}, b{};  ///< a < b
  bool mayCollide = true;
  PairReason reason = PairReason::kNone;
  std::string said{};                  ///< of a choice: its reason, if it has one
  std::optional<ShapePair> deepest{};  ///< of an overlap at home: the shapes, and how deep, metres
  double depth = 0;
};

/// "neighbours", "overlap at home by 0.012 m ('palm' and 'tip')", ...
[[nodiscard]] std::string toString(const PairVerdict& verdict, const Model& model);

/// The verdict on each pair of bodies that have shapes in contact. By the rule of the model, neighbours are
/// the bodies of a joint with all that is fixed to them, also where massless links without shapes make
/// several joints in one place one; of what is fixed in the world, only the body that carries the joint. A
/// free joint makes no neighbours, and an overlap at home with what hangs on one does not count: it is put
/// elsewhere. With kFourGenerations neighbours are the bodies of a joint, and overlaps at home do not count.
[[nodiscard]] std::vector<PairVerdict> pairVerdicts(const Model& model);

/// The pairs of shapes in contact on bodies that may collide, sorted: what ContactModel(model) looks at. It
/// takes time in proportion to their number, and proximity() only where boxes along the axes overlap at home.
[[nodiscard]] std::vector<ShapePair> collidingPairs(const Model& model);

/// A warning for each pair of bodies that is left out because it overlaps at home, and for each choice
/// without effect. Their place is the name of the scene.
[[nodiscard]] Diagnostics collisionWarnings(const Model& model);

}  // namespace rex
