#include "contact/contact_scenes.h"

#include <stdexcept>

namespace rex::contact {

std::vector<ContactScene> contactScenes() {
  std::vector<ContactScene> all;
  for (std::vector<ContactScene>& some : std::vector<std::vector<ContactScene>>{
           slidingScenes(), rollingScenes(), impactScenes(), turningScenes(), grippingScenes()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

double turningPoint(double lower, double upper, double width, const std::function<bool(double)>& holds) {
  while (upper - lower > width) {
    const double middle = (lower + upper) / 2;
    (holds(middle) ? upper : lower) = middle;
  }
  return (lower + upper) / 2;
}

Shape capsuleShape(double radius, double length) {
  Shape shape;
  shape.type = ShapeType::kCapsule;
  shape.radius = radius;
  shape.extent = {2 * radius, 2 * radius, length};
  return shape;
}

int shapeNamed(const Model& model, const std::string& name) {
  for (std::size_t i = 0; i < model.shapes().size(); ++i)
    if (model.shapes()[i].name == name) return static_cast<int>(i);
  throw std::logic_error("no shape " + name);
}

}  // namespace rex::contact
