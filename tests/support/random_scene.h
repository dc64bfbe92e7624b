#pragma once

#include "base/rng.h"
#include "scene/scene_spec.h"

namespace rex {

inline constexpr JointType kAllJointTypes[] = {
    JointType::kRigid,       JointType::kHinge,     JointType::kSlider,       JointType::kScrew,
    JointType::kCylindrical, JointType::kPlanarXY,  JointType::kTranslation3, JointType::kPlanarXYPhi,
    JointType::kPlanarPhiXY, JointType::kUniversal, JointType::kBall,         JointType::kFree};

Pose randomPose(Rng& rng);

/// A tree of `bodies` bodies "b0", "b1", ... below one root, with every joint type in turn, random frames and
/// axes, masses and off-centre inertias.
SceneSpec randomScene(Rng& rng, int bodies);

/// Gives it shapes of all types, limits, a start, damping, armatures, springs, and joints that follow others:
/// all that a spec can say. Meshes are named only.
void addDetails(Rng& rng, SceneSpec& spec);

/// Random coordinates for it, with quaternions of any length.
Eigen::VectorXd randomPositions(Rng& rng, int nq);

/// Makes cylinders of cones, which URDF lacks.
void replaceCones(SceneSpec& spec);

}  // namespace rex
