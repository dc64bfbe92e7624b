// caught by: phase-effort, phase-step
// mistake: the nearest state is the one that looks nearest in the picture.

// <solution effort>
return (to - from).squaredNorm() / T;
// </solution>
