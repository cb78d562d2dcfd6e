#pragma once

// What OpenXR must know of the OpenGL context to draw into its images. Apart from the rest: X11's
// headers define words that are ours.

#include <memory>

namespace lararium::player {

// XrGraphicsBindingOpenGLXlibKHR of the current context, for XrSessionCreateInfo::next; nullptr
// where it is not one of GLX.
std::shared_ptr<const void> CurrentGraphicsBinding();

}  // namespace lararium::player
