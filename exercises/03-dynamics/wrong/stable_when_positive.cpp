// caught by: pid-stability
// mistake: takes positive gains to be sufficient.

// <solution isStable>
return gains.Kp > 0 && gains.Kd > 0 && gains.Ki >= 0;
// </solution>
