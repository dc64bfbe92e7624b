// caught by: features, unseen-features
// mistake: gives the factor of the average to the new reading.

// <solution featuresAt>
Eigen::VectorXd now = Eigen::VectorXd::Zero(kFeatures);
now[0] = 1;
now.segment<4>(1) = now.segment<4>(9) = now.segment<4>(17) = y;
if (before.size() == 0) return now;
now.segment<4>(5) = (y - before.segment<4>(1)) / tau;
now.segment<8>(9) = .5 * (before.segment<8>(9) + now.segment<8>(1));
now.segment<8>(17) = .1 * before.segment<8>(17) + .9 * now.segment<8>(1);
now[25] = u;
now[26] = before[25];
return now;
// </solution>
