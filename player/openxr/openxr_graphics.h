#pragma once

// Describes the OpenGL context to OpenXR. It is a separate file, because X11's headers define
// macros that collide with our names.

#include <memory>

namespace lararium::player {

// Returns XrGraphicsBindingOpenGLXlibKHR of the current context, for XrSessionCreateInfo::next;
// nullptr: it is not a GLX context.
std::shared_ptr<const void> CurrentGraphicsBinding();

}  // namespace lararium::player
