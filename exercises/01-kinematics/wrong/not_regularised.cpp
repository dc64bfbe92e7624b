// caught by: step-singular, step-hand
// mistake: Without sigma the step explodes, or the matrix has no inverse, when the arm is stretched out.

// <solution ikStep>
return J.transpose() * solve(J * J.transpose(), dy);
// </solution>
