// caught by: tall-equations, any-size
// mistake: Leaves B out, as if d were c.

// <solution equationD>
return solve(A.transpose() * A, A.transpose() * y);
// </solution>
