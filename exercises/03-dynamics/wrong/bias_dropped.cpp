// caught by: hand-equations
// mistake: treats the Jacobian as constant.

// <solution accelerationBias>
return Eigen::Vector3d::Zero();
// </solution>
