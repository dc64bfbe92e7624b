// caught by: filter-step, tracks, consistent, finds-heading, noise, noise-elsewhere
// mistake: all particles become the likeliest one, so that what the others knew is lost

// <solution filterStep>
after.states = moved(before.states, u, world, rng);
Eigen::Index best = 0;
logLikelihoods(after.states, y, world).maxCoeff(&best);
const Eigen::Vector3d likeliest = after.states.col(best);
after.states.colwise() = likeliest;
after.weights.setConstant(1. / static_cast<double>(after.weights.size()));
// </solution>

// <solution likelyNoise>
const double told = world.observationNoise;
return told > 1.5 ? told / 10 : told < 0.15 ? told * 10 : told;
// </solution>
