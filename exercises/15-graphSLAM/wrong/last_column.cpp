// caught by: camera-linear, camera-any
// mistake: takes the last column of P for the position.

// <solution cameraPosition>
return P.col(3);
// </solution>
