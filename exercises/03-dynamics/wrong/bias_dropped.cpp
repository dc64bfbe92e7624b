// caught by: hand-equations
// mistake: takes the Jacobian for constant.

// <solution accelerationBias>
static_cast<void>(S);
static_cast<void>(body);
return Eigen::Vector3d::Zero();
// </solution>
