// caught by: pid-step
// mistake: what was accumulated while the controller was off still counts.

// <solution pidStep>
const double u = pdForce(at, wanted, {gains.Kp, gains.Kd}) + gains.Ki * integral;
return {u, integral + tau*(wanted.q - at.q)};
// </solution>
