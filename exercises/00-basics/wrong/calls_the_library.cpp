// caught by: forbidden-call
// mistake: The library solves the equation, so nothing was learnt.

// <solution equationC>
return leastSquares(A, y);
// </solution>
