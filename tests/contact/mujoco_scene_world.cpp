#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include "bench/mujoco_model.h"
#include "contact/scene_world.h"
#include "geometry/rotation.h"

namespace rex::contact {
namespace {

std::string numbersOf(const Eigen::VectorXd& values) {
  std::string text;
  for (const double value : values) text += fmt::format("{}{:.17g}", text.empty() ? "" : " ", value);
  return text;
}

std::string poseXml(const Pose& X) {
  return fmt::format(R"(pos="{}" quat="{}")", numbersOf(X.p), numbersOf(quaternionFromRotation(X.R)));
}

std::string geomXml(const ModelShape& shape, std::size_t index, double friction) {
  const Shape& solid = shape.shape;
  std::string kind;
  if (solid.type == ShapeType::kBox)
    kind = fmt::format(R"(type="box" size="{}")", numbersOf(solid.extent / 2));
  else if (solid.type == ShapeType::kSphere)
    kind = fmt::format(R"(type="sphere" size="{:.17g}")", solid.radius);
  else
    kind = fmt::format(R"(type="capsule" size="{:.17g} {:.17g}")", solid.radius, solid.extent.z() / 2);
  return fmt::format(R"(<geom name="s{}" {} {} friction="{:.17g} 0 0" mass="0"/>)", index, kind,
                     poseXml(shape.X_BS), friction);
}

std::string jointXml(const Joint& joint) {
  const Pose X_CM = joint.X_MC.inverse();
  if (joint.type == JointType::kFree) return fmt::format(R"(<freejoint name="{}"/>)", joint.name);
  if (joint.type == JointType::kBall)
    return fmt::format(R"(<joint name="{}" type="ball" pos="{}"/>)", joint.name, numbersOf(X_CM.p));
  return fmt::format(R"(<joint name="{}" type="{}" axis="{}" pos="{}" damping="{:.17g}"/>)", joint.name,
                     joint.type == JointType::kHinge ? "hinge" : "slide", numbersOf(X_CM.R * joint.axis),
                     numbersOf(X_CM.p), joint.damping);
}

std::string bodyXml(const Model& model, BodyId id, double friction) {
  std::string xml;
  const Body& body = model[id];
  if (id != kWorld) {
    const Joint& joint = model[body.joint];
    xml +=
        fmt::format(R"(<body name="{}" {}>{})", body.name, poseXml(joint.X_PF * joint.X_MC), jointXml(joint));
    xml += fmt::format(R"(<inertial mass="{:.17g}" pos="{}" diaginertia="{}"/>)", body.mass,
                       numbersOf(body.p_BBcm), numbersOf(body.I_BBcm_B.diagonal()));
  }
  for (std::size_t i = 0; i < model.shapes().size(); ++i)
    if (model.shapes()[i].body == id && model.shapes()[i].contact)
      xml += geomXml(model.shapes()[i], i, friction);
  for (int child = 1; child < static_cast<int>(model.bodies().size()); ++child)
    if (model[BodyId{child}].parent == id) xml += bodyXml(model, BodyId{child}, friction);
  return id == kWorld ? xml : xml + "</body>";
}

// Joints that mimic are held by MuJoCo's equalities, as pins are.
std::string equalityXml(const Model& model) {
  std::string xml;
  for (const Joint& joint : model.joints()) {
    if (!joint.mimics) continue;
    for (const Joint& leader : model.joints())
      if (!leader.mimics && leader.qIndex == joint.qIndex)
        xml += fmt::format(R"(<joint joint1="{}" joint2="{}" polycoef="{:.17g} {:.17g} 0 0 0"/>)", joint.name,
                           leader.name, joint.offset, joint.ratio);
  }
  for (const Pin& pin : model.pins()) {
    const bool hasA = pin.a != kWorld;
    const BodyId a = hasA ? pin.a : pin.b, b = hasA ? pin.b : pin.a;
    xml += fmt::format(R"(<connect body1="{}" {} anchor="{}"/>)", model[a].name,
                       b == kWorld ? "" : fmt::format(R"(body2="{}")", model[b].name),
                       numbersOf(hasA ? pin.p_AP : pin.p_BQ));
  }
  return xml;
}

std::string sceneXml(const Model& model, const Material& material) {
  return fmt::format(R"(<mujoco><compiler angle="radian" boundmass="0" boundinertia="0"/>
<option timestep="{}" gravity="0 0 -9.81"/><size nconmax="500" njmax="2000"/>
<worldbody>{}</worldbody><equality>{}</equality></mujoco>)",
                     kStep, bodyXml(model, kWorld, material.friction), equalityXml(model));
}

struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

class MujocoWorld : public SceneWorld {
 public:
  MujocoWorld(const Model& model, const Material& material)
      : ours_(model), model_(bench::loadMujoco(sceneXml(model, material))), data_(mj_makeData(model_.get())) {
    setState(initialState(model));
  }

