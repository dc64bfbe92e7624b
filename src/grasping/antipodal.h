#pragma once

#include "grasping/object_surface.h"

namespace rex {

/// Two opposite jaws, as candidates are looked for.
struct AntipodalOptions {
  double friction = 0.5;
  double maxWidth = 0.1;  ///< metres that the jaws open
};

/// Two contacts whose line lies in both friction cones: `a` and `b` push towards one another.
struct AntipodalGrasp {
  Contact a, b;
  double width = 0;  ///< metres between them
};

/// Candidates, and why the others were none.
struct AntipodalGrasps {
  std::vector<AntipodalGrasp> grasps{};
  int tries = 0;
  int notOpposite = 0;  ///< the surface at the other end is too slanted
  int tooWide = 0;
  int blocked = 0;  ///< something else of the object lies where the open jaws would be
};

/// Grasps by two jaws that move along one line, as Nguyen (1988) judges them: `tries` points of the surface,
/// each with a random line in its friction cone, evenly over the cone's section; a ray finds the other
/// contact. Reachable are those at most maxWidth wide, before whose contacts the line is free as far as the
/// jaws open, which is to both sides alike. Throws Error for negative tries and options out of range.
[[nodiscard]] AntipodalGrasps sampleAntipodal(const ObjectSurface& surface, Rng& rng, int tries,
                                              const AntipodalOptions& options = {});

/// Contacts that push into the surface at those points. Throws as requireValid().
[[nodiscard]] std::vector<Contact> contactsAt(const std::vector<SurfacePoint>& points, double friction);

}  // namespace rex
