// caught by: lyapunov, judges-others
// mistake: the level where the ellipsoid leaves the box along an axis. It leaves earlier elsewhere.

// <solution levelInside>
return (P.diagonal().array() * high.array().square()).minCoeff();
// </solution>
