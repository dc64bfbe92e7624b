// caught by: point-step
// mistake: semi-implicit: the point already moves with the velocity after the step.

// <solution eulerStep>
const double v = at.v + tau * u / mass;
return {at.q + tau * v, v};
// </solution>
