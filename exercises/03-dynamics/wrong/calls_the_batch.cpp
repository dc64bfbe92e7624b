// caught by: forbidden-call
// mistake: asks the library about an arm that happens to be of the same size, as one of many.

// <solution newtonEuler>
inverseDynamicsBatch(Simulator("pegArm2.ors").model(), q, v, a, u, gravity);
// </solution>
