#include "bench/ik_boxes.h"

#include <algorithm>

#include "collision/contact_batch.h"
#include "collision/proximity.h"
#include "geometry/rotation.h"
#include "kinematics/forward_kinematics.h"
#include "scene/urdf_reader.h"
#include "support/file_text.h"
#include "support/paths.h"

namespace rex::bench {
namespace {

constexpr double kTolerance = 1e-5;  // metres and radians

// Around the arm, but not where it stands.
Model armAmongBoxes(Rng& rng) {
  constexpr int kBoxes = 10;
  SceneSpec spec = parseUrdf(fileText(sourcePath("data/robots/arm7dof/arm7dof.urdf")), "arm7dof.urdf").spec;
  for (int i = 0; i < kBoxes; ++i) {
    const double turn = rng.uniform(-3.1, 3.1), way = rng.uniform(0.45, 0.9);
    ShapeSpec box{.name = "box" + std::to_string(i), .X_BS = {}, .shape = {.type = ShapeType::kBox}};
    box.shape.extent = rng.uniformVector(3, 0.05, 0.25);
    box.X_BS = {expSO3(rng.normalVector(3)), {way * std::cos(turn), way * std::sin(turn), rng.uniform(0, 1)}};
    box.contact = true;
    spec.worldShapes.push_back(box);
  }
  return compile(spec);
}

bool isFree(const ContactModel& contacts, const Model& model, const Eigen::VectorXd& q) {
  PoseBatch poses;
  forwardKinematicsBatch(model, q, poses);
  return allContactFree(contacts, poses, 0);
}

}  // namespace

IkAmongBoxes::IkAmongBoxes(int poses)
    : model([] {
        Rng rng(7);
        return armAmongBoxes(rng);
      }()),
      contacts(model),
      tip(model.body("flange")),
      middle(0.5 * (model.lowerLimits() + model.upperLimits())) {
  Rng rng(8);
  Eigen::VectorXd q(model.nq());
  while (targets.size() < static_cast<std::size_t>(poses)) {
    for (Eigen::Index i = 0; i < q.size(); ++i)
      q[i] = rng.uniform(model.lowerLimits()[i], model.upperLimits()[i]);
    if (isFree(contacts, model, q)) targets.push_back(forwardKinematics(model, q)[tip]);
  }
}

InverseKinematicsResult solve(const IkAmongBoxes& problem, std::size_t k) {
  Rng rng(k);
  const PoseTarget target{
      .body = problem.tip,
      .X_WB = problem.targets[k],
      .tolerance = kTolerance,
      .isAllowed = [&](const Eigen::VectorXd& q) { return isFree(problem.contacts, problem.model, q); }};
  return solveInverseKinematics(problem.model, target, problem.middle, {.maxRestarts = 500}, rng);
}

bool isRight(const IkAmongBoxes& problem, std::size_t k, const Eigen::VectorXd& q) {
  const Model& model = problem.model;
  if ((q.array() < model.lowerLimits().array()).any() || (q.array() > model.upperLimits().array()).any())
    return false;
  const BodyPoses poses = forwardKinematics(model, q);
  const Pose &X_WT = problem.targets[k], X_WB = poses[problem.tip];
  const double turn = logSO3(X_WB.R * X_WT.R.transpose()).lpNorm<Eigen::Infinity>();
  if (std::max(turn, (X_WB.p - X_WT.p).lpNorm<Eigen::Infinity>()) > kTolerance * (1 + 1e-6)) return false;
  const auto placed = [&](int shape) {
    const ModelShape& at = model.shapes()[static_cast<std::size_t>(shape)];
    return poses[at.body] * at.X_BS;
  };
  const auto shape = [&](int i) -> const Shape& { return model.shapes()[static_cast<std::size_t>(i)].shape; };
  return std::ranges::all_of(problem.contacts.pairs(), [&](const ShapePair& pair) {
    return proximity(shape(pair.a), placed(pair.a), shape(pair.b), placed(pair.b)).distance >= -1e-9;
  });
}

}  // namespace rex::bench
