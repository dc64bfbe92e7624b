// caught by: camera-refined, camera-any
// mistake: solves the linear equations again.

// <solution refined>
best = projectionFromPoints(points, pixels);
// </solution>
