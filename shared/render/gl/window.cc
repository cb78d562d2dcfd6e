#include "shared/render/gl/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <utility>

#include "shared/render/gl/graphics_choice.h"

namespace lararium::render {
namespace {

constexpr std::string_view kWindowPlace = "window";

// Keeps GLFW initialised while there are windows. Main thread only, like GLFW itself.
class GlfwLibrary {
 public:
  static std::shared_ptr<GlfwLibrary> Start() {
    static std::weak_ptr<GlfwLibrary> running;
    std::shared_ptr<GlfwLibrary> library = running.lock();
    if (library == nullptr && glfwInit() == GLFW_TRUE) {
      library = std::make_shared<GlfwLibrary>();
      running = library;
    }
    return library;
  }
  GlfwLibrary() = default;
  ~GlfwLibrary() { glfwTerminate(); }
  GlfwLibrary(const GlfwLibrary&) = delete;
  GlfwLibrary& operator=(const GlfwLibrary&) = delete;
};

struct WindowDeleter {
  void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};

Status LastError(std::string_view remedy) {
  const char* description = nullptr;
  glfwGetError(&description);
  return Status::Error(kWindowPlace, description == nullptr ? "cannot be opened" : description,
                       remedy);
}

Result<GLFWmonitor*> FindMonitor(int number) {
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  if (number < 0 || number >= count) {
    return Status::Error(
        "monitor " + std::to_string(number), "is not connected",
        count == 0 ? "connect one" : "give a number from 0 to " + std::to_string(count - 1));
  }
  return monitors[number];
}

}  // namespace

std::string KeyName(int key) {
  if ((key >= GLFW_KEY_A && key <= GLFW_KEY_Z) || (key >= GLFW_KEY_0 && key <= GLFW_KEY_9)) {
    return {static_cast<char>(key >= GLFW_KEY_A ? key - GLFW_KEY_A + 'a' : key)};
  }
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) {
    return "f" + std::to_string(key - GLFW_KEY_F1 + 1);
  }
  switch (key) {
    case GLFW_KEY_SPACE:
      return "space";
    case GLFW_KEY_ENTER:
      return "enter";
    case GLFW_KEY_ESCAPE:
      return "escape";
    case GLFW_KEY_TAB:
      return "tab";
    case GLFW_KEY_LEFT:
      return "left";
    case GLFW_KEY_RIGHT:
      return "right";
    case GLFW_KEY_UP:
      return "up";
    case GLFW_KEY_DOWN:
      return "down";
    case GLFW_KEY_PAGE_UP:
      return "page_up";
    case GLFW_KEY_PAGE_DOWN:
      return "page_down";
    case GLFW_KEY_HOME:
      return "home";
    default:
      return "";
  }
}

static_assert(kKeyPressed == GLFW_PRESS);

namespace {

// Index: GLFW's button numbers, which follow the layout of an Xbox controller.
constexpr std::array<const char*, GLFW_GAMEPAD_BUTTON_LAST + 1> kPadButtons = {
    "pad_a",     "pad_b",     "pad_x",     "pad_y",          "pad_left_bumper", "pad_right_bumper",
    "pad_back",  "pad_start", "pad_guide", "pad_left_stick", "pad_right_stick", "pad_up",
    "pad_right", "pad_down",  "pad_left"};

}  // namespace

bool IsButtonName(std::string_view name) {
  for (int key = GLFW_KEY_SPACE; key <= GLFW_KEY_LAST; ++key) {
    if (!name.empty() && KeyName(key) == name) {
      return true;
    }
  }
  return std::find(kPadButtons.begin(), kPadButtons.end(), name) != kPadButtons.end();
}

struct Window::State {
  std::shared_ptr<GlfwLibrary> library;
  std::unique_ptr<GLFWwindow, WindowDeleter> window;
  WindowCallbacks callbacks;
  // For each controller, which buttons are held down.
  std::array<std::array<bool, kPadButtons.size()>, GLFW_JOYSTICK_LAST + 1> held = {};

  static const WindowCallbacks& Of(GLFWwindow* window) {
    return static_cast<State*>(glfwGetWindowUserPointer(window))->callbacks;
  }

  void Connect() {
    GLFWwindow* w = window.get();
    glfwSetWindowUserPointer(w, this);
    glfwSetKeyCallback(w, [](GLFWwindow* self, int key, int, int action, int modifiers) {
      if (Of(self).key) {
        Of(self).key(key, action, modifiers);
      }
    });
    glfwSetCharCallback(w, [](GLFWwindow* self, unsigned int character) {
      if (Of(self).character) {
        Of(self).character(character);
      }
    });
    glfwSetMouseButtonCallback(w, [](GLFWwindow* self, int button, int action, int modifiers) {
      if (Of(self).mouse_button) {
        Of(self).mouse_button(button, action, modifiers);
      }
    });
    glfwSetCursorPosCallback(w, [](GLFWwindow* self, double x, double y) {
      if (Of(self).cursor) {
        Of(self).cursor(x, y);
      }
    });
    glfwSetScrollCallback(w, [](GLFWwindow* self, double x, double y) {
      if (Of(self).scroll) {
        Of(self).scroll(x, y);
      }
    });
    glfwSetDropCallback(w, [](GLFWwindow* self, int count, const char** paths) {
      if (Of(self).drop) {
        Of(self).drop({paths, paths + count});
      }
    });
    glfwSetWindowRefreshCallback(w, [](GLFWwindow* self) {
      if (Of(self).refresh) {
        Of(self).refresh();
      }
    });
    glfwSetFramebufferSizeCallback(w, [](GLFWwindow* self, int width, int height) {
      if (Of(self).resize) {
        Of(self).resize(width, height);
      }
    });
  }
};

