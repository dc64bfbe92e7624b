// caught by: tree-overlap
// shown by: tree-overlap
// mistake: tests the corners of the car only.

// <solution isFree>
for (const Block& block : blocks)
  for (const double along : {car.front, -car.back})
    for (const double across : {car.width / 2, -car.width / 2}) {
      const double dx = q[0] + along * std::cos(q[2]) - across * std::sin(q[2]) - block.middle[0];
      const double dy = q[1] + along * std::sin(q[2]) + across * std::cos(q[2]) - block.middle[1];
      const double c = std::cos(block.middle[2]), s = std::sin(block.middle[2]);
      if (std::abs(dx * c + dy * s) < block.length / 2 && std::abs(dy * c - dx * s) < block.width / 2)
        return false;
    }
return true;
// </solution>
