#include "bench/contact_scene.h"

#include <algorithm>
#include <stdexcept>

#include "base/rng.h"
#include "formats/ors_reader.h"
#include "support/paths.h"

namespace rex::bench {
namespace {

std::vector<ShapePair> armAndFrame(const Model& model) {
  std::vector<int> capsules, boxes;
  for (int i = 0; i < static_cast<int>(model.shapes().size()); ++i) {
    const ModelShape& shape = model.shapes()[static_cast<std::size_t>(i)];
    if (shape.shape.type == ShapeType::kBox) boxes.push_back(i);
    if (shape.shape.type == ShapeType::kCapsule && model[shape.body].joint != kNoJoint) capsules.push_back(i);
  }
  std::vector<ShapePair> pairs;
  for (auto a = capsules.begin(); a != capsules.end(); ++a) {
    for (const int b : boxes) pairs.push_back({std::min(*a, b), std::max(*a, b)});
    for (auto b = a + 1; b != capsules.end(); ++b)
      if (b != a + 1) pairs.push_back({*a, *b});
  }
  return pairs;
}

}  // namespace

ContactScene::ContactScene()
    : model(compile(readOrs(sourcePath("data/robots/pegInAHole.ors")).spec)),
      contacts(model, armAndFrame(model)) {
  if (contacts.pairs().size() != 43) throw std::logic_error("the scene of the benchmark has changed");
  Rng rng(2);
  Q.resize(model.nq(), kPostures);
  for (auto q : Q.colwise()) {
    q = rng.uniformVector(model.nq(), -2, 2);
    poses.push_back(forwardKinematics(model, q));
  }
  forwardKinematicsBatch(model, Q, batch);
  contactDistancesBatch(contacts, batch, distances);
}

void requireAgreement(const std::string& name, const ContactScene& scene, const ContactPeer& peer,
                      double tolerance) {
  for (int k = 0; k < ContactScene::kPostures; ++k) {
    const double nearest = scene.distances.col(k).minCoeff();
    if (std::abs(nearest) > tolerance && peer(k) != (nearest < 0))
      throw std::logic_error(name + ": contacts differ from ours");
  }
}

}  // namespace rex::bench
