#pragma once

#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "scene/scene_spec.h"

namespace rex::urdf {

/// What a format cannot say, one note for each kind.
class Losses {
 public:
  void add(const std::string& kind, const std::string& name, const SourceLocation& where);
  [[nodiscard]] Diagnostics take() const;

 private:
  struct Loss {
    std::string kind, first;
    SourceLocation where;
    int count = 0;
  };
  std::vector<Loss> losses_;
};

/// The same scene with joints as URDF has them: hinges, sliders, rigid, free, and planar ones whose `axis` is
/// the normal; all with X_MC = 1. Other joints become chains over massless bodies. Without a single root at
/// the identity, or with shapes of the world, all roots hang on joints of the parent "world". Massless links
/// fill up chains, so that the first coordinates of joints keep compile()'s order.
[[nodiscard]] SceneSpec expand(const SceneSpec& spec, Losses& losses);

}  // namespace rex::urdf
