// caught by: hand-equations
// mistake: takes the Jacobian for constant.

// <solution accelerationBias>
return Eigen::Vector3d::Zero();
// </solution>
