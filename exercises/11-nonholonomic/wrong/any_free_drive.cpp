// caught by: tree-drive
// mistake: returns the first control whose way is free.

// <solution driveTowards>
std::vector<std::pair<double, Drive>> trials;
while (trials.size() < 20) {
  const double speed = rng.index(2) == 0 ? 1 : -1;
  const Drive drive{speed, rng.uniform(car.minSteering, car.maxSteering), seconds};
  trials.emplace_back(poseDistance(driven(car, from, drive), target), drive);
}
for (const auto& [distance, drive] : trials)
  if (isFreeOnTheWay(car, from, drive, blocks)) return drive;
return {};
// </solution>
