// caught by: names-found, names-any
// shown by: names-found
// mistake: looks for the nearest landmark in metres (or radians), however uncertain each of them is.

// <solution assigned>
for (std::size_t k = 0; k < ys.size(); ++k) {
  double nearest = 4;
  int name = kNewLandmark;
  for (int i = 0; 3 + 2 * i < joint.mean.size(); ++i) {
    const double distance = viewGap(car, ys[k], expectedView(car, joint, i).y).norm();
    if (distance >= nearest || std::find(names.begin(), names.end(), i) != names.end()) continue;
    nearest = distance;
    name = i;
  }
  names[k] = name;
}
// </solution>
