// caught by: error-edges
// mistake: subtracts the measurement from the pose that is seen, component by component.

// <solution edgeError>
const Eigen::Vector3d difference = seenFrom(i, j) - z;
return {difference[0], difference[1], wrapped(difference[2])};
// </solution>
