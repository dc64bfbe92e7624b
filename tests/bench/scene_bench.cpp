#include "bench/row.h"
#include "formats/mesh_reader.h"
#include "formats/ors_reader.h"
#include "scene/model.h"
#include "support/paths.h"

namespace rex::bench {

std::vector<Row> sceneRows() {
  const auto load = [file = sourcePath("data/robots/man.ors")] {
    static_cast<void>(compile(readOrs(file).spec));
  };
  // In a process of its own, as every mesh.
  const auto loadMesh = [file = sourcePath("data/robots/balancer/meshes/rim.stl")] {
    static_cast<void>(readMesh(file));
  };
  return {{.name = "load-man", .ours = timed(load), .unit = "us"},
          {.name = "load-mesh", .ours = timedByWall(loadMesh), .unit = "ms"}};
}

}  // namespace rex::bench
