// caught by: product, beliefs-elsewhere
// shown by: product
// mistake: Adds covariances instead of precisions: two sources of knowledge would say less than one.

// <solution product>
const Eigen::MatrixXd precisionP = inverse(p.cov), precisionQ = inverse(q.cov);
return {inverse(precisionP + precisionQ) * (precisionP * p.mean + precisionQ * q.mean), p.cov + q.cov};
// </solution>
