// caught by: camera-linear, camera-any
// mistake: takes the left part of P for a rotation.

// <solution cameraPosition>
const Eigen::Vector3d last = P.col(3);
return -P.leftCols<3>().transpose() * last;
// </solution>
