// caught by: tree-drive
// mistake: tests where a drive ends, not the way there.

// <solution isFreeOnTheWay>
bool isFreeOnTheWay(CarModel car, const Eigen::Vector3d& from, const Drive& drive,
                    const std::vector<Block>& blocks) {
  return isFree(car, driven(car, from, drive), blocks);
}
// </solution>
