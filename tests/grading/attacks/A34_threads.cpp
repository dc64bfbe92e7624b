// Threads that take processor time behind one's back.
#include <thread>

#include "exercise.h"

double twice(double) {
  for (int k = 0; k < 4; ++k)
    std::thread([] {
      for (volatile int j = 0;; j = j + 1) {
      }
    }).detach();
  for (volatile int j = 0;; j = j + 1) {
  }
}
std::vector<double> squares(int) { return {}; }
int main() {}
