#pragma once

#include "scene/model.h"
#include "support/random_scene.h"

namespace rex {

/// Whether some joints follow others; that takes more than twelve bodies.
enum class Followers { kNone, kSome };

/// A tree of randomScene(), compiled, without shapes and springs.
[[nodiscard]] inline Model randomModel(Rng& rng, int bodies, Followers followers) {
  SceneSpec spec = randomScene(rng, bodies);
  if (followers == Followers::kSome) addDetails(rng, spec);
  for (BodySpec& body : spec.bodies) body.shapes.clear();
  for (JointSpec& joint : spec.joints) joint.stiffness = 0;
  spec.worldShapes.clear();
  return compile(spec);
}

/// Random positions and velocities for a model.
struct RandomMotion {
  RandomMotion(Rng& rng, const Model& model)
      : q(randomPositions(rng, model.nq())), v(rng.normalVector(model.nv())) {}
  Eigen::VectorXd q, v;
};

}  // namespace rex
