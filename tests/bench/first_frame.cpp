// first_frame FILE: loads the man scene and writes a picture of it, as a user's first program does.
#include "formats/ors_reader.h"
#include "kinematics/forward_kinematics.h"
#include "render/image.h"
#include "render/picture.h"
#include "scene/model.h"
#include "support/draw_once.h"
#include "support/paths.h"

int main(int argc, char** argv) {
  using namespace rex;
  if (argc != 2) return 64;
  const Model model = compile(readOrs(sourcePath("data/robots/man.ors")).spec);
  writePng(drawOnce(scenePicture(model, forwardKinematics(model, model.initialPositions()))), argv[1]);
  return 0;
}
