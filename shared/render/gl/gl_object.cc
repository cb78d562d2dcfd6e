#include "shared/render/gl/gl_object.h"

#include <epoxy/gl.h>

#include <string>

namespace lararium::render {

uint32_t GenerateGlObject(GlKind kind) {
  GLuint id = 0;
  switch (kind) {
    case GlKind::kBuffer:
      glGenBuffers(1, &id);
      break;
    case GlKind::kTexture:
      glGenTextures(1, &id);
      break;
    case GlKind::kVertexArray:
      glGenVertexArrays(1, &id);
      break;
    case GlKind::kFramebuffer:
      glGenFramebuffers(1, &id);
      break;
    case GlKind::kRenderbuffer:
      glGenRenderbuffers(1, &id);
      break;
    case GlKind::kSampler:
      glGenSamplers(1, &id);
      break;
    case GlKind::kProgram:
      id = glCreateProgram();
      break;
  }
  return id;
}

void DeleteGlObject(GlKind kind, uint32_t id) {
  switch (kind) {
    case GlKind::kBuffer:
      glDeleteBuffers(1, &id);
      break;
    case GlKind::kTexture:
      glDeleteTextures(1, &id);
      break;
    case GlKind::kVertexArray:
      glDeleteVertexArrays(1, &id);
      break;
    case GlKind::kFramebuffer:
      glDeleteFramebuffers(1, &id);
      break;
    case GlKind::kRenderbuffer:
      glDeleteRenderbuffers(1, &id);
      break;
    case GlKind::kSampler:
      glDeleteSamplers(1, &id);
      break;
    case GlKind::kProgram:
      glDeleteProgram(id);
      break;
  }
}

Status CheckFramebuffer(std::string_view what) {
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    return Status::Error("graphics",
                         "the driver cannot draw " + std::string(what) + " of this size",
                         "try a smaller size, or update the driver");
  }
  return Status();
}

}  // namespace lararium::render
