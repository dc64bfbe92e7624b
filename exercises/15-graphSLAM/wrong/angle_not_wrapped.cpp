// caught by: error-frames, error-turns, adjust-turns
// mistake: the difference of two headings is taken as it is.

// <solution wrapped>
return angle;
// </solution>
