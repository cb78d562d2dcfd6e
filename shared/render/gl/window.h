#pragma once

// A window with an OpenGL context (GLFW).

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/render/gl/graphics_context.h"

struct GLFWwindow;

namespace lararium::render {

struct WindowOptions {
  std::string title = "Lararium";
  int width = 1280;  // screen coordinates; ignored in full screen
  int height = 720;
  // Monitor for full screen without a mouse pointer; 0 is the primary one. nullopt: a window.
  std::optional<int> monitor = std::nullopt;
  bool vsync = true;
  bool visible = true;
  GraphicsChoice graphics = GraphicsApi::kOpenGl33;
};

// Codes are GLFW's. Positions are in screen coordinates from the top-left corner.
struct WindowCallbacks {
  std::function<void(int key, int action, int modifiers)> key;
  // Unicode character typed by a key, after `key` was called for it.
  std::function<void(char32_t character)> character = {};
  std::function<void(int button, int action, int modifiers)> mouse_button;
  std::function<void(double x, double y)> cursor;
  std::function<void(double x, double y)> scroll;
  std::function<void(int width, int height)> resize;  // framebuffer, pixels
  // Files or folders were dropped on the window; their paths, or addresses that are no files.
  std::function<void(std::vector<std::string> paths)> drop = {};
  // The content of the window was lost, for example because another window covered it.
  std::function<void()> refresh = {};
};

inline constexpr int kKeyPressed = 1;
// The name of a key: "a", "1", "f1", "space", "enter", "left", "page_down", ...; empty if it has
// none.
std::string KeyName(int key);
// True if a key or a button of a game controller has this name.
bool IsButtonName(std::string_view name);

// Move-only. Use it on the main thread only.
class Window {
 public:
  // Opens a window and makes its context current. Fails if there is no desktop, if the requested
  // graphics interface is missing, or if the driver lacks a feature that drawing needs.
  static Result<Window> Create(const WindowOptions& options);
  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;
  ~Window();

  void SetCallbacks(WindowCallbacks callbacks);
  void SetTitle(const std::string& title);

  // Shows the drawn picture; waits for the display if vsync is on.
  void SwapBuffers();
  // PollEvents handles input without waiting. WaitEvents sleeps until there is input, at most
  // timeout_seconds.
  void PollEvents();
  void WaitEvents(double timeout_seconds);

  // Returns the buttons of game controllers pressed since the last call: "pad_a", "pad_up",
  // "pad_start", ...
  std::vector<std::string> TakePadButtons();

  bool ShouldClose() const;
  // True if the user asked to close the window since the last call.
  bool TakeClose();

  struct Size {
    int width = 0;
    int height = 0;
  };
  Size framebuffer_size() const;  // pixels; 0 x 0 while minimised
  float content_scale() const;    // 2 on a display with double pixel density
  GLFWwindow* handle() const;     // needed by ImGui

 private:
  struct State;
  explicit Window(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace lararium::render
