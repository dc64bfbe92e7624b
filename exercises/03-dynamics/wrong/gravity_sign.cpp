// caught by: torque-equations, torque-hold, torque-other-arm
// mistake: F on the wrong side: gravity counts twice.

// <solution computedTorque>
return M * qdd - F;
// </solution>
