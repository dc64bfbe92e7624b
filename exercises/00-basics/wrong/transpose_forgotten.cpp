// caught by: square-equations, any-size
// mistake: Transposes X and B, but not the matrix it divides by.

// <solution equationB>
return solve(C - 2 * A.transpose(), 2 * A * B);
// </solution>
