// caught by: propagation, beliefs-elsewhere
// shown by: propagation
// mistake: The noise of the dynamics adds nothing to the covariance.

// <solution propagated>
return {a + F * y.mean, F* y.cov* F.transpose()};
// </solution>
