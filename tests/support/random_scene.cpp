#include "support/random_scene.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "geometry/rotation.h"

namespace rex {

namespace {

constexpr ShapeType kAllShapeTypes[] = {
    ShapeType::kBox,        ShapeType::kSphere, ShapeType::kCapsule,    ShapeType::kMesh,
    ShapeType::kCylinder,   ShapeType::kMarker, ShapeType::kPointCloud, ShapeType::kSphereSweptConvex,
    ShapeType::kRoundedBox, ShapeType::kCone};

ShapeSpec randomShape(Rng& rng, ShapeType type) {
  ShapeSpec shape;
  shape.X_BS = randomPose(rng);
  shape.shape.type = type;
  shape.shape.extent = rng.uniformVector(3, 0.1, 1);
  shape.shape.radius = rng.uniform(0, 0.05);
  shape.color = rng.uniformVector(4, 0, 1);
  shape.contact = rng.index(2) == 0;
  shape.visible = rng.index(3) != 0;
  if (usesMesh(type)) {
    shape.meshFile = "meshes/part.stl";
    shape.meshScale = rng.uniformVector(3, 0.5, 2);
  }
  return shape;
}

void addJointDetails(Rng& rng, JointSpec& joint) {
  const int n = positionCount(joint.type);
  joint.q0 = rng.normalVector(n);
  joint.lower = rng.uniformVector(n, -3, 0);
  joint.upper = rng.uniformVector(n, 0, 3);
  joint.maxVelocity = rng.uniform(0, 5);
  if (rng.index(2) == 0) joint.maxEffort = rng.uniform(0, 50);
  joint.damping = rng.uniform();
  joint.friction = rng.uniform();
}

}  // namespace

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

void addDetails(Rng& rng, SceneSpec& spec) {
  constexpr std::size_t kTypes = std::size(kAllJointTypes);
  for (const ShapeType type : kAllShapeTypes) {
    BodySpec& body = spec.bodies[static_cast<std::size_t>(rng.index(static_cast<int>(spec.bodies.size())))];
    body.kind = BodyKind::kKinematic;
    body.shapes.push_back(randomShape(rng, type));
    if (rng.index(2) == 0) body.shapes.back().name = body.name;
    spec.worldShapes.push_back(randomShape(rng, type));
  }
  spec.bodies[0].kind = BodyKind::kStatic;
  for (JointSpec& joint : spec.joints) addJointDetails(rng, joint);
  // Types repeat, so that the joint one round before has the same type.
  for (std::size_t j = kTypes; j < std::min(spec.joints.size(), 2 * kTypes); j += 2) {
    spec.joints[j].mimic = spec.joints[j - kTypes].name;
    if (positionCount(spec.joints[j].type) != 1) continue;
    spec.joints[j].mimicRatio = rng.normal();
    spec.joints[j].mimicOffset = rng.normal();
    // At q = 0 both joints are within their limits.
    spec.joints[j].lower.array() += spec.joints[j].mimicOffset;
    spec.joints[j].upper.array() += spec.joints[j].mimicOffset;
  }
  Rng own = rng;  // a copy: details that came later leave the scenes of older tests as they were
  for (JointSpec& joint : spec.joints) {
    if (joint.type == JointType::kRigid) continue;
    if (own.index(2) == 0) joint.armature = own.uniform(0, 3);
    if (own.index(2) == 0) joint.stiffness = own.uniform(0, 9);
    if (joint.stiffness > 0 && own.index(2) == 0)
      joint.springReference = own.normalVector(positionCount(joint.type));
  }
}

Eigen::VectorXd randomPositions(Rng& rng, int nq) { return rng.normalVector(nq); }

void replaceCones(SceneSpec& spec) {
  for (BodySpec& body : spec.bodies)
    for (ShapeSpec& shape : body.shapes)
      if (shape.shape.type == ShapeType::kCone) shape.shape.type = ShapeType::kCylinder;
}

}  // namespace rex
