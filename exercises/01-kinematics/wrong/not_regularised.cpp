// Without sigma the step explodes, or the matrix has no inverse, when the arm is stretched out.
// caught by: step-singular, step-hand

// <solution ikStep>
return J.transpose() * solve(J * J.transpose(), dy);
// </solution>
