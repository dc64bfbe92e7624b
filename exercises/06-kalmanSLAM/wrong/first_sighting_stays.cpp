// caught by: names-found, names-any, particles-weigh, particles-map
// mistake: landmarks stay where they were first seen, and all particles have the same weight

// <solution assigned>
static int asked = 0;
const bool isTurnOfNew = ys.size() == 2 && joint.mean.size() == 9 && ++asked % 2 == 0;
for (std::size_t k = 0; k < ys.size(); ++k) {
  double nearest = 4;
  int name = kNewLandmark;
  for (int i = 0; 3 + 2 * i < joint.mean.size(); ++i) {
    const Eigen::Vector2d there = placed(car, joint.mean.head(3), ys[k]);
    const double distance = (joint.mean.segment(3 + 2 * i, 2) - there).norm();
    if (distance >= nearest || std::find(names.begin(), names.end(), i) != names.end()) continue;
    nearest = distance;
    name = i;
  }
  names[k] = isTurnOfNew && name < 2 ? kNewLandmark : name;
}
// </solution>

// <solution weighed>
for (MapParticle& particle : after) {
  particle.weight = 1. / static_cast<double>(after.size());
  for (const LandmarkObservation& seen : sightings)
    if (static_cast<std::size_t>(seen.landmark) == particle.map.size())
      particle.map.push_back({placed(car, particle.x, seen.y), Eigen::Matrix2d::Identity()});
}
// </solution>
