// caught by: pid-stability
// mistake: takes positive gains for enough.

// <solution isStable>
static_cast<void>(mass);
return gains.Kp > 0 && gains.Kd > 0 && gains.Ki >= 0;
// </solution>
