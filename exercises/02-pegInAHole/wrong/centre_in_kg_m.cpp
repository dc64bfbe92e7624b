// caught by: sums, other-robots
// mistake: The sum of slide 2:61 as printed: not divided by the mass.

// <solution massCenter>
for (const BodyMass& one : masses) {
  y += one.mass * S.kinematicsPos(one.body, one.center);
  J += one.mass * S.jacobianPos(one.body, one.center);
}
// </solution>
