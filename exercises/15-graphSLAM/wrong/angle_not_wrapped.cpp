// caught by: error-edges, error-turns, adjust-turns
// mistake: takes the difference of two headings without wrapping it.

// <solution wrapped>
return angle;
// </solution>
