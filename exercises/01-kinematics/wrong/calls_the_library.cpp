// caught by: forbidden-call
// mistake: The library does the step, so nothing was learnt.

// <solution ikStep>
return inverseKinematicsStep(J, dy, sigma);
// </solution>
