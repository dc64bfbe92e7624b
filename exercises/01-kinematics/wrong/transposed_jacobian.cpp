// caught by: step-hand, step-any-size
// mistake: Following the transposed Jacobian goes downhill, but not by the right step.

// <solution ikStep>
return J.transpose() * dy / (sigma * sigma + J.squaredNorm());
// </solution>
