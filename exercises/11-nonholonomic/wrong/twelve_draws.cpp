// caught by: tree-drive
// mistake: returns the best of twelve controls instead of twenty.

// <solution driveTowards>
std::vector<std::pair<double, Drive>> trials;
for (int i = 0; i < 12; ++i) {
  const double speed = rng.index(2) == 0 ? 1 : -1;
  const Drive drive{speed, rng.uniform(car.minSteering, car.maxSteering), seconds};
  trials.emplace_back(poseDistance(driven(car, from, drive), target), drive);
}
std::ranges::sort(trials, {}, [](const auto& trial) { return trial.first; });
for (const auto& [distance, drive] : trials)
  if (isFreeOnTheWay(car, from, drive, blocks)) return drive;
return {};
// </solution>
