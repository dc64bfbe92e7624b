// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant clockwise> caught by: quarter-turn
// shown by: quarter-turn
// mistake: turns clockwise.
// <solution rotated>
const double c = std::cos(angle);
const double s = std::sin(angle);
return {c * p.x() + s * p.y(), c* p.y() - s* p.x()};

// <variant library> caught by: forbidden-call
// mistake: lets the library rotate.
// <solution introduction>
#include "geometry/rotation.h"
// <solution rotated>
const Eigen::Matrix3d R = rex::rotationAboutAxis(angle, Eigen::Vector3d::UnitZ());
return R.topLeftCorner<2, 2>() * p;
