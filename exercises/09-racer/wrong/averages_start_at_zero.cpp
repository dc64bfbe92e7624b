// caught by: features, unseen-features
// mistake: the averages begin with zero instead of the first reading.

// <solution featuresAt>
const Eigen::VectorXd last = before.size() > 0 ? before : Eigen::VectorXd::Zero(kFeatures);
Eigen::VectorXd now = Eigen::VectorXd::Zero(kFeatures);
now[0] = 1;
now.segment<4>(1) = y;
if (before.size() > 0) now.segment<4>(5) = (y - last.segment<4>(1)) / tau;
now.segment<8>(9) = .5 * last.segment<8>(9) + .5 * now.segment<8>(1);
now.segment<8>(17) = .9 * last.segment<8>(17) + .1 * now.segment<8>(1);
if (before.size() > 0) now[25] = u;
now[26] = last[25];
return now;
// </solution>
