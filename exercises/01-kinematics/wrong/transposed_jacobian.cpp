// Following the transposed Jacobian goes downhill, but not by the right step.
// caught by: step-hand, step-any-size

// <solution ikStep>
return J.transpose() * dy / (sigma * sigma + J.squaredNorm());
// </solution>
