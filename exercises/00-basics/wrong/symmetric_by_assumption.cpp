// caught by: derivative, any-size
// mistake: The second term lacks the transpose of C, which is right for a symmetric C only.

// <solution productDerivative>
return f.y.transpose() * C * g.J + g.y.transpose() * C * f.J;
// </solution>
