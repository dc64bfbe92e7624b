// caught by: camera-linear, camera-any
// mistake: forgets the minus sign.

// <solution cameraPosition>
return solve(P.leftCols<3>(), P.col(3));
// </solution>
