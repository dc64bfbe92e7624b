#pragma once

#include <iterator>

#include "scene/model.h"
#include "support/random_scene.h"

namespace rex {

/// randomScene() of so many bodies; of the joints after the first of each type, every second mimics that.
inline Model randomTree(Rng& rng, int bodies) {
  constexpr std::size_t kTypes = std::size(kAllJointTypes);
  SceneSpec spec = randomScene(rng, bodies);
  for (std::size_t j = kTypes; j < spec.joints.size(); j += 2) {
    spec.joints[j].mimic = spec.joints[j % kTypes].name;
    if (positionCount(spec.joints[j].type) == 1) spec.joints[j].mimicRatio = rng.normal();
  }
  return compile(spec);
}

}  // namespace rex
