// caught by: tree-drive
// mistake: chooses the control by the position that it leads to, not by the heading.

// <solution driveTowards>
std::vector<std::pair<double, Drive>> trials;
while (trials.size() < 20) {
  const double speed = rng.index(2) == 0 ? 1 : -1;
  const Drive drive{speed, rng.uniform(car.minSteering, car.maxSteering), seconds};
  trials.emplace_back((driven(car, from, drive) - target).head<2>().norm(), drive);
}
std::ranges::sort(trials, {}, [](const auto& trial) { return trial.first; });
for (const auto& [distance, drive] : trials)
  if (isFreeOnTheWay(car, from, drive, blocks)) return drive;
return {};
// </solution>
