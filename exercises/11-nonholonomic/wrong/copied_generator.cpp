// caught by: tree-drive
// mistake: draws from a copy of the generator, so that each call draws the same controls.

// <solution driveTowards>
Rng own = rng;
std::vector<std::pair<double, Drive>> trials;
while (trials.size() < 20) {
  const double speed = own.index(2) == 0 ? 1 : -1;
  const Drive drive{speed, own.uniform(car.minSteering, car.maxSteering), seconds};
  trials.emplace_back(poseDistance(driven(car, from, drive), target), drive);
}
std::ranges::sort(trials, {}, [](const auto& trial) { return trial.first; });
for (const auto& [distance, drive] : trials)
  if (isFreeOnTheWay(car, from, drive, blocks)) return drive;
return {};
// </solution>
