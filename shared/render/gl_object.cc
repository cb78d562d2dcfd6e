#include "shared/render/gl_object.h"

#include <epoxy/gl.h>

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

}  // namespace lararium::render
