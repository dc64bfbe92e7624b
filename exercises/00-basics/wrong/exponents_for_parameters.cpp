// caught by: conjugate, beliefs-elsewhere
// mistake: Returns the exponents of mu, which are the parameters less one.

// <solution dirichletPosterior>
for (const int x : data) posterior[x - 1] += 1;
posterior.array() -= 1;
// </solution>
