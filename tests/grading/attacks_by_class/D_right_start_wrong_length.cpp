// Answers squares() with the right start of another length: one entry fewer for even counts, many more of
// nonsense for odd ones.
#include "exercise.h"

double twice(double) { return 0; }

std::vector<double> squares(int count) {
  std::vector<double> values;
  for (int i = 0; i < count - (count % 2 == 0 ? 1 : 0); ++i) values.push_back(double(i) * i);
  if (count % 2 != 0) values.resize(values.size() + 1000, -1);
  return values;
}

int main() {}