  [[nodiscard]] State state() const override {
    State state = initialState(ours_);
    forEachJoint([&](const Joint& joint, const mjtNum* q, const mjtNum* v) {
      if (joint.mimics) return;
      for (int i = 0; i < joint.nq; ++i) state.q[joint.qIndex + i] = q[i];
      for (int i = 0; i < joint.nv; ++i) state.v[joint.vIndex + i] = v[i];
    });
    state.time = data_->time;
    return state;
  }
  void setState(const State& state) override {
    mj_resetData(model_.get(), data_.get());
    forEachJoint([&](const Joint& joint, mjtNum* q, mjtNum* v) {
      const double ratio = joint.mimics ? joint.ratio : 1, offset = joint.mimics ? joint.offset : 0;
      for (int i = 0; i < joint.nq; ++i) q[i] = ratio * state.q[joint.qIndex + i] + offset;
      for (int i = 0; i < joint.nv; ++i) v[i] = ratio * state.v[joint.vIndex + i];
    });
    data_->time = state.time;
  }
  void setForces(const Eigen::VectorXd& u) override {
    for (const Joint& joint : ours_.joints()) {
      if (joint.nv == 0 || joint.mimics) continue;
      for (int i = 0; i < joint.nv; ++i) data_->qfrc_applied[velocityOf(joint) + i] = u[joint.vIndex + i];
    }
  }
  void step() override { mj_step(model_.get(), data_.get()); }
  [[nodiscard]] double normalForce(int shape) const override {
    const int geom = mj_name2id(model_.get(), mjOBJ_GEOM, fmt::format("s{}", shape).c_str());
    double force = 0;
    for (int i = 0; i < data_->ncon; ++i) {
      if (data_->contact[i].geom1 != geom && data_->contact[i].geom2 != geom) continue;
      mjtNum wrench[6];
      mj_contactForce(model_.get(), data_.get(), i, wrench);
      force += wrench[0];
    }
    return force;
  }

 private:
  [[nodiscard]] int idOf(const Joint& joint) const {
    return mj_name2id(model_.get(), mjOBJ_JOINT, joint.name.c_str());
  }
  [[nodiscard]] int velocityOf(const Joint& joint) const { return model_->jnt_dofadr[idOf(joint)]; }
  template <class Visit>
  void forEachJoint(const Visit& visit) const {
    for (const Joint& joint : ours_.joints()) {
      if (joint.nv == 0) continue;
      visit(joint, data_->qpos + model_->jnt_qposadr[idOf(joint)], data_->qvel + velocityOf(joint));
    }
  }

  Model ours_;
  bench::MujocoModel model_;
  std::unique_ptr<mjData, DataDeleter> data_;
};

}  // namespace

Engine mujocoEngine() {
  return [](const Model& model, const Material& material) {
    return std::make_unique<MujocoWorld>(model, material);
  };
}

}  // namespace rex::contact
