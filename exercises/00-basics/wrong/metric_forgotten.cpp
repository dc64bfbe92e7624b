// caught by: minimum, any-size
// mistake: The right side lacks C, so x is the minimum of another cost.

// <solution quadraticMinimum>
const Eigen::VectorXd x = solve(A.transpose() * C * A + B, A.transpose() * y);
const Eigen::VectorXd e = A * x - y;
return {x, e.dot(C* e) + x.dot(B* x)};
// </solution>
