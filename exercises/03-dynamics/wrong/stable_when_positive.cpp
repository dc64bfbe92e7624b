// caught by: pid-stability
// mistake: takes positive gains for enough.

// <solution isStable>
return gains.Kp > 0 && gains.Kd > 0 && gains.Ki >= 0;
// </solution>
