// caught by: circle-home, circle-points, circle-other-hand
// mistake: One hand points upwards; the other is not moved round its circle.

// <solution circleWithTasks>
for (int t = 0; t < T; ++t) {
  const Eigen::VectorXd gap = Eigen::Vector3d::UnitZ() - S.kinematicsVec(pointing);
  S.setJointAngles(S.getJointAngles() + 0.2 * S.jacobianVec(pointing).transpose() * gap);
  postures.push_back(S.getJointAngles());
}
// </solution>
