// The library does the step, so nothing was learnt.
// caught by: forbidden

// <solution ikStep>
return inverseKinematicsStep(J, dy, sigma);
// </solution>
