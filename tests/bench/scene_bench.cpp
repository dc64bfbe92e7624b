#include "bench/row.h"
#include "scene/model.h"
#include "scene/ors_reader.h"
#include "support/paths.h"

namespace rex::bench {

std::vector<Row> sceneRows() {
  const auto load = [file = sourcePath("data/robots/man.ors")] {
    static_cast<void>(compile(readOrs(file).spec));
  };
  return {{.name = "load-man", .ours = timed(load), .unit = "us"}};
}

}  // namespace rex::bench
