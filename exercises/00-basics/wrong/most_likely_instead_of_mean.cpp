// caught by: conjugate, beliefs-elsewhere
// mistake: Predicts with the most likely mu, which leaves out how much is not known.

// <solution nextOutcome>
return (alpha.array() - 1) / (alpha.sum() - static_cast<double>(alpha.size()));
// </solution>
