#include "course/plot.h"

namespace rex {

void plot(const std::string& name, const Figure& figure) {
  writeFigure(figure, name + ".png");
  writeFigure(figure, name + ".svg");
}

}  // namespace rex
