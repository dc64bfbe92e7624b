// caught by: hold-arm, hold-other-masses
// mistake: twice the damping: within 10 ms it throws the last joint to the other side.

// <solution holdArm>
// The first joint carries most. More damping does not help: what a joint moves alone, without the others,
// has little inertia, and within tau the damping would throw it to the other side.
const Eigen::Vector3d Kp(45, 20, 7), Kd(6, 2.5, 0.8);
return -Kp.cwiseProduct(q) - Kd.cwiseProduct(v);
// </solution>
