// caught by: conjugate, beliefs-elsewhere
// mistake: Predicts with the most likely mu, which ignores how uncertain mu is.

// <solution nextOutcome>
return (alpha.array() - 1) / (alpha.sum() - static_cast<double>(alpha.size()));
// </solution>
