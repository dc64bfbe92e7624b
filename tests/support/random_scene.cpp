#include "support/random_scene.h"

#include <string>

#include "geometry/rotation.h"

namespace rex {

Pose randomPose(Rng& rng) { return {expSO3(rng.normalVector(3)), rng.normalVector(3)}; }

SceneSpec randomScene(Rng& rng, int bodies) {
  SceneSpec spec;
  spec.name = "random";
  for (int i = 0; i < bodies; ++i) {
    BodySpec body;
    body.name = "b" + std::to_string(i);
    body.X_WB = randomPose(rng);
    body.mass = rng.uniform(0.1, 2);
    body.p_BBcm = 0.2 * rng.normalVector(3);
    body.inertia = Eigen::Vector3d(rng.uniformVector(3, 0.1, 0.2)).asDiagonal();
    spec.bodies.push_back(body);
    if (i == 0) continue;
    JointSpec joint;
    joint.name = "j" + std::to_string(i);
    joint.parent = "b" + std::to_string(rng.index(i));
    joint.child = body.name;
    joint.type = kAllJointTypes[i % std::size(kAllJointTypes)];
    joint.X_PF = randomPose(rng);
    joint.X_MC = randomPose(rng);
    joint.axis = rng.normalVector(3);
    joint.pitch = rng.uniform(-0.5, 0.5);
    spec.joints.push_back(joint);
  }
  return spec;
}

Eigen::VectorXd randomPositions(Rng& rng, int nq) { return rng.normalVector(nq); }

}  // namespace rex
