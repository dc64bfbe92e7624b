// mujoco_frames COUNT WIDTH HEIGHT [FILE]: draws 60 shapes COUNT times with MuJoCo and prints the CPU seconds
// of one frame; FILE gets the last one as PPM. A program of its own, because two users of one OSMesa upset
// each other.
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include <dlfcn.h>
#include <fmt/format.h>
#include <mujoco/mujoco.h>
#include <time.h>

#include "bench/mujoco_model.h"
#include "bench/shapes_scene.h"
#include "geometry/rotation.h"

namespace rex::bench {
namespace {

std::string geomXml(const Solid& solid) {
  const Eigen::Vector3d& p = solid.X_WS.p;
  const Eigen::Vector4d q = quaternionFromRotation(solid.X_WS.R);
  const Eigen::Vector3d half = solid.shape.extent / 2;
  std::string form;
  if (solid.shape.type == ShapeType::kSphere)
    form = fmt::format(R"(type="sphere" size="{}")", solid.shape.radius);
  if (solid.shape.type == ShapeType::kBox)
    form = fmt::format(R"(type="box" size="{} {} {}")", half.x(), half.y(), half.z());
  if (solid.shape.type == ShapeType::kCapsule)
    form = fmt::format(R"(type="capsule" size="{} {}")", solid.shape.radius, half.z());
  return fmt::format(R"(<body pos="{} {} {}" quat="{} {} {} {}"><geom {} rgba="{} .5 .6 1"/></body>)", p.x(),
                     p.y(), p.z(), q[0], q[1], q[2], q[3], form, solid.color.r);
}

std::string sceneXml(const FrameSize& size) {
  std::string xml = fmt::format(
      R"(<mujoco><visual><global offwidth="{}" offheight="{}" fovy="{}"/><quality offsamples="4" shadowsize="1024"/></visual>
<worldbody><light directional="true" pos="0 0 4" dir=".15 .85 -1.5" castshadow="true"/><geom type="plane" size="10 10 1"/>)",
      size.width, size.height, View().verticalFovDegrees);
  for (const Solid& solid : sixtyShapes()) xml += geomXml(solid);
  return xml + "</worldbody></mujoco>";
}

// MuJoCo finds OpenGL through whichever OSMesa stands in the process, so this must come first.
void makeOsMesaCurrent(const FrameSize& size, std::vector<unsigned char>& buffer) {
  void* library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_GLOBAL);
  if (library == nullptr) throw std::runtime_error("libOSMesa.so.8 (libosmesa6) is not installed");
  using Create = void* (*)(unsigned format, int depth, int stencil, int accumulation, void* shared);
  using MakeCurrent = unsigned char (*)(void* context, void* buffer, unsigned type, int width, int height);
  const auto create = reinterpret_cast<Create>(dlsym(library, "OSMesaCreateContextExt"));
  const auto makeCurrent = reinterpret_cast<MakeCurrent>(dlsym(library, "OSMesaMakeCurrent"));
  constexpr unsigned kRgba = 0x1908, kUnsignedByte = 0x1401;
  buffer.resize(static_cast<std::size_t>(4 * size.width * size.height));
  if (!makeCurrent(create(kRgba, 24, 8, 8, nullptr), buffer.data(), kUnsignedByte, size.width, size.height))
    throw std::runtime_error("no OSMesa context");
}

mjvCamera cameraOf(const View& view) {
  const Eigen::Vector3d toTarget = view.target - view.eye;
  mjvCamera camera;
  mjv_defaultCamera(&camera);
  Eigen::Map<Eigen::Vector3d>(camera.lookat) = view.target;
  camera.distance = toTarget.norm();
  camera.azimuth = std::atan2(toTarget.y(), toTarget.x()) * 180 / mjPI;
  camera.elevation = std::asin(toTarget.z() / camera.distance) * 180 / mjPI;
  return camera;
}

double cpuSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double secondsPerFrame(int count, const FrameSize& size, std::vector<unsigned char>& rgb) {
  std::vector<unsigned char> buffer;
  makeOsMesaCurrent(size, buffer);
  // The process ends after this, so nothing is freed.
  mjModel* model = loadMujoco(sceneXml(size)).release();
  mjData* data = mj_makeData(model);
  mj_forward(model, data);
  mjvCamera camera = cameraOf({});
  mjvOption option;
  mjv_defaultOption(&option);
  mjvScene scene;
  mjv_defaultScene(&scene);
  mjv_makeScene(model, &scene, 1000);
  mjrContext context;
  mjr_defaultContext(&context);
  mjr_makeContext(model, &context, mjFONTSCALE_100);
  mjr_setBuffer(mjFB_OFFSCREEN, &context);
  scene.flags[mjRND_SHADOW] = 1;
  rgb.resize(static_cast<std::size_t>(3 * size.width * size.height));
  const mjrRect viewport{0, 0, size.width, size.height};
  const auto draw = [&] {
    camera.azimuth += 1;
    mjv_updateScene(model, data, &option, nullptr, &camera, mjCAT_ALL, &scene);
    mjr_render(viewport, &scene, &context);
    mjr_readPixels(rgb.data(), nullptr, viewport, &context);
  };
  draw();  // the first frame compiles
  const double start = cpuSeconds();
  for (int i = 0; i < count; ++i) draw();
  return (cpuSeconds() - start) / count;
}

}  // namespace
}  // namespace rex::bench

int main(int argc, char** argv) {
  try {
    if (argc < 4) throw std::invalid_argument("wants COUNT WIDTH HEIGHT [FILE]");
    const auto number = [&](int i) { return std::stoi(argv[i]); };
    const rex::bench::FrameSize size{number(2), number(3)};
    std::vector<unsigned char> rgb;
    fmt::print("{}\n", rex::bench::secondsPerFrame(number(1), size, rgb));
    if (argc > 4) {
      std::ofstream file(argv[4], std::ios::binary);
      file << "P6 " << size.width << ' ' << size.height << " 255\n";
      file.write(reinterpret_cast<const char*>(rgb.data()), static_cast<std::streamsize>(rgb.size()));
    }
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "mujoco_frames: {}\n", error.what());
    return 1;
  }
}
