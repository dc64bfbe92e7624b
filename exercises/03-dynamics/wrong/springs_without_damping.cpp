// caught by: hold-arm, hold-other-masses
// shown by: hold-arm
// mistake: no Kd: the held force feeds the oscillation.

// <solution holdArm>
return -Eigen::Vector3d(45, 20, 7).cwiseProduct(q);
// </solution>
