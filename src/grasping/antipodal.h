#pragma once

#include "grasping/object_surface.h"

namespace rex {

/// The gripper with two opposite jaws for which candidates are sampled.
struct AntipodalOptions {
  double friction = 0.5;
  double maxWidth = 0.1;  ///< opening of the jaws, metres
};

/// Two contacts whose connecting line lies in both friction cones: `a` and `b` push towards each other.
struct AntipodalGrasp {
  Contact a, b;
  double width = 0;  ///< distance between them, metres
};

/// The grasps found, and why other candidates were rejected.
struct AntipodalGrasps {
  std::vector<AntipodalGrasp> grasps{};
  int tries = 0;
  int notOpposite = 0;  ///< the surface at the other end is too slanted
  int tooWide = 0;
  int blocked = 0;  ///< another part of the object is where the open jaws would be
};

/// Samples grasps by two jaws that move along one line (criterion of Nguyen, 1988): `tries` points of the
/// surface, each with a random line in its friction cone, uniform over the cone's cross-section; a ray
/// finds the other contact. A grasp is reachable if it is at most maxWidth wide and the line outside the
/// contacts is free as far as the jaws open, symmetrically to both sides. Throws Error for negative tries
/// and options out of range.
[[nodiscard]] AntipodalGrasps sampleAntipodal(const ObjectSurface& surface, Rng& rng, int tries,
                                              const AntipodalOptions& options = {});

/// Contacts that push into the surface at these points. Throws like requireValid().
[[nodiscard]] std::vector<Contact> contactsAt(const std::vector<SurfacePoint>& points, double friction);

}  // namespace rex
