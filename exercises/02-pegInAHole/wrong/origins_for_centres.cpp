// caught by: sums, other-robots
// mistake: The masses are at the origins of the bodies.

// <solution massCenter>
double total = 0;
for (const BodyMass& one : masses) {
  y += one.mass * S.kinematicsPos(one.body);
  J += one.mass * S.jacobianPos(one.body);
  total += one.mass;
}
y /= total;
J /= total;
// </solution>
