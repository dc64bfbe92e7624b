// A whole program in the style of older course material, for scripts/legacy.
#include "legacy/legacy.h"

void reach(const arr& y_target) {
  Simulator S("man.ors");
  arr q, y, J, W;
  W.setDiag(1e-4, S.getJointDimension());
  S.getJointAngles(q);
  S.watch();
  for (uint i = 0; i < MT::getParameter<int>("steps", 10); i++) {
    S.kinematicsPos(y, "handR");
    S.jacobianPos(J, "handR");
    q += inverse(~J * J + W) * ~J * (y_target - y);
    S.setJointAngles(q);
  }
  S.watch(true, "reached");
  S.kinematicsPos(y, "handR");
  cout << "error: " << (length(y - y_target) < 1e-6 ? "none" : "some") << endl;
}

int main(int argc, char** argv) {
  MT::initCmdLine(argc, argv);
  reach(ARR(-0.2, -0.4, 1.1));
}
