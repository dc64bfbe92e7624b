// caught by: interpolation
// mistake: Counting from zero, the motion begins with its start and never arrives.

// <solution jointSpaceMotion>
for (int t = 0; t < T; ++t) postures.push_back(q0 + sineProfile(static_cast<double>(t) / T) * (qT - q0));
// </solution>
