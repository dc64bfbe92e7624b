#include "bench/shapes_scene.h"

#include "base/rng.h"
#include "geometry/rotation.h"

namespace rex::bench {

std::vector<Solid> sixtyShapes() {
  Rng rng(2);
  std::vector<Solid> solids;
  const auto add = [&](int count, ShapeType type, const Eigen::Vector3d& extent, double radius) {
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d p(rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5), rng.uniform(0.3, 1.3));
      const Color color{static_cast<float>(rng.uniform(0.2, 0.9)), 0.5f, 0.6f};
      solids.push_back(
          {.shape = {type, extent, radius}, .X_WS = {expSO3(rng.normalVector(3)), p}, .color = color});
    }
  };
  add(28, ShapeType::kCapsule, {0, 0, 0.3}, 0.07);
  add(12, ShapeType::kSphere, {0, 0, 0}, 0.12);
  add(20, ShapeType::kBox, {0.2, 0.15, 0.25}, 0);
  return solids;
}

}  // namespace rex::bench
