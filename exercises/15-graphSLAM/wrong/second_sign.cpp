// caught by: error-derivatives, equations-normal, adjust-streets
// mistake: the derivative by pose j has the sign of that by pose i.

// <solution edgeJacobians>
const double c = std::cos(i[2] + z[2]), s = std::sin(i[2] + z[2]);
const double x = j[0] - i[0], y = j[1] - i[1];
jacobians.byJ << c, s, 0, -s, c, 0, 0, 0, 1;
jacobians.byI = -jacobians.byJ;
// Where pose i turns, pose j goes around it the other way.
jacobians.byI(0, 2) = c * y - s * x;
jacobians.byI(1, 2) = -c * x - s * y;
jacobians.byJ = -jacobians.byJ;
// </solution>