Window::Window(std::unique_ptr<State> state) : state_(std::move(state)) {}
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

namespace {

void HintContext(GraphicsApi api) {
  const bool desktop = api == GraphicsApi::kOpenGl33;
  glfwWindowHint(GLFW_CLIENT_API, desktop ? GLFW_OPENGL_API : GLFW_OPENGL_ES_API);
  glfwWindowHint(GLFW_CONTEXT_CREATION_API,
                 desktop ? GLFW_NATIVE_CONTEXT_API : GLFW_EGL_CONTEXT_API);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, desktop ? 3 : 0);
  glfwWindowHint(GLFW_OPENGL_PROFILE, desktop ? GLFW_OPENGL_CORE_PROFILE : GLFW_OPENGL_ANY_PROFILE);
}

}  // namespace

Result<Window> Window::Create(const WindowOptions& options) {
  LARARIUM_RETURN_IF_ERROR(CheckMemory());
  const std::shared_ptr<GlfwLibrary> library = GlfwLibrary::Start();
  if (library == nullptr) {
    return LastError("start it on a desktop, or run without a window");
  }
  GLFWmonitor* monitor = nullptr;
  int width = options.width;
  int height = options.height;
  if (options.monitor) {
    LARARIUM_ASSIGN_OR_RETURN(monitor, FindMonitor(*options.monitor));
    if (const GLFWvidmode* mode = glfwGetVideoMode(monitor); mode != nullptr) {
      width = mode->width;
      height = mode->height;
    }
  }
  return CreateChosen(options.graphics, [&](GraphicsApi api) -> Result<Window> {
    auto state = std::make_unique<State>();
    state->library = library;
    glfwDefaultWindowHints();
    HintContext(api);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);  // everything is drawn into render targets
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
    // A notification of the desktop must not minimise the window.
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
    state->window.reset(glfwCreateWindow(width, height, options.title.c_str(), monitor, nullptr));
    if (state->window == nullptr) {
      return LastError("it needs a graphics driver with " + std::string(Name(api)));
    }
    glfwMakeContextCurrent(state->window.get());
    glfwSwapInterval(options.vsync ? 1 : 0);
    if (monitor != nullptr) {
      glfwSetInputMode(state->window.get(), GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
    }
    state->Connect();
    return Window(std::move(state));
  });
}

void Window::SetCallbacks(WindowCallbacks callbacks) { state_->callbacks = std::move(callbacks); }
void Window::SetTitle(const std::string& title) {
  glfwSetWindowTitle(state_->window.get(), title.c_str());
}
void Window::SwapBuffers() { glfwSwapBuffers(state_->window.get()); }
void Window::PollEvents() { glfwPollEvents(); }
void Window::WaitEvents(double timeout_seconds) { glfwWaitEventsTimeout(timeout_seconds); }
std::vector<std::string> Window::TakePadButtons() {
  std::vector<std::string> pressed;
  for (int pad = GLFW_JOYSTICK_1; pad <= GLFW_JOYSTICK_LAST; ++pad) {
    GLFWgamepadstate now = {};  // no button is held on a controller that was removed
    glfwGetGamepadState(pad, &now);
    auto& held = state_->held[static_cast<size_t>(pad)];
    for (size_t button = 0; button < held.size(); ++button) {
      const bool down = now.buttons[button] == GLFW_PRESS;
      if (down && !held[button]) {
        pressed.emplace_back(kPadButtons[button]);
      }
      held[button] = down;
    }
  }
  return pressed;
}

bool Window::ShouldClose() const {
  return glfwWindowShouldClose(state_->window.get()) == GLFW_TRUE;
}
bool Window::TakeClose() {
  const bool asked = ShouldClose();
  glfwSetWindowShouldClose(state_->window.get(), GLFW_FALSE);
  return asked;
}

Window::Size Window::framebuffer_size() const {
  Size size;
  glfwGetFramebufferSize(state_->window.get(), &size.width, &size.height);
  return size;
}

float Window::content_scale() const {
  float x = 1.0f;
  float y = 1.0f;
  glfwGetWindowContentScale(state_->window.get(), &x, &y);
  return x;
}

GLFWwindow* Window::handle() const { return state_->window.get(); }

}  // namespace lararium::render
