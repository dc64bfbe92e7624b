#include "render/gl_context.h"

#include <cstdlib>

#include <gtest/gtest.h>
#include <unistd.h>

#include "render/gl_functions_internal.h"
#include "render/gl_program_internal.h"
#include "render/osmesa_context_internal.h"
#include "render/renderer.h"
#include "support/expect_error.h"
#include "support/needs_osmesa.h"

namespace rex {
namespace {

class EmptyContext final : public GlContext {
 public:
  void makeCurrent() override {}
  Proc proc(const char* name) const override {
    return std::string(name) == "glClear" ? reinterpret_cast<Proc>(&::abort) : nullptr;
  }
  std::string describe() const override { return "nothing"; }
};

TEST(GlContext, NamesThePackageWhenOsMesaIsMissing) {
  EXPECT_REX_ERROR(internal::makeOsMesaContext({"libNoSuchMesa.so.8", "libNorThis.so"}),
                   "libNoSuchMesa.so.8: cannot open");
  EXPECT_REX_ERROR(internal::makeOsMesaContext({"libNoSuchMesa.so.8", "libNorThis.so"}),
                   "wanted OSMesa, Debian package libosmesa6");
}

TEST(GlContext, RejectsLibrariesThatDoNotWork) {
  EXPECT_REX_ERROR(internal::makeOsMesaContext({"libm.so.6"}),
                   "libm.so.6 without OSMesaCreateContextAttribs, wanted Mesa 22 or later");
  EXPECT_REX_ERROR(internal::makeOsMesaContext({REX_BROKEN_OSMESA}), "without OpenGL 3.3 core");
  const auto context = internal::makeOsMesaContext({REX_BROKEN_OSMESA});
  EXPECT_REX_ERROR(context->makeCurrent(), "refuses its own context");
}

TEST(GlContext, ChoosesByNameAndRejectsOthers) {
  EXPECT_EQ(glBackendFromName("auto"), GlBackend::kAuto);
  EXPECT_EQ(glBackendFromName("osmesa"), GlBackend::kOsMesa);
  EXPECT_REX_ERROR(glBackendFromName("osmesaa"), "OpenGL backend: found 'osmesaa', wanted auto or osmesa");
  EXPECT_REX_ERROR(makeGlContext({.driver = "swr"}),
                   "OpenGL driver: found 'swr', wanted llvmpipe or softpipe");
}

TEST(GlContext, ListsMissingFunctions) {
  EXPECT_REX_ERROR(internal::loadGlFunctions(EmptyContext{}),
                   "OpenGL by nothing: found no glActiveTexture, glA");
  try {
    static_cast<void>(internal::loadGlFunctions(EmptyContext{}));
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("glClear,")));
  }
}

TEST(GlContext, TurnsOpenGlErrorsIntoOurs) {
  internal::GlFunctions gl;
  gl.GetError = [] { return GLenum{GL_INVALID_ENUM}; };
  EXPECT_REX_ERROR(internal::requireNoGlError(gl, "testing"), "OpenGL failed testing: found error 0x500");
  gl.GetError = [] { return GLenum{GL_OUT_OF_MEMORY}; };
  EXPECT_REX_ERROR(internal::requireNoGlError(gl, "testing"), "found too little memory");
  gl.GetError = [] { return GLenum{GL_NO_ERROR}; };
  EXPECT_NO_THROW(internal::requireNoGlError(gl, "testing"));
}

TEST(GlContext, ShowsWhyAShaderIsRefused) {
  REX_NEEDS_OSMESA();
  const auto context = makeGlContext();
  context->makeCurrent();
  const internal::GlFunctions gl = internal::loadGlFunctions(*context);
  EXPECT_REX_ERROR(internal::GlProgram(gl, "#version 330 core\nvoid main() { oops }\n", ""),
                   "OpenGL refuses a shader of rex: found");
}

// In a process of its own, because Mesa keeps the driver of the first context. `swr` in the environment would
// crash Mesa.
void makeContextsUnder(const char* variable, const char* driver) {
  ::setenv("GALLIUM_DRIVER", variable, 1);
  const std::string description = Renderer({.width = 8, .height = 8, .gl = {.driver = driver}}).describe();
  const bool kept = std::string(std::getenv("GALLIUM_DRIVER")) == variable;
  const bool asked = description.find(driver) != std::string::npos;
  const bool told = std::string(driver) != "softpipe" ||
                    description.find("4 samples are not supported") != std::string::npos;
  ::_exit(kept && asked && told ? 0 : 1);
}

TEST(GlContextDeathTest, UsesTheChosenDriverWhateverTheEnvironmentSays) {
  REX_NEEDS_OSMESA();
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(makeContextsUnder("swr", "llvmpipe"), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(makeContextsUnder("llvmpipe", "softpipe"), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace rex
