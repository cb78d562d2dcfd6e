#include "player/app/curtain.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <X11/Xlib.h>

// Declared here, because GLFW/glfw3native.h also needs the headers of RandR.
extern "C" {
Display* glfwGetX11Display(void);
Window glfwGetX11Window(GLFWwindow* window);
}

namespace lararium::player {
namespace {

constexpr double kLookUpSeconds = 60.0;

// Uses no OpenGL, whose driver would take more memory than everything else here: the X server
// paints the background of the window by itself.
GLFWwindow* OpenBlackWindow(int number) {
  int count = 0;
  GLFWmonitor** monitors = glfwInit() == GLFW_TRUE ? glfwGetMonitors(&count) : nullptr;
  const GLFWvidmode* mode = number < count ? glfwGetVideoMode(monitors[number]) : nullptr;
  if (mode == nullptr) {
    return nullptr;
  }
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);  // the window of the show opens in front of it
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  GLFWwindow* window =
      glfwCreateWindow(mode->width, mode->height, "Lararium", monitors[number], nullptr);
  if (window != nullptr) {
    glfwSetInputMode(window, GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
    XSetWindowBackground(glfwGetX11Display(), glfwGetX11Window(window), 0);
    XClearWindow(glfwGetX11Display(), glfwGetX11Window(window));
  }
  return window;
}

// Shows the window until this process is ended. It ignores Ctrl+C: the supervisor of the show
// handles that and then ends this process.
[[noreturn]] void Hang(int monitor, Log& log) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  std::signal(SIGINT, SIG_IGN);
  if (OpenBlackWindow(monitor) == nullptr) {
    log.Warn("monitor {}: cannot be covered; while the show is begun again the desktop is seen",
             monitor);
    std::_Exit(1);
  }
  while (true) {
    glfwWaitEventsTimeout(kLookUpSeconds);
  }
}

}  // namespace

Curtain::Curtain(int monitor, Log& log) : process_(::fork()) {
  if (process_ == 0) {
    Hang(monitor, log);
  }
}

Curtain::~Curtain() {
  if (process_ > 0) {
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
  }
}

}  // namespace lararium::player
