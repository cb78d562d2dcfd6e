#pragma once

// In a browser WebGL 2 takes the place of what epoxy finds in a driver. The build for browsers
// looks into this folder first.

#include <GLES3/gl3.h>
#include <emscripten/html5_webgl.h>

inline bool epoxy_is_desktop_gl() { return false; }

// Extensions have to be asked for before they have an effect.
inline bool epoxy_has_gl_extension(const char* name) {
  return emscripten_webgl_enable_extension(emscripten_webgl_get_current_context(), name) == EM_TRUE;
}
