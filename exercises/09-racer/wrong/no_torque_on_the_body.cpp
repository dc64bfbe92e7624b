// caught by: forces, lagrangian
// mistake: the motor turns the wheel, and nothing turns the pendulum back.

// <solution controlDirection>
return {1 / racer.r, 0};
// </solution>
