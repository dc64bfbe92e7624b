#include <memory>

#include "bench/contact_scene.h"
#include "bench/row.h"

namespace rex::bench {
namespace {

// The time for one posture of work that takes all of them.
Measurement perPosture(std::function<void()> work) {
  return [all = timed(std::move(work))] { return all() / ContactScene::kPostures; };
}

Measurement inTurn(const ContactPeer& peer) {
  if (!peer) return {};
  return perPosture([peer] {
    for (int k = 0; k < ContactScene::kPostures; ++k) static_cast<void>(peer(k));
  });
}

}  // namespace

std::vector<Row> collisionRows() {
  const auto scene = std::make_shared<ContactScene>();
  const Measurement fcl = inTurn(fclPeer(*scene));
  const auto free = [scene, out = Eigen::Array<bool, Eigen::Dynamic, 1>()]() mutable {
    contactFreeBatch(scene->contacts, scene->batch, 0, out);
  };
  // One configuration after the other, as those who ask about one do.
  const auto ones = std::make_shared<std::vector<PoseBatch>>(ContactScene::kPostures);
  for (int k = 0; k < ContactScene::kPostures; ++k)
    forwardKinematicsBatch(scene->model, scene->Q.col(k), (*ones)[static_cast<std::size_t>(k)]);
  const auto freeInTurn = [scene, ones] {
    for (const PoseBatch& one : *ones) static_cast<void>(allContactFree(scene->contacts, one, 0));
  };
  return {{"contact-free-batch-arm7", perPosture(free), "FCL", fcl, 0.15},
          {"contact-free-arm7", perPosture(freeInTurn), "FCL", fcl}};
}

}  // namespace rex::bench
