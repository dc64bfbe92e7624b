// caught by: pid-stability
// mistake: Without an integral the condition for three roots is still used.

// <solution isStable>
return gains.Ki > 0 && gains.Kd > 0 && gains.Kd* gains.Kp > mass* gains.Ki;
// </solution>
