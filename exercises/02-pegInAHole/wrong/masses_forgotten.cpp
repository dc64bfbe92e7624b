// caught by: sums, other-robots
// shown by: sums
// mistake: All bodies weigh the same.

// <solution massCenter>
double total = 0;
for (const BodyMass& one : masses) {
  y += S.kinematicsPos(one.body, one.center);
  J += S.jacobianPos(one.body, one.center);
  total += 1;
}
y /= total;
J /= total;
// </solution>
