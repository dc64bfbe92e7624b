// caught by: boxes, bayes-elsewhere
// mistake: counts the apples of all boxes as if a fruit were drawn: the same only for equal boxes

// <solution fruitBoxes>
double appleCount = 0, count = 0;
for (std::size_t i = 0; i < apples.size(); ++i) {
  appleCount += apples[i];
  count += apples[i] + oranges[i];
}
fruit.apple = appleCount / count;
for (std::size_t i = 0; i < apples.size(); ++i) {
  fruit.boxGivenApple[static_cast<Eigen::Index>(i)] = apples[i] / appleCount;
}
// </solution>
