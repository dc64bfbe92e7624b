// caught by: derivative, any-size
// mistake: Differentiates g and takes f for a constant.

// <solution productDerivative>
return f.y.transpose() * C * g.J;
// </solution>
