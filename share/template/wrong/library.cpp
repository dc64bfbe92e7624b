// caught by: forbidden-call
// mistake: lets the library rotate.

// <solution introduction>
#include "geometry/rotation.h"
// </solution>

// <solution rotated>
const Eigen::Matrix3d R = rex::rotationAboutAxis(angle, Eigen::Vector3d::UnitZ());
return R.topLeftCorner<2, 2>() * p;
// </solution>
