// caught by: tree-overlap, tree-drive, park-kerb, park-any
// shown by: tree-overlap, park-kerb
// mistake: tests the point between the rear wheels only.

// <solution isFree>
for (const Block& block : blocks) {
  const double dx = q[0] - block.middle[0], dy = q[1] - block.middle[1];
  const double c = std::cos(block.middle[2]), s = std::sin(block.middle[2]);
  if (std::abs(dx * c + dy * s) < block.length / 2 && std::abs(dy * c - dx * s) < block.width / 2)
    return false;
}
return true;
// </solution>
