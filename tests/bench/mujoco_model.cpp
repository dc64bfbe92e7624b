#include "bench/mujoco_model.h"

#include <cstring>
#include <stdexcept>

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include "geometry/rotation.h"

namespace rex::bench {
namespace {

std::string numbers(const Eigen::VectorXd& values) {
  std::string text;
  for (const double value : values) text += fmt::format("{}{:.17g}", text.empty() ? "" : " ", value);
  return text;
}

// MuJoCo keeps axis and anchor of a joint in the child's frame.
std::string jointXml(const Joint& joint) {
  if (joint.nv != 1) return "";
  const Pose X_CM = joint.X_MC.inverse();
  return fmt::format(R"(<joint name="{}" type="{}" axis="{}" pos="{}"/>)", joint.name,
                     joint.type == JointType::kHinge ? "hinge" : "slide", numbers(X_CM.R * joint.axis),
                     numbers(X_CM.p));
}

std::string bodyXml(const Model& model, BodyId id) {
  const Body& body = model[id];
  const bool isRoot = body.joint == kNoJoint;
  const Pose X_PB = isRoot ? body.X_PB : model[body.joint].X_PF * model[body.joint].X_MC;
  std::string xml = fmt::format(R"(<body name="{}" pos="{}" quat="{}">)", body.name, numbers(X_PB.p),
                                numbers(quaternionFromRotation(X_PB.R)));
  if (body.mass > 0) {
    xml += fmt::format(R"(<inertial mass="{:.17g}" pos="{}" diaginertia="{}"/>)", body.mass,
                       numbers(body.p_BBcm), numbers(body.I_BBcm_B.diagonal()));
  }
  if (!isRoot) xml += jointXml(model[body.joint]);
  const int n = static_cast<int>(model.bodies().size());
  for (int child = 1; child < n; ++child) {
    if (model[BodyId{child}].parent == id) xml += bodyXml(model, BodyId{child});
  }
  return xml + "</body>";
}

}  // namespace

void MujocoDeleter::operator()(mjModel_* model) const { mj_deleteModel(model); }

MujocoModel loadMujoco(const std::string& xml) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "model.xml", static_cast<int>(xml.size()));
  std::memcpy(files->filedata[0], xml.data(), xml.size());
  char message[1000] = "";
  MujocoModel model(mj_loadXML("model.xml", files.get(), message, sizeof message));
  mj_deleteVFS(files.get());
  if (!model) throw std::logic_error(std::string("MuJoCo: ") + message);
  return model;
}

std::string mujocoXml(const Model& model) {
  std::string xml = R"(<mujoco><compiler angle="radian"/><worldbody>)";
  for (int root = 1; root < static_cast<int>(model.bodies().size()); ++root) {
    if (model[BodyId{root}].parent == kWorld) xml += bodyXml(model, BodyId{root});
  }
  return xml + "</worldbody></mujoco>";
}

}  // namespace rex::bench
