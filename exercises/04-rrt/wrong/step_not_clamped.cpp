// caught by: step-nearest
// mistake: line 5 of slide 4:39 as printed: it overshoots near targets, and divides by zero at the target.

// <solution stepTowards>
return from + stepSize / (target - from).norm() * (target - from);
// </solution>
