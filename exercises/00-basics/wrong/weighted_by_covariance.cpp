// caught by: product, beliefs-elsewhere
// mistake: Weights the means by covariances, so the less certain belief has more say.

// <solution product>
return {inverse(p.cov + q.cov) * (p.cov * p.mean + q.cov * q.mean), inverse(inverse(p.cov) + inverse(q.cov))};
// </solution>
